#include "dem/core/streaming.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace dem
{
  namespace
  {
    /** Of a level that the kernel knows [bytes]; 0: of none. The C library would report the sum over all caches of a processor's package. */
    std::size_t cache_size(const int index)
    {
      std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/size");
      std::size_t   size = 0;
      char          unit = 0;
      if (!(file >> size))
        return 0;
      file >> unit;
      return unit == 'M' ? size << 20 : unit == 'K' ? size << 10 : size;
    }

    std::size_t largest_cache()
    {
      constexpr int levels  = 8; // more than any processor has
      std::size_t   largest = 0;
      for (int index = 0; index < levels; ++index)
        largest = std::max(largest, cache_size(index));
      return largest > 0 ? largest : std::size_t(32) << 20;
    }
  } // namespace

  std::size_t last_level_cache()
  {
    static const std::size_t bytes = largest_cache();
    return bytes;
  }
} // namespace dem
