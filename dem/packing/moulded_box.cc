#include "dem/packing/moulded_box.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    /// Beside a plate spheres pack looser: so much of a diameter at each has no sphere. Of cubes of 8 to 20 diameters, three seeds each:
    /// 0.110 with a friction of 0.1 and 0.070 with 1, +-0.01.
    double sparse(const double friction) { return 0.115 - 0.045 * std::min(friction, 1.0); }

    /// Volume of the mould over that of the box, beyond which another number of spheres is compacted: a part in 500 of the edges.
    constexpr double close = 0.006;

    std::size_t count_in(const Eigen::Vector3d &box, const CompactionParameters &usual, const double packing_fraction)
    {
      const double count = packing_fraction * box.prod() / (4.0 / 3.0 * M_PI * std::pow(usual.radius, 3));
      if (!(count < 1e8))
        {
          std::ostringstream text;
          text << "moulded box: " << box[0] << " x " << box[1] << " x " << box[2] << " m would hold " << count
               << " spheres of radius " << usual.radius << " m, more than 1e8. Shrink it, or check the units: metres.";
          throw base::InputError(text.str());
        }
      return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(count)));
    }

    void check_room(const Eigen::Vector3d &box, const double radius)
    {
      if (box.minCoeff() >= 2 * radius)
        return;
      std::ostringstream text;
      text << "moulded box: its edge of " << box.minCoeff() << " m is shorter than a sphere of radius " << radius
           << " m is wide. Enlarge the box or check the units: metres.";
      throw base::InputError(text.str());
    }

    /** Between plates that stand at the edges of the box. */
    Packing spaced(Packing packing, const Eigen::Vector3d &edges, const Eigen::Vector3d &box, const double radius)
    {
      for (Eigen::Vector3d &centre : packing.centre)
        for (Eigen::Index d = 0; d < 3; ++d)
          {
            const double room = edges[d] - 2 * radius; // none: a single layer
            centre[d]         = room > 0 ? radius + (centre[d] - radius) * (box[d] - 2 * radius) / room : 0.5 * box[d];
          }
      return packing;
    }
  } // namespace

  Packing moulded_box(const CompactionParameters                                          &usual,
                      const Eigen::Vector3d                                               &box,
                      const std::function<CompactionResult(const CompactionParameters &)> &make)
  {
    check_room(box, usual.radius);
    CompactionParameters  mould  = usual;
    const Eigen::Vector3d filled = box.array() - 2 * sparse(usual.friction) * 2 * usual.radius;
    mould.moulded                = true;
    mould.proportions            = box;
    mould.count                  = count_in(filled, usual, expected_packing_fraction(usual.friction));
    CompactionResult made        = make(mould);
    if (std::abs(made.edges.prod() / box.prod() - 1) > close)
      {
        mould.count = count_in(box, usual, made.packing_fraction);
        made        = make(mould);
      }
    return spaced(std::move(made.packing), made.edges, box, usual.radius);
  }
} // namespace dem
