#include "dem/specimen/taken_state.h"

#include "base/errors.h"
#include "dem/core/memory_pages.h"
#include "dem/model/column_memory.h"

#include <algorithm>

namespace dem
{
  TakenState::TakenState(SpecimenCore &core_, base::StateVisitor &inner_)
    : core(core_)
    , inner(inner_)
  {
  }

  void TakenState::column(const std::string &name, base::Column &values)
  {
    for (const LinkSet *const links : {&core.bonds, &core.contacts})
      if (const std::size_t numbers = numbers_of_state(*links, values);
          numbers > 0 && &values != &links->area) // by which it is known which links there are
        return rest.push_back({name, &values, numbers, links});
    inner.column(name, values);
  }

  void TakenState::take_rest()
  {
    for (const Left &left : rest)
      assign_zeros(*left.values, left.numbers_of_line * left.links->first.size());
    core.share_out();
    for (const Left &left : rest)
      read_own(left);
  }

  void TakenState::read_own(const Left &left)
  {
    std::size_t read = 0;
    inner.read_in_parts(left.name, [&](const double *const numbers, const std::size_t count) {
      const std::size_t end_of_these = std::max(read, std::min(read + count, left.values->size()));
      const auto        among        = [&](const std::size_t line) {
        return std::clamp(left.numbers_of_line * line, read, end_of_these);
      };
      for (const LinkPart &part : left.links->parts)
        if (const std::size_t begin = among(part.begin), end = among(part.end); end > begin)
          std::copy(numbers + (begin - read), numbers + (end - read),
                    left.values->begin() + static_cast<std::ptrdiff_t>(begin));
      read += count;
    });
    if (read != left.values->size())
      throw base::InputError("state: \"" + left.name + "\" has " + std::to_string(read) + " numbers, and its links " +
                             std::to_string(left.values->size()) + ". Another version wrote it.");
  }
} // namespace dem
