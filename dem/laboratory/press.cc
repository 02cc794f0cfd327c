#include "dem/laboratory/press.h"

#include "base/errors.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    using Eigen::Vector3d;

    const char *const side_name[2] = {"low platen", "high platen"};
    /** Sides of a polygon that stands for a roller: it deviates from it by a thousandth of its radius. */
    constexpr int roller_sides = 72;

    std::string text(const double value)
    {
      std::ostringstream out;
      out << value;
      return out.str();
    }

    /** How far along the axis a roller goes until it touches a particle, beside which it comes from far away. */
    double
    roller_stop(const ParticleKinematics &p, const PressParameters &press, const double at, const Press::Side side)
    {
      const double sense   = side == Press::low ? 1 : -1;
      double       nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < p.position.size(); ++i)
        {
          const double reach = press.roller + p.radius[i], aside = p.position[i][press.along] - at;
          if (std::abs(aside) < reach)
            nearest = std::min(nearest, sense * p.position[i][press.axis] - std::sqrt(reach * reach - aside * aside));
        }
      if (!std::isfinite(nearest))
        throw base::InputError("Laboratory/Span: no particle lies under the roller at " + text(at) +
                               " m. The specimen must reach beyond its supports.");
      return sense * nearest;
    }

    void append(FacetMesh &to, const FacetMesh &added)
    {
      const auto shift = static_cast<std::int32_t>(to.vertex.size());
      to.vertex.insert(to.vertex.end(), added.vertex.begin(), added.vertex.end());
      for (std::array<std::int32_t, 3> facet : added.facet)
        {
          for (std::int32_t &corner : facet)
            corner += shift;
          to.facet.push_back(facet);
        }
      to.corners = added.corners;
    }
  } // namespace

  Press::Press(Specimen &body, const PressParameters &p)
    : specimen(&body)
    , parameters(p)
  {
    const ParticleKinematics particles = body.kinematics();
    const BodyExtent         extent(particles);
    if (p.kind == PressParameters::Kind::platens)
      add_platens(extent);
    else if (p.kind == PressParameters::Kind::glued)
      add_layers(particles);
    else
      add_rollers(particles, extent);
    move(0);
  }

  Vector3d Press::inward(const Side side) const
  {
    Vector3d direction         = Vector3d::Zero();
    direction[parameters.axis] = side == low ? 1 : -1;
    return direction;
  }

  void Press::add_platens(const BodyExtent &body)
  {
    if (!(2 * parameters.smoothing < 0.5 * body.length(parameters.axis)))
      throw base::InputError("Laboratory/Smoothing depth = " + text(parameters.smoothing) + " m: of a specimen of " +
                             text(body.length(parameters.axis)) + " m little would be left.");
    for (const Side side : {low, high})
      {
        Vector3d point         = body.low;
        place[side]            = parameters.stand ? (*parameters.stand)[side] :
                                 side == low      ? body.low[parameters.axis] + parameters.smoothing :
                                                    body.high[parameters.axis] - parameters.smoothing;
        point[parameters.axis] = place[side];
        if (specimen->parameters().physics.dimension == 2)
          point[2] = 0;
        number[side] =
          specimen->surfaces().add({side_name[side], FacetMesh::plane(point, inward(side)), parameters.contact});
        if (parameters.stand || parameters.smoothing > 0)
          specimen->surfaces().cut_off(number[side]);
      }
    start_height = place[high] - place[low];
  }

  void Press::add_layers(const ParticleKinematics &particles)
  {
    const int a     = parameters.axis;
    double    first = std::numeric_limits<double>::infinity(), last = -first;
    for (const Vector3d &x : particles.position)
      {
        first = std::min(first, x[a]);
        last  = std::max(last, x[a]);
      }
    if (!(first + parameters.layer < last - parameters.layer))
      throw base::InputError("Laboratory/Glued layer = " + text(parameters.layer) +
                             " m: the two layers would meet. Particle centres span " + text(last - first) + " m.");
    place = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (const Side side : {low, high})
      {
        Grip grip;
        for (std::size_t i = 0; i < particles.position.size(); ++i)
          {
            const double x = particles.position[i][a];
            if (side == low ? x <= first + parameters.layer : x >= last - parameters.layer)
              {
                grip.particles.push_back(i);
                place[side] = side == low ? std::max(place[side], x) : std::min(place[side], x);
              }
          }
        const Physics &physics = specimen->parameters().physics;
        for (int c = 0; c < physics.dimension; ++c)
          grip.prescribed[static_cast<std::size_t>(c)] = true;
        if (physics.rotations)
          for (std::size_t c = physics.dimension == 2 ? 5 : 3; c < 6; ++c)
            grip.prescribed[c] = true;
        if (parameters.turns)
          grip.turning_face = a;
        number[side] = specimen->grips().add(grip);
      }
    start_height = place[high] - place[low];
  }

  void Press::add_rollers(const ParticleKinematics &particles, const BodyExtent &body)
  {
    const bool   plane  = specimen->parameters().physics.dimension == 2;
    const double middle = body.middle(parameters.along), half = 0.5 * parameters.span;
    const int    across = 3 - parameters.axis - parameters.along;
    for (const Side side : {low, high})
      {
        FacetMesh mesh;
        for (const double at :
             side == low ? std::vector<double>{middle - half, middle + half} : std::vector<double>{middle})
          {
            Vector3d centre          = Vector3d::Zero();
            centre[parameters.along] = at;
            centre[parameters.axis]  = roller_stop(particles, parameters, at, side);
            if (plane)
              append(mesh, circle(centre, parameters.roller, roller_sides));
            else
              {
                Vector3d from = centre, to = centre;
                from[across] = body.low[across] - body.length(across) / 10;
                to[across]   = body.high[across] + body.length(across) / 10;
                append(mesh, cylinder(from, to, parameters.roller, roller_sides, false));
              }
          }
        number[side] = specimen->surfaces().add({side == low ? "supports" : "roller", mesh, parameters.contact});
      }
    start_height = body.length(parameters.axis);
  }

  double Press::side_speed(const Side side, const double speed) const
  {
    return parameters.both ? 0.5 * speed : side == high ? speed : 0.0;
  }

  void Press::move(const double speed)
  {
    if (parameters.kind == PressParameters::Kind::glued)
      {
        glued_travel = approach();
        glued_time   = specimen->time();
        glued_speed  = speed;
        for (const Side side : {low, high})
          specimen->grips().set_velocity(number[side], -side_speed(side, speed) * inward(side), Vector3d::Zero());
        return;
      }
    for (const Side side : {low, high})
      specimen->surfaces().set_motion(number[side], side_speed(side, speed) * inward(side), Vector3d::Zero(),
                                      specimen->surfaces().at(number[side]).centre);
  }

  void Press::hold(const double force, const double largest_speed, const double gain)
  {
    for (const Side side : {low, high})
      specimen->surfaces().hold_at_force(number[side], {inward(side), force, largest_speed, gain});
  }

  double Press::force(const Side side) const
  {
    if (parameters.kind == PressParameters::Kind::glued)
      return -specimen->grips().reaction(number[side]).dot(inward(side));
    return -specimen->surfaces().at(number[side]).total_force.dot(inward(side));
  }

  double Press::approach() const
  {
    if (parameters.kind == PressParameters::Kind::glued)
      return glued_travel + glued_speed * (specimen->time() - glued_time);
    double sum = 0;
    for (const Side side : {low, high})
      sum += specimen->surfaces().at(number[side]).travel.dot(inward(side));
    return sum;
  }

  EndPlanes Press::planes() const
  {
    EndPlanes found{parameters.axis, place[low], place[high]};
    if (parameters.kind == PressParameters::Kind::platens)
      {
        found.low += specimen->surfaces().at(number[low]).travel[parameters.axis];
        found.high += specimen->surfaces().at(number[high]).travel[parameters.axis];
      }
    return found;
  }

  void Press::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("press/glued_travel", glued_travel);
    visitor.scalar("press/glued_speed", glued_speed);
    visitor.scalar("press/glued_time", glued_time);
  }
} // namespace dem
