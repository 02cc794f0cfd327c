#include "dem/laboratory/test_record.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  bool TestRecord::step(const double load, const double first, const double second)
  {
    largest = since == 0 ? load : std::max(largest, load);
    apart   = since == 0 ? std::abs(second - first) : std::max(apart, std::abs(second - first));
    return ++since >= interval;
  }

  void TestRecord::row(const LabReading &r)
  {
    numbers.insert(numbers.end(), {r.strain, r.stress, r.low, r.high, r.gauge_strain, r.lateral_strain, r.confinement,
                                   r.kinetic, r.work, r.force_ratio, r.breaks, largest, apart});
    since = 0;
    if (rows() < most_rows)
      return;
    base::Column kept;
    for (std::size_t odd = 1; odd < rows(); odd += 2)
      {
        const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(columns * odd);
        kept.insert(kept.end(), at, at + columns);
        double *last         = &kept[kept.size() - columns];
        last[largest_stress] = std::max(last[largest_stress], this->at(odd - 1, largest_stress));
        last[imbalance]      = std::max(last[imbalance], this->at(odd - 1, imbalance));
      }
    numbers = kept;
    interval *= 2;
  }

  std::vector<double> TestRecord::values(const Column column) const
  {
    std::vector<double> found(rows());
    for (std::size_t r = 0; r < found.size(); ++r)
      found[r] = at(r, column);
    return found;
  }

  void TestRecord::clear()
  {
    numbers.clear();
    since = 0;
  }

  void TestRecord::visit_state(base::StateVisitor &visitor)
  {
    visitor.column("record/numbers", numbers);
    visitor.scalar("record/interval", interval);
    visitor.scalar("record/since", since);
    visitor.scalar("record/largest", largest);
    visitor.scalar("record/apart", apart);
  }
} // namespace dem
