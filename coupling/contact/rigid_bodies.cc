#include "coupling/contact/rigid_bodies.h"

#include "base/errors.h"
#include "coupling/contact/solid_parts.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace coupling
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  template <int dim>
  RigidBodies<dim>::RigidBodies(const fem::Solid<dim>          &solid,
                                fem::ExplicitSolver<dim>       &motion_,
                                SolidParticipant<dim>          &participant_,
                                const std::vector<std::string> &materials)
    : motion(motion_)
    , participant(participant_)
  {
    if (materials.empty())
      return;
    std::set<dealii::types::material_id> wanted;
    for (const std::string &name : materials)
      {
        const auto found = solid.mesh().materials.find(name);
        if (found == solid.mesh().materials.end())
          throw base::InputError("rigid bodies: the mesh has no material " + name + ".");
        wanted.insert(found->second);
      }
    for (const SolidPart &part : solid_parts(solid, participant))
      {
        const auto rigid = std::count_if(part.materials.begin(), part.materials.end(),
                                         [&](const auto id) { return wanted.count(id) > 0; });
        if (rigid == 0)
          continue;
        if (static_cast<std::size_t>(rigid) < part.materials.size())
          throw base::InputError("rigid bodies: one shares a node with elements of another material. A rigid body "
                                 "is a body of its own.");
        Body &body    = bodies.emplace_back();
        body.carriers = part.carriers;
        begin(body);
        body.group = participant.prescribe(part.carriers, {true, true, dim == 3});
      }
  }

  template <int dim>
  void RigidBodies<dim>::begin(Body &body) const
  {
    body.centre.setZero();
    body.velocity.setZero();
    body.spin_momentum.setZero();
    body.inertia.setZero();
    for (const std::size_t c : body.carriers)
      {
        const double m = participant.mass(c);
        body.mass += m;
        body.centre += m * participant.position(c);
        body.velocity += m * participant.velocity(c);
      }
    body.centre /= body.mass;
    body.velocity /= body.mass;
    for (const std::size_t c : body.carriers)
      {
        const Vector3d arm = participant.position(c) - body.centre;
        body.arm.push_back(arm);
        body.inertia += participant.mass(c) * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
        body.spin_momentum += arm.cross(participant.mass(c) * participant.velocity(c));
      }
  }

  template <int dim>
  void RigidBodies<dim>::drive(const double kick, const double step)
  {
    for (Body &body : bodies)
      move(body, kick, step);
  }

  template <int dim>
  void RigidBodies<dim>::move(Body &body, const double kick, const double step)
  {
    const fem::Vector    &external = motion.external_force();
    Vector3d              force = Vector3d::Zero(), moment = Vector3d::Zero();
    std::vector<Vector3d> before(body.carriers.size());
    for (std::size_t k = 0; k < before.size(); ++k)
      {
        Vector3d push = Vector3d::Zero();
        for (int d = 0; d < dim; ++d)
          push[d] = external[participant.displacements(body.carriers[k])[d]];
        before[k] = participant.position(body.carriers[k]);
        force += push;
        moment += (before[k] - body.centre).cross(push);
      }
    body.velocity += kick / body.mass * force;
    body.spin_momentum += kick * moment;
    body.centre += step * body.velocity;
    // The spin of the middle of the step, where the body has turned half of it: angular momentum is kept to rounding.
    const Matrix3d     unturned = body.inertia.inverse();
    Vector3d           spin     = Vector3d::Zero();
    Eigen::Quaterniond there    = body.turn;
    const auto         turned   = [&](const Vector3d &by) {
      const double angle = by.norm();
      return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, by / angle)) * body.turn : body.turn;
    };
    for (int iteration = 0; iteration < 4; ++iteration)
      {
        const Matrix3d r = turned(0.5 * step * spin).toRotationMatrix();
        spin             = r * unturned * r.transpose() * body.spin_momentum;
      }
    there     = turned(step * spin).normalized();
    body.turn = there;
    std::vector<Vector3d> velocity(before.size());
    for (std::size_t k = 0; k < before.size(); ++k)
      velocity[k] = (body.centre + there * body.arm[k] - before[k]) / step;
    participant.set_motion(body.group, velocity);
  }

  template <int dim>
  void RigidBodies<dim>::visit_state(base::StateVisitor &visitor)
  {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      {
        Body             &body  = bodies[b];
        const std::string group = "rigid_body_" + std::to_string(b) + "_";
        base::Column      all;
        for (const Vector3d *v : {&body.centre, &body.velocity, &body.spin_momentum})
          all.insert(all.end(), v->data(), v->data() + 3);
        all.insert(all.end(), body.turn.coeffs().data(), body.turn.coeffs().data() + 4);
        visitor.column(group + "motion", all);
        body.centre        = Vector3d(all[0], all[1], all[2]);
        body.velocity      = Vector3d(all[3], all[4], all[5]);
        body.spin_momentum = Vector3d(all[6], all[7], all[8]);
        body.turn.coeffs() = Eigen::Vector4d(all[9], all[10], all[11], all[12]);
      }
  }

  template class RigidBodies<2>;
  template class RigidBodies<3>;
} // namespace coupling
