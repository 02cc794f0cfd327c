#include "dem/packing/box_cell.h"

namespace dem
{
  CompactionParameters cell_for_box(const CompactionParameters &usual, const Eigen::Vector3d &box)
  {
    CompactionParameters cell  = usual;
    const double         most  = static_cast<double>(most_in_one_cell);
    const bool           huge  = !(box.prod() < 10 * most * usual.radius * usual.radius * usual.radius);
    const std::size_t    whole = huge ? 0 : count_to_fill(box, usual.radius, usual.friction);
    if (huge || whole > most_in_one_cell)
      cell.count = most_in_one_cell;
    else if (whole > usual.count)
      {
        cell.count       = whole;
        cell.proportions = box;
      }
    return cell;
  }
} // namespace dem
