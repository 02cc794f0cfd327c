#include "coupling/volume/bond_ends.h"

#include <Eigen/Geometry>

#include <utility>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    /** Between a place where something is not so and one where it is, the first that is found where it is. */
    template <typename IsSo>
    Vector3d first_place(Vector3d outside, Vector3d inside, const IsSo &is_so)
    {
      constexpr int halvings = 50; // down to rounding
      for (int n = 0; n < halvings; ++n)
        {
          const Vector3d middle              = 0.5 * (outside + inside);
          (is_so(middle) ? inside : outside) = middle;
        }
      return inside;
    }
  } // namespace

  std::vector<BondEnd> bond_ends(const dem::ElasticNetwork                   &network,
                                 const std::vector<std::size_t>              &constrained,
                                 const Overlap                               &overlap,
                                 const std::function<bool(const Vector3d &)> &in_elements)
  {
    constexpr double  rounding = 1e-9;
    std::vector<bool> is_constrained(network.particles(), false);
    for (const std::size_t i : constrained)
      is_constrained[i] = true;
    std::vector<BondEnd> ends;
    for (const dem::ElasticLink &link : network.links)
      {
        if (is_constrained[link.first] == is_constrained[link.second])
          continue;
        const auto [free, held] =
          is_constrained[link.first] ? std::pair{link.second, link.first} : std::pair{link.first, link.second};
        // A search counts as inside what is outside by rounding, distances do not; but not each of these regions ends with elements.
        const Vector3d &outside = network.centre[free], &inside = network.centre[held];
        Vector3d        from =
          first_place(outside, inside, [&](const Vector3d &place) { return overlap.distance(place) >= 0; });
        if (!in_elements(from))
          from = first_place(from, inside, in_elements);
        const double part = (inside - from).norm() / (inside - outside).norm();
        if (part > rounding) // none of one on the face of an element
          ends.push_back({from, inside, static_cast<std::size_t>(held), part,
                          held == link.first ? link.arm_first : link.arm_second, link.stiffness / part,
                          link.turning / part});
      }
    return ends;
  }

  EndPulls pulls_of(const BondEnd &end, const EndNow &now)
  {
    // Slip and relative rotation are those of stiffness_of(), of ends that have turned; stiffness turns with the constrained particle.
    const Vector3d whole = end.to - end.from, arm = end.arm * whole.normalized(), of_constrained = now.turn_to * arm,
                   of_entry = now.turn_from * (whole - arm), slip = now.to - now.from - of_constrained - of_entry;
    // Twice the vector part of the quaternion, whose rate by a spin w is s w + w x q for the scalar part s.
    const Eigen::Quaterniond q(Eigen::Matrix3d(now.turn_from.transpose() * now.turn_to));
    const double             sign = q.w() < 0 ? -2 : 2;
    const Vector3d           bent = sign * q.vec();
    EndPulls                 pulls;
    pulls.force            = now.turn_to * (end.stiffness * (now.turn_to.transpose() * slip));
    const Vector3d moment  = end.turning * bent,
                   between = now.turn_from * (0.5 * sign * q.w() * moment + 0.5 * bent.cross(moment));
    pulls.couple_to        = between - of_constrained.cross(pulls.force) - slip.cross(pulls.force);
    pulls.couple_from      = -between - of_entry.cross(pulls.force);
    pulls.energy           = 0.5 * slip.dot(pulls.force) + 0.5 * bent.dot(moment);
    return pulls;
  }
} // namespace coupling
