#include "dem/laboratory/membrane.h"

#include "base/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>

namespace dem
{
  namespace
  {
    using Eigen::Vector3d;

    /** From a particle straight to the platen that is nearer. */
    Vector3d to_platen(const Vector3d &place, const EndPlanes &ends)
    {
      Vector3d there   = place;
      there[ends.axis] = 2 * place[ends.axis] < ends.low + ends.high ? ends.low : ends.high;
      return there;
    }

    /** Where a chain ends it goes on to the platen. @param goes_on how many segments more begin at a corner than end there */
    void add_ends_of_chain(std::vector<Vector3d>       &share,
                           const std::vector<Vector3d> &place,
                           const std::vector<int>      &goes_on,
                           const EndPlanes             &ends)
    {
      for (std::size_t i = 0; i < place.size(); ++i)
        {
          const Vector3d edge = goes_on[i] * (place[i] - to_platen(place[i], ends));
          share[i] += Vector3d(edge[1], -edge[0], 0);
        }
    }

    /** The same of the border of triangles. */
    void add_ends_of_triangles(std::vector<Vector3d>                         &share,
                               const std::vector<Vector3d>                   &place,
                               const std::vector<std::array<std::size_t, 2>> &border,
                               const EndPlanes                               &ends)
    {
      for (const auto &[i, j] : border)
        {
          const Vector3d from = place[j], to = place[i], below_to = to_platen(to, ends),
                         below_from = to_platen(from, ends);
          const Vector3d area = 0.5 * ((to - from).cross(below_to - from) + (below_to - from).cross(below_from - from));
          share[i] += 0.5 * area;
          share[j] += 0.5 * area;
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
    number_corners();
  }

  void Membrane::number_corners()
  {
    const auto corners = static_cast<std::size_t>(hull.corners);
    particles.clear();
    for (const auto &each : hull.facet)
      particles.insert(particles.end(), each.begin(), each.begin() + hull.corners);
    std::sort(particles.begin(), particles.end());
    particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
    facet.assign(hull.facet.size(), {});
    goes_on.assign(particles.size(), 0);
    std::set<std::array<std::size_t, 2>> edges;
    for (std::size_t f = 0; f < facet.size(); ++f)
      {
        for (std::size_t c = 0; c < corners; ++c)
          facet[f][c] = static_cast<std::size_t>(
            std::lower_bound(particles.begin(), particles.end(), hull.facet[f][c]) - particles.begin());
        ++goes_on[facet[f][0]];
        --goes_on[facet[f][1]];
        if (corners == 3)
          for (std::size_t c = 0; c < 3; ++c)
            edges.insert({facet[f][c], facet[f][(c + 1) % 3]});
      }
    border.clear();
    for (const auto &[i, j] : edges)
      if (edges.count({j, i}) == 0)
        border.push_back({i, j});
  }

  std::vector<Membrane::Push> Membrane::pushes(const double pressure, const EndPlanes &ends) const
  {
    const auto            corners = static_cast<std::size_t>(hull.corners);
    std::vector<Vector3d> place(particles.size()), share(particles.size(), Vector3d::Zero()); // areas to bear [m^2]
    for (std::size_t i = 0; i < place.size(); ++i)
      place[i] = specimen->particle(static_cast<std::size_t>(particles[i])).position;
    for (const auto &each : facet)
      {
        const Vector3d first = place[each[0]], edge = place[each[1]] - first;
        const Vector3d area =
          corners == 2 ? Vector3d(edge[1], -edge[0], 0) : Vector3d(0.5 * edge.cross(place[each[2]] - first));
        for (std::size_t c = 0; c < corners; ++c)
          share[each[c]] += area / static_cast<double>(corners);
      }
    if (corners == 2)
      add_ends_of_chain(share, place, goes_on, ends);
    else
      add_ends_of_triangles(share, place, border, ends);
    std::vector<Push> found;
    for (std::size_t i = 0; i < share.size(); ++i)
      found.push_back({static_cast<std::size_t>(particles[i]), -pressure * thickness * share[i]});
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
    number_corners();
  }
} // namespace dem
