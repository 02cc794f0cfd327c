#include "dem/facets/surface.h"

#include "base/errors.h"
#include "dem/kernels/kinematics.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    /** x turned about the origin by the rotation vector. */
    Eigen::Vector3d turned(const Eigen::Vector3d &turn, const Eigen::Vector3d &x)
    {
      const auto            c    = rotation_coefficients(turn.squaredNorm());
      const Eigen::Vector3d once = turn.cross(x);
      return x + c.sine * once + c.versine * turn.cross(once);
    }
  } // namespace

  Surface::Surface(const SurfaceParameters &p, const Physics &physics, std::vector<bool> particles)
    : name(p.name)
    , mesh(p.mesh)
    , law(p.contact, physics, p.name)
    , skin(p.skin)
    , footprint(p.spread ? Footprint(p.mesh) : Footprint())
    , meets(std::move(particles))
    , place(mesh.vertex)
    , motion(place.size(), Eigen::Vector3d::Zero())
    , force(motion)
    , impulse(motion)
    , turn_impulse(motion)
    , stiffness(place.size(), 0.0)
  {
    if (skin > 0 && !law.linear())
      throw base::InputError(
        "wall " + name +
        ": pressure on areas takes linear contacts without a dashpot. Let its contacts act at points.");
    for (std::size_t facet = 0; skin > 0 && facet < mesh.size(); ++facet)
      {
        const auto corner = [&](const std::size_t c) { return place[static_cast<std::size_t>(mesh.facet[facet][c])]; };
        const Eigen::Vector3d edge = corner(1) - corner(0);
        area.push_back(mesh.corners == 3 ? 0.5 * edge.cross(Eigen::Vector3d(corner(2) - corner(0))).norm() :
                                           edge.norm());
      }
  }

  double Surface::distance(const std::size_t facet, const Eigen::Vector3d &x) const
  {
    return mesh.is_plane() ? mesh.normal.dot(x - place[0]) : (x - closest_on_facet(mesh, place, facet, x).place).norm();
  }

  FacetBounds Surface::bounds(const std::size_t facet) const
  {
    const auto corner = [&](const std::size_t c) -> const Eigen::Vector3d & {
      return place[static_cast<std::size_t>(mesh.facet[facet][c])];
    };
    FacetBounds found{corner(0), corner(0), Eigen::Vector3d::Zero(), corner(0)};
    for (std::size_t c = 1; c < static_cast<std::size_t>(mesh.corners); ++c)
      {
        found.low  = found.low.cwiseMin(corner(c));
        found.high = found.high.cwiseMax(corner(c));
      }
    found.normal = facet_normal({{corner(0), corner(1), mesh.corners == 3 ? corner(2) : corner(1)}}, mesh.corners == 2);
    return found;
  }

  Eigen::Vector3d Surface::turn_of(const std::size_t facet) const
  {
    if (driven != Driven::by_vertex)
      return turn;
    // Of a triangle (or segment) driven by its corners: how its plane has tilted, and its mean twist about the normal.
    const auto                     n = static_cast<std::size_t>(mesh.corners);
    std::array<Eigen::Vector3d, 3> now, moved_by;
    Eigen::Vector3d                mean = Eigen::Vector3d::Zero(), mean_motion = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < n; ++c)
      {
        const auto v = static_cast<std::size_t>(mesh.facet[facet][c]);
        now[c]       = place[v];
        moved_by[c]  = motion[v];
        mean += now[c] / static_cast<double>(n);
        mean_motion += moved_by[c] / static_cast<double>(n);
      }
    double          spread = 0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < n; ++c)
      {
        const Eigen::Vector3d u = moved_by[c] - mean_motion, y = now[c] - mean - 0.5 * u;
        moment += y.cross(u);
        spread += y.squaredNorm();
      }
    if (n == 2) // a segment turns about z
      return moment / spread;
    const Eigen::Vector3d normal = (now[1] - now[0]).cross(now[2] - now[0]).normalized(),
                          before = (now[1] - moved_by[1] - now[0] + moved_by[0])
                                     .cross(now[2] - moved_by[2] - now[0] + moved_by[0])
                                     .normalized();
    return before.cross(normal) + normal * (normal.dot(moment) / spread);
  }

  void Surface::clear_totals()
  {
    total_force.setZero();
    total_moment.setZero();
    along    = 0;
    touching = 0;
    glued    = 0;
  }

  void Surface::take_impulse(const std::size_t vertex, const Eigen::Vector3d &taken)
  {
    impulse[vertex] += taken;
    turn_impulse[vertex] += place[vertex].cross(taken);
  }

  void Surface::clear_impulses()
  {
    std::fill(impulse.begin(), impulse.end(), Eigen::Vector3d::Zero());
    std::fill(turn_impulse.begin(), turn_impulse.end(), Eigen::Vector3d::Zero());
  }

  void Surface::serve(const double step)
  {
    if (driven != Driven::by_force)
      return;
    const double lacking = servo.force + total_force.dot(servo.direction); // on the particles it acts the other way
    double       speed   = std::copysign(servo.largest_speed, lacking);
    if (along > 0)
      speed = std::min(std::max(servo.gain * lacking / (along * step), -servo.largest_speed), servo.largest_speed);
    velocity = speed * servo.direction;
  }

  double Surface::advance(const double step)
  {
    if (still() && !moved)
      return 0;
    double largest = 0;
    if (driven == Driven::by_vertex)
      for (std::size_t v = 0; v < place.size(); ++v)
        motion[v] = step * rate[v];
    else
      {
        turn                          = step * spin;
        const Eigen::Vector3d forward = step * velocity;
        for (std::size_t v = 0; v < place.size(); ++v)
          {
            motion[v] = forward;
            if (!turn.isZero(0))
              motion[v] += turned(turn, place[v] - centre) - (place[v] - centre);
          }
        centre += forward;
        travel += forward;
      }
    for (std::size_t v = 0; v < place.size(); ++v)
      {
        place[v] += motion[v];
        largest = std::max(largest, motion[v].squaredNorm());
      }
    moved = !still();
    return std::sqrt(largest);
  }

  namespace
  {
    void visit(base::StateVisitor &visitor, const std::string &name, std::vector<Eigen::Vector3d> &vectors)
    {
      base::Column flat;
      for (const Eigen::Vector3d &v : vectors)
        flat.insert(flat.end(), v.data(), v.data() + 3);
      visitor.column(name, flat);
      vectors.resize(flat.size() / 3);
      for (std::size_t v = 0; v < vectors.size(); ++v)
        vectors[v] = Eigen::Vector3d(&flat[3 * v]);
    }

    void visit(base::StateVisitor &visitor, const std::string &name, Eigen::Vector3d &vector)
    {
      for (int c = 0; c < 3; ++c)
        visitor.scalar(name + "_" + "xyz"[c], vector[c]);
    }
  } // namespace

  void Surface::visit_state(base::StateVisitor &visitor, const std::string &group)
  {
    const auto named = [&](const char *item) { return group + "/" + item; };
    visit(visitor, named("place"), place);
    visit(visitor, named("motion"), motion);
    visit(visitor, named("rate"), rate);
    visitor.column(named("cut"), cut);
    visit(visitor, named("force"), force);
    visit(visitor, named("impulse"), impulse);
    visit(visitor, named("turn_impulse"), turn_impulse);
    base::Column stiff(stiffness.begin(), stiffness.end());
    visitor.column(named("stiffness"), stiff);
    stiffness.assign(stiff.begin(), stiff.end());
    for (const auto &[name_of_vector, vector] :
         std::initializer_list<std::pair<const char *, Eigen::Vector3d *>>{{"velocity", &velocity},
                                                                           {"spin", &spin},
                                                                           {"centre", &centre},
                                                                           {"turn", &turn},
                                                                           {"travel", &travel},
                                                                           {"total_force", &total_force},
                                                                           {"total_moment", &total_moment},
                                                                           {"momentum", &momentum},
                                                                           {"angular_momentum", &angular_momentum},
                                                                           {"servo_direction", &servo.direction}})
      visit(visitor, named(name_of_vector), *vector);
    visitor.scalar(named("servo_force"), servo.force);
    visitor.scalar(named("work"), work);
    visitor.scalar(named("made"), made);
    visitor.scalar(named("along"), along);
    visitor.scalar(named("touching"), touching);
    visitor.scalar(named("glued"), glued);
    visitor.scalar(named("torn"), torn);
    std::int64_t was_moved = moved ? 1 : 0;
    visitor.scalar(named("moved"), was_moved);
    moved = was_moved != 0;
  }
} // namespace dem
