#include "dem/packing/overlaps.h"

#include "base/errors.h"
#include "dem/neighbours/cell_list.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    void check_cell(const Packing &packing, const std::string &origin, const int dimension)
    {
      const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
      for (int d = 0; d < dimension; ++d)
        {
          const auto by_place =
            std::minmax_element(packing.centre.begin(), packing.centre.end(),
                                [d](const Eigen::Vector3d &a, const Eigen::Vector3d &b) { return a[d] < b[d]; });
          const double length = (*by_place.second)[d] - (*by_place.first)[d], edge = (*packing.periodic_cell)[d];
          if (length <= edge + 2 * largest)
            continue;
          std::ostringstream message;
          message << origin << ": along "
                  << "xyz"[d] << " the centres lie up to " << length << " m apart, and the periodic cell is " << edge
                  << " m long: the packing is larger than its cell. Check the cell and the units: metres.";
          throw base::InputError(message.str());
        }
      const double solid = solid_volume(packing), cell = packing.periodic_cell->prod();
      if (dimension == 2 || solid <= cell)
        return;
      std::ostringstream message;
      message << origin << ": the particles have a volume of " << solid << " m^3, and their periodic cell has " << cell
              << " m^3. Check the cell and the units: metres.";
      throw base::InputError(message.str());
    }
  } // namespace

  void check_overlaps(const Packing                                       &packing,
                      const std::string                                   &origin,
                      const int                                            dimension,
                      const std::function<bool(std::size_t, std::size_t)> &one_body)
  {
    constexpr double allowed = 0.75; // of the smaller diameter; packings by compaction overlap by a hundredth
    if (packing.periodic_cell)
      check_cell(packing, origin, dimension);
    for (const NeighbourPair &pair : find_pairs(packing.centre, packing.radius, 1.0, 0.0, packing.periodic_cell))
      {
        const auto      first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
        Eigen::Vector3d branch = packing.centre[second] - packing.centre[first];
        for (int d = 0; d < 3; ++d)
          if (pair.shift[static_cast<std::size_t>(d)] != 0)
            branch[d] += pair.shift[static_cast<std::size_t>(d)] * (*packing.periodic_cell)[d];
        const double smaller = 2 * std::min(packing.radius[first], packing.radius[second]);
        const double overlap = packing.radius[first] + packing.radius[second] - branch.norm();
        if (overlap <= allowed * smaller || packing.in_one_body(first, second) || (one_body && one_body(first, second)))
          continue;
        std::ostringstream message;
        message << origin << ": particles " << first + 1 << " and " << second + 1
                << (pair.shift != decltype(pair.shift){} ? " (its periodic image)" : "") << " overlap by " << overlap
                << " m, " << std::round(100 * overlap / smaller) << " % of the smaller diameter; up to "
                << 100 * allowed << " % is taken. Remove one of the two, or check the units: metres.";
        throw base::InputError(message.str());
      }
  }
} // namespace dem
