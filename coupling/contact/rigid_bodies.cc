#include "coupling/contact/rigid_bodies.h"

#include <deal.II/dofs/dof_accessor.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace coupling
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  namespace
  {
    /** Carriers of each part of these materials that hangs together. */
    template <int dim>
    std::vector<std::vector<std::size_t>> parts_of(const fem::Solid<dim>                      &solid,
                                                   const SolidParticipant<dim>                &participant,
                                                   const std::set<dealii::types::material_id> &materials)
    {
      std::map<dealii::types::global_dof_index, std::size_t> carrier_of; // by the first displacement
      for (std::size_t i = 0; i < participant.carriers(); ++i)
        carrier_of.emplace(participant.displacements(i)[0], i);
      std::vector<std::size_t> root(participant.carriers());
      for (std::size_t i = 0; i < root.size(); ++i)
        root[i] = i;
      const auto find = [&](std::size_t i) {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      };
      std::set<std::size_t>                        rigid, others;
      const unsigned int                           n = solid.dofs().get_fe().n_dofs_per_cell();
      std::vector<dealii::types::global_dof_index> indices(n);
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          cell->get_dof_indices(indices);
          std::size_t first = 0;
          bool        any   = false;
          for (const auto index : indices)
            if (const auto found = carrier_of.find(index); found != carrier_of.end())
              {
                if (materials.count(cell->material_id()) == 0)
                  {
                    others.insert(found->second);
                    continue;
                  }
                rigid.insert(found->second);
                if (any)
                  root[find(found->second)] = find(first);
                first = found->second;
                any   = true;
              }
        }
      std::map<std::size_t, std::vector<std::size_t>> found;
      for (const std::size_t carrier : rigid)
        {
          if (others.count(carrier) > 0)
            throw std::invalid_argument(
              "rigid bodies: one shares a node with elements of another material. A rigid body "
              "is a body of its own.");
          found[find(carrier)].push_back(carrier);
        }
      std::vector<std::vector<std::size_t>> parts;
      for (auto &entry : found)
        parts.push_back(std::move(entry.second));
      return parts;
    }
  } // namespace

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
          throw std::invalid_argument("rigid bodies: the mesh has no material " + name + ".");
        wanted.insert(found->second);
      }
    for (const auto &carriers : parts_of(solid, participant, wanted))
      {
        Body &body    = bodies.emplace_back();
        body.carriers = carriers;
        begin(body);
        body.group = participant.prescribe(carriers, {true, true, dim == 3});
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
  void RigidBodies<dim>::lead(const double kick, const double step)
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
  void RigidBodies<dim>::visit_state(dem::StateVisitor &visitor)
  {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      {
        Body             &body  = bodies[b];
        const std::string group = "rigid_body_" + std::to_string(b) + "_";
        dem::Column       all;
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
