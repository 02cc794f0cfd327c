#include "dem/model/break_log.h"

#include <algorithm>

namespace dem
{
  void BreakLog::add(const Break &b)
  {
    known.insert(key(b));
    names.insert(names.end(), {b.ends[0], second(b), b.image, b.pair, b.element, static_cast<std::int32_t>(b.mode)});
    numbers.insert(numbers.end(), {b.time, static_cast<double>(b.step), b.place[0], b.place[1], b.place[2], b.normal[0],
                                   b.normal[1], b.normal[2], b.area});
  }

  Break BreakLog::at(const std::size_t number) const
  {
    const std::int32_t *name  = &names.at(names_of_one * number);
    const double       *value = &numbers.at(numbers_of_one * number);
    Break               found;
    found.time    = value[0];
    found.step    = static_cast<std::int64_t>(value[1]);
    found.ends    = {name[0], std::max(name[1], -1)};
    found.surface = name[1] < 0 ? -1 - name[1] : -1;
    found.image   = name[2];
    found.pair    = name[3];
    found.element = name[4];
    found.mode    = static_cast<BreakMode>(name[5]);
    found.place   = Eigen::Vector3d(value + 2);
    found.normal  = Eigen::Vector3d(value + 5);
    found.area    = value[8];
    return found;
  }

  void BreakLog::visit_state(base::StateVisitor &visitor)
  {
    visitor.column("breaks/names", names);
    visitor.column("breaks/numbers", numbers);
    known.clear();
    for (std::size_t b = 0; b < size(); ++b)
      known.insert(key(at(b)));
  }
} // namespace dem
