#include "dem/laboratory/membrane.h"

#include "base/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <set>

namespace dem
{
  namespace
  {
    using Eigen::Vector3d;

    /** Area vectors that particles have to bear [m^2]. */
    using Shares = std::map<std::int32_t, Vector3d>;

    void share(Shares &shares, const std::int32_t particle, const Vector3d &area)
    {
      const auto [place, added] = shares.try_emplace(particle, area);
      if (!added)
        place->second += area;
    }

    /** From a particle straight to the platen that is nearer. */
    Vector3d to_platen(const Vector3d &place, const EndPlanes &ends)
    {
      Vector3d there   = place;
      there[ends.axis] = 2 * place[ends.axis] < ends.low + ends.high ? ends.low : ends.high;
      return there;
    }

    /** Where a chain ends it goes on to the platen. */
    void add_ends_of_chain(Shares                                 &shares,
                           const Hull                             &hull,
                           const std::map<std::int32_t, Vector3d> &place,
                           const EndPlanes                        &ends)
    {
      std::map<std::int32_t, int> goes_on; // as many segments begin here as end
      for (const auto &facet : hull.facet)
        {
          ++goes_on[facet[0]];
          --goes_on[facet[1]];
        }
      for (const auto &[particle, more] : goes_on)
        {
          const Vector3d edge = more * (place.at(particle) - to_platen(place.at(particle), ends));
          share(shares, particle, {edge[1], -edge[0], 0});
        }
    }

    /** The same of the border of triangles. */
    void add_ends_of_triangles(Shares                                 &shares,
                               const Hull                             &hull,
                               const std::map<std::int32_t, Vector3d> &place,
                               const EndPlanes                        &ends)
    {
      std::set<std::array<std::int32_t, 2>> edges;
      for (const auto &facet : hull.facet)
        for (std::size_t c = 0; c < 3; ++c)
          edges.insert({facet[c], facet[(c + 1) % 3]});
      for (const auto &[i, j] : edges)
        {
          if (edges.count({j, i}) > 0)
            continue;
          const Vector3d from = place.at(j), to = place.at(i), below_to = to_platen(to, ends),
                         below_from = to_platen(from, ends);
          const Vector3d area = 0.5 * ((to - from).cross(below_to - from) + (below_to - from).cross(below_from - from));
          share(shares, i, 0.5 * area);
          share(shares, j, 0.5 * area);
        }
    }
  } // namespace

  Membrane::Membrane(Specimen &body, const double size)
    : specimen(&body)
    , ball(size)
    , thickness(body.parameters().physics.dimension == 2 ? body.parameters().thickness : 1.0)
  {
    if (!(ball > 0))
      throw base::InputError("Membrane ball: must be above 0 m.");
  }

  bool Membrane::at_end(const Vector3d &centre, const double radius, const EndPlanes &ends) const
  {
    const double along = centre[ends.axis];
    return along - ends.low < 1.5 * radius || ends.high - along < 1.5 * radius;
  }

  void Membrane::lay(const EndPlanes &ends)
  {
    const ParticleKinematics now = specimen->kinematics();
    hull                         = find_hull(now.position, now.radius, specimen->parameters().physics.dimension, ball);
    const auto corners           = static_cast<std::ptrdiff_t>(hull.corners);
    const auto covered           = [&](const std::array<std::int32_t, 3> &facet) {
      return std::all_of(facet.begin(), facet.begin() + corners, [&](const std::int32_t i) {
        return at_end(now.position[static_cast<std::size_t>(i)], now.radius[static_cast<std::size_t>(i)], ends);
      });
    };
    hull.facet.erase(std::remove_if(hull.facet.begin(), hull.facet.end(), covered), hull.facet.end());
    if (hull.facet.empty())
      throw base::NumericalError("no particle of the specimen carries the membrane: there is no way around it for a "
                                 "ball of this size. Choose another Membrane ball.");
  }

  std::vector<Membrane::Push> Membrane::pushes(const double pressure, const EndPlanes &ends) const
  {
    const auto                       corners = static_cast<std::size_t>(hull.corners);
    std::map<std::int32_t, Vector3d> place;
    for (const auto &facet : hull.facet)
      for (std::size_t c = 0; c < corners; ++c)
        if (place.count(facet[c]) == 0)
          place[facet[c]] = specimen->particle(static_cast<std::size_t>(facet[c])).position;
    Shares shares;
    for (const auto &facet : hull.facet)
      {
        const Vector3d first = place[facet[0]], edge = place[facet[1]] - first;
        const Vector3d area =
          corners == 2 ? Vector3d(edge[1], -edge[0], 0) : Vector3d(0.5 * edge.cross(place[facet[2]] - first));
        for (std::size_t c = 0; c < corners; ++c)
          share(shares, facet[c], area / static_cast<double>(corners));
      }
    (corners == 2 ? add_ends_of_chain : add_ends_of_triangles)(shares, hull, place, ends);
    std::vector<Push> found;
    for (const auto &[particle, area] : shares)
      found.push_back({static_cast<std::size_t>(particle), -pressure * thickness * area});
    return found;
  }

  void Membrane::push(const double pressure, const EndPlanes &ends) const
  {
    for (const Push &each : pushes(pressure, ends))
      specimen->partners().add_force(each.particle, each.force, Vector3d::Zero());
  }

  void Membrane::visit_state(base::StateVisitor &visitor)
  {
    std::vector<std::int32_t> flat;
    for (const auto &facet : hull.facet)
      flat.insert(flat.end(), facet.begin(), facet.end());
    std::int64_t corners = hull.corners;
    visitor.scalar("membrane/corners", corners);
    visitor.column("membrane/facets", flat);
    hull.corners = static_cast<int>(corners);
    hull.facet.resize(flat.size() / 3);
    for (std::size_t f = 0; f < hull.facet.size(); ++f)
      hull.facet[f] = {flat[3 * f], flat[3 * f + 1], flat[3 * f + 2]};
  }
} // namespace dem
