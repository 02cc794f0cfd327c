#include "dem/model/column_memory.h"

#include "dem/core/memory_pages.h"

namespace dem
{
  std::size_t resident_bytes(const Particles &particles, const std::vector<const LinkSet *> &sets)
  {
    std::size_t bytes = particles.bytes();
    const auto  count = [&](const base::Column &column) {
      bytes -= sizeof(double) * column.capacity();
      bytes += resident_bytes(column);
    };
    for (const base::Column *column : records_of_state(particles))
      count(*column);
    count(particles.reference);
    for (const LinkSet *links : sets)
      {
        bytes += links->bytes();
        each_column_of_state(*links, [&](const base::Column &column, std::size_t) { count(column); });
      }
    return bytes;
  }
} // namespace dem
