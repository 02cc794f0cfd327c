#include "coupling/volume/peridynamic_handshake.h"

#include "base/errors.h"

#include <algorithm>
#include <string>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;

  void share_with_solid(dem::peridynamics::Bonds &bonds, const VolumeCouplingParameters &parameters)
  {
    const dem::peridynamics::Grid &grid = bonds.grid();
    base::Column                   part(grid.places(), 1.0);
    for (const std::size_t i : grid.nodes())
      {
        const Vector3d x = grid.position(i);
        if (parameters.overlap.distance(x) > parameters.overlap.width * (1 + 1e-9))
          throw base::InputError(parameters.name + ": the peridynamic node " + std::to_string(grid.number(i) + 1) +
                                 " lies beyond the overlap. Let the peridynamic body end with it.");
        part[i] = parameters.overlap.of_particles(x);
      }
    bonds.share(part);
  }

  template <int dim>
  PeridynamicHandshake<dim>::PeridynamicHandshake(PeridynamicParticipant         &core_,
                                                  const fem::Solid<dim>          &solid_,
                                                  fem::ExplicitSolver<dim>       &motion_,
                                                  SolidParticipant<dim>          &around_,
                                                  const VolumeCouplingParameters &parameters)
    : core(core_)
    , solid(solid_)
    , motion(motion_)
    , around(around_)
    , own(parameters)
    , node_map(solid_, around_)
    , predicted(solid_.make_vector())
  {
    find_nodes();
    weigh();
  }

  template <int dim>
  void PeridynamicHandshake<dim>::find_nodes()
  {
    for (std::size_t n = 0; n < core.carriers(); ++n)
      {
        const Vector3d x = core.position(n); // undeformed: nothing has moved yet
        if (!own.overlap.contains(x))
          continue;
        if (!node_map.enter(x))
          throw base::InputError(own.name + ": the peridynamic node " + std::to_string(n + 1) +
                                 " lies in the overlap, but not in the solid. Let the mesh reach through the overlap.");
        carriers.push_back(n);
      }
    if (carriers.empty())
      throw base::InputError(own.name + ": no peridynamic node lies in the overlap.");
    weights = weights_of(node_map.take(), carriers.size(), node_map.nodes().size());
  }

  template <int dim>
  void PeridynamicHandshake<dim>::weigh()
  {
    const auto  rows = static_cast<Index>(carriers.size()), columns = static_cast<Index>(node_map.nodes().size());
    CarrierRows of_core = CarrierRows::Zero(rows, 3), of_solid = CarrierRows::Zero(columns, 3);
    core_mass  = CarrierRows::Zero(rows, 3);
    solid_mass = CarrierRows::Zero(columns, 3);
    for (Index k = 0; k < rows; ++k)
      for (int c = 0; c < dim; ++c)
        {
          const std::size_t n = carriers[static_cast<std::size_t>(k)];
          core_mass(k, c)     = core.mass(n);
          of_core(k, c)       = core.is_held(n, c) ? 0.0 : 1 / core.mass(n);
        }
    for (Index k = 0; k < columns; ++k)
      for (int c = 0; c < dim; ++c)
        {
          const std::size_t n = node_map.nodes()[static_cast<std::size_t>(k)];
          solid_mass(k, c)    = around.mass(n);
          // What is prescribed has no force for a velocity.
          const bool held = motion.force_for_velocity(around.displacements(n)[static_cast<std::size_t>(c)], 1.0) == 0;
          of_solid(k, c)  = held ? 0.0 : 1 / around.mass(n);
        }
    // Cells of the grid end where the overlap does: each node counts as a whole.
    const Eigen::VectorXd parts =
      own.compatibility == Compatibility::coarse ? Eigen::VectorXd(Eigen::VectorXd::Ones(rows)) : Eigen::VectorXd();
    multipliers.emplace(weights, of_core, of_solid, parts, own.lumped);
  }

  template <int dim>
  void PeridynamicHandshake<dim>::keep_account(const CarrierRows    &of_core,
                                               const CarrierRows    &of_solid,
                                               const CarrierChanges &change)
  {
    const CarrierRows to_core  = core_mass.cwiseProduct(change.particles),
                      to_solid = solid_mass.cwiseProduct(change.nodes);
    given_to_core += to_core.colwise().sum().transpose();
    given_to_solid += to_solid.colwise().sum().transpose();
    // Work is done on the mean of the velocities half a step before and after, as in the accounts of both sides.
    for (Index k = 0; k < of_core.rows(); ++k)
      done_on_core += 0.5 * to_core.row(k).dot(of_core.row(k) + change.particles.row(k) +
                                               core.velocity(carriers[static_cast<std::size_t>(k)]).transpose());
    for (Index k = 0; k < of_solid.rows(); ++k)
      done_on_solid +=
        0.5 * to_solid.row(k).dot(of_solid.row(k) + change.nodes.row(k) +
                                  around.velocity(node_map.nodes()[static_cast<std::size_t>(k)]).transpose());
  }

  template <int dim>
  void PeridynamicHandshake<dim>::advance(const double step)
  {
    motion.predict(step, predicted);
    CarrierRows of_core = CarrierRows::Zero(core_mass.rows(), 3), of_solid = CarrierRows::Zero(solid_mass.rows(), 3);
    for (Index k = 0; k < of_core.rows(); ++k)
      of_core.row(k) = core.velocity_ahead(carriers[static_cast<std::size_t>(k)], step).transpose();
    for (Index k = 0; k < of_solid.rows(); ++k)
      for (int c = 0; c < dim; ++c)
        of_solid(k, c) =
          predicted[around.displacements(node_map.nodes()[static_cast<std::size_t>(k)])[static_cast<std::size_t>(c)]];
    const CarrierChanges change = multipliers->changes(of_core, of_solid);
    keep_account(of_core, of_solid, change);
    for (Index k = 0; k < of_core.rows(); ++k)
      core.apply_impulse(carriers[static_cast<std::size_t>(k)], change.particles.row(k).transpose());
    for (Index k = 0; k < of_solid.rows(); ++k)
      around.apply_impulse(node_map.nodes()[static_cast<std::size_t>(k)], change.nodes.row(k).transpose());
    CarrierRows between = of_core + change.particles - weights * (of_solid + change.nodes);
    if (own.compatibility == Compatibility::coarse) // the mean around each node
      {
        CarrierRows           sums  = weights.transpose() * between;
        const Eigen::VectorXd whole = weights.transpose() * Eigen::VectorXd::Ones(weights.rows());
        for (Index k = 0; k < sums.rows(); ++k)
          sums.row(k) /= whole[k] > 0 ? whole[k] : 1.0;
        between = sums;
      }
    left_apart = between.rowwise().norm().maxCoeff();
    core.advance(step, 1);
    around.advance(step, 1);
  }

  template <int dim>
  void PeridynamicHandshake<dim>::visit_state(base::StateVisitor &visitor)
  {
    base::Column given(6);
    Eigen::Map<Vector3d>(given.data())     = given_to_core;
    Eigen::Map<Vector3d>(given.data() + 3) = given_to_solid;
    visitor.column("given", given);
    given_to_core  = Eigen::Map<Vector3d>(given.data());
    given_to_solid = Eigen::Map<Vector3d>(given.data() + 3);
    visitor.scalar("work_on_core", done_on_core);
    visitor.scalar("work_on_solid", done_on_solid);
  }

  template class PeridynamicHandshake<2>;
  template class PeridynamicHandshake<3>;
} // namespace coupling
