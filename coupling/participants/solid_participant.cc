#include "coupling/participants/solid_participant.h"

#include "base/errors.h"
#include "coupling/participants/window.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_accessor.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace coupling
{
  using Eigen::Vector3d;

  template <int dim>
  SolidParticipant<dim>::SolidParticipant(fem::Solid<dim> &solid_, fem::ExplicitSolver<dim> &motion_)
    : solid(solid_)
    , motion(motion_)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(solid.communicator()) > 1)
      throw base::InputError("participant: a solid spread over several ranks cannot be coupled yet. Start one.");
    const auto                                     &fe = solid.dofs().get_fe();
    std::map<dealii::types::global_dof_index, Node> found; // by the number of the first displacement
    std::vector<dealii::types::global_dof_index>    indices(fe.n_dofs_per_cell());
    for (const auto &cell : solid.dofs().active_cell_iterators())
      {
        cell->get_dof_indices(indices);
        std::vector<Node> local(fe.n_dofs_per_cell() / dim);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const auto [component, node] = fe.system_to_component_index(i);
            local[node].dofs[component]  = indices[i];
            const auto x                 = solid.mapping().transform_unit_to_real_cell(cell, fe.unit_support_point(i));
            local[node].place            = {x[0], x[1], dim == 3 ? x[dim - 1] : 0.0};
          }
        for (const Node &node : local)
          found.emplace(node.dofs[0], node);
      }
    for (const auto &entry : found)
      nodes.push_back(entry.second);
  }

  template <int dim>
  std::size_t SolidParticipant<dim>::carriers() const
  {
    return nodes.size();
  }

  template <int dim>
  const std::array<dealii::types::global_dof_index, dim> &
  SolidParticipant<dim>::displacements(const std::size_t carrier) const
  {
    return nodes.at(carrier).dofs;
  }

  template <int dim>
  std::size_t SolidParticipant<dim>::carrier_of(const dealii::types::global_dof_index first) const
  {
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), first,
                                     [](const Node &node, const auto number) { return node.dofs[0] < number; });
    return static_cast<std::size_t>(at - nodes.begin());
  }

  template <int dim>
  Vector3d SolidParticipant<dim>::value(const fem::Vector &field, const std::size_t carrier) const
  {
    Vector3d sum = Vector3d::Zero();
    for (int c = 0; c < dim; ++c)
      sum[c] = field[nodes.at(carrier).dofs[c]];
    return sum;
  }

  template <int dim>
  Vector3d SolidParticipant<dim>::position(const std::size_t carrier) const
  {
    return nodes.at(carrier).place + value(motion.displacement(), carrier);
  }

  template <int dim>
  Vector3d SolidParticipant<dim>::velocity(const std::size_t carrier) const
  {
    return value(motion.velocity(), carrier);
  }

  template <int dim>
  double SolidParticipant<dim>::mass(const std::size_t carrier) const
  {
    return motion.mass()[nodes.at(carrier).dofs[0]];
  }

  template <int dim>
  double SolidParticipant<dim>::time() const
  {
    return motion.time();
  }

  template <int dim>
  double SolidParticipant<dim>::stable_step() const
  {
    return motion.step();
  }

  template <int dim>
  ParticipantEnergy SolidParticipant<dim>::energy() const
  {
    const fem::ExplicitEnergy &e = motion.energy();
    return {e.start, e.external, e.kinetic, e.internal + e.damped, std::fabs(e.balance())};
  }

  template <int dim>
  void SolidParticipant<dim>::advance(const double window, const int steps)
  {
    walk_window(*this, window, steps, [&](const double step) { motion.advance(step); });
    motion.clear_forces();
  }

  template <int dim>
  void SolidParticipant<dim>::add_force(const std::size_t carrier, const Vector3d &force)
  {
    for (int c = 0; c < dim; ++c)
      motion.add_force(nodes.at(carrier).dofs[c], force[c]);
  }

  template <int dim>
  void SolidParticipant<dim>::add_couple(std::size_t, const Vector3d &)
  {
    throw std::logic_error("participant: a node of a solid cannot turn, and takes no couple.");
  }

  template <int dim>
  void SolidParticipant<dim>::apply_impulse(const std::size_t carrier, const Vector3d &change)
  {
    for (int c = 0; c < dim; ++c)
      motion.apply_impulse(nodes.at(carrier).dofs[c], change[c]);
  }

  template <int dim>
  std::size_t SolidParticipant<dim>::prescribe(const std::vector<std::size_t> &carriers,
                                               const std::array<bool, 3>      &along)
  {
    groups.push_back({carriers, along});
    set_motion(groups.size() - 1, std::vector<Vector3d>(carriers.size(), Vector3d::Zero()));
    return groups.size() - 1;
  }

  template <int dim>
  void SolidParticipant<dim>::set_motion(const std::size_t group, const std::vector<Vector3d> &velocity)
  {
    const Group &g = groups.at(group);
    if (velocity.size() != g.carriers.size())
      throw base::InputError("participant: a group of " + std::to_string(g.carriers.size()) + " nodes was given " +
                             std::to_string(velocity.size()) + " velocities.");
    for (std::size_t k = 0; k < velocity.size(); ++k)
      for (int c = 0; c < dim; ++c)
        if (g.along[c])
          motion.prescribe(nodes.at(g.carriers[k]).dofs[c], velocity[k][c]);
  }

  template <int dim>
  Reaction SolidParticipant<dim>::reaction(const std::size_t group, const Vector3d &about) const
  {
    Reaction sum;
    for (const std::size_t carrier : groups.at(group).carriers)
      {
        Vector3d force = Vector3d::Zero();
        for (int c = 0; c < dim; ++c)
          if (groups[group].along[c])
            force[c] = motion.reaction(nodes.at(carrier).dofs[c]);
        // Small displacements: moments balance about the undeformed places.
        const Vector3d place = solid.options().large_displacement ? position(carrier) : nodes[carrier].place;
        sum.force += force;
        sum.moment += (place - about).cross(force);
      }
    return sum;
  }

  template <int dim>
  void SolidParticipant<dim>::save()
  {
    saved = Saved{motion.state(), solid.saved_points()};
  }

  template <int dim>
  void SolidParticipant<dim>::restore()
  {
    if (!saved)
      throw std::logic_error("participant: no state has been saved.");
    motion.restore(saved->motion);
    solid.restore_points(saved->points);
  }

  template class SolidParticipant<2>;
  template class SolidParticipant<3>;
} // namespace coupling
