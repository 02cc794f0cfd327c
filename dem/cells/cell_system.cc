#include "dem/cells/cell_system.h"

#include <Eigen/Geometry>

namespace dem
{
  namespace
  {
    /** Change of the parameters' forces under a motion. */
    base::Vector6
    load_forces(const LoadedNetwork &loaded, const std::vector<base::Matrix6> &stiffness, const LoadedMotion &motion)
    {
      base::Vector6 sum = base::Vector6::Zero();
      for (std::size_t i = 0; i < stiffness.size(); ++i)
        {
          base::Vector6 strained;
          strained << slip_of(loaded, i, motion), turn_of(loaded, i, motion);
          sum += loaded.load_slip[i].transpose() * (stiffness[i].topRows<3>() * strained);
        }
      return sum;
    }

    /** On the particles, while the parameters change and nothing else moves: what has to be balanced. */
    CarrierMotions forces_of_change(const LoadedNetwork              &loaded,
                                    const std::vector<base::Matrix6> &stiffness,
                                    const base::Vector6              &change)
    {
      CarrierMotions sum = CarrierMotions::Zero(motions, static_cast<Eigen::Index>(loaded.held.size()));
      for (std::size_t i = 0; i < stiffness.size(); ++i)
        {
          const ElasticLink    &l     = loaded.network.links[i];
          const base::Vector6   f     = stiffness[i].leftCols<3>() * (loaded.load_slip[i] * change);
          const Eigen::Vector3d force = f.head<3>(), moment = f.tail<3>(), turning = l.direction.cross(force);
          sum.col(l.first).head<3>() += force;
          sum.col(l.first).tail<3>() += l.arm_first * turning + moment;
          sum.col(l.second).head<3>() -= force;
          sum.col(l.second).tail<3>() += l.arm_second * turning - moment;
        }
      for (std::size_t i = 0; i < loaded.held.size(); ++i)
        for (int c = 0; c < motions; ++c)
          if (loaded.held[i] >> c & 1)
            sum(c, static_cast<Eigen::Index>(i)) = 0;
      return sum;
    }
  } // namespace

  CellSystem::CellSystem(const LoadedNetwork &network, const bool iterates)
    : loaded(network)
    , may_iterate(iterates && network.network.dimension == 3 && !network.body && !network.ties)
    , factor(network)
  {
  }

  TangentIteration *CellSystem::iteration_for(const std::vector<base::Matrix6> &stiffness)
  {
    if (!may_iterate)
      return nullptr;
    if (!iteration)
      iteration.emplace(loaded);
    return iteration->set(stiffness) ? &*iteration : nullptr;
  }

  bool CellSystem::solve(const std::vector<base::Matrix6> &stiffness,
                         const Unbalanced                 &unbalanced,
                         const base::Vector6              &change,
                         const double                      accuracy,
                         LoadedMotion                     &correction)
  {
    if (TangentIteration *const by_iteration = iteration_for(stiffness))
      {
        CarrierMotions force = unbalanced.particles;
        if (!change.isZero(0))
          force += forces_of_change(loaded, stiffness, change);
        correction.loads = change;
        if (by_iteration->solve(force, accuracy, correction.particles))
          return true;
      }
    return factor.solve_driven(stiffness, unbalanced, change, correction);
  }

  bool CellSystem::condense(const std::vector<base::Matrix6> &stiffness, const double accuracy, base::Matrix6 &forces)
  {
    Rates rates;
    return condense(stiffness, accuracy, forces, rates);
  }

  bool CellSystem::condense(const std::vector<base::Matrix6> &stiffness,
                            const double                      accuracy,
                            base::Matrix6                    &forces,
                            Rates                            &rates)
  {
    TangentIteration *const by_iteration = iteration_for(stiffness);
    if (by_iteration && condense(stiffness, accuracy, *by_iteration, forces, rates))
      return true;
    rates.fill(CarrierMotions());
    return factor.condense(stiffness, forces);
  }

  bool CellSystem::condense(const std::vector<base::Matrix6> &stiffness,
                            const double                      accuracy,
                            TangentIteration                 &by_iteration,
                            base::Matrix6                    &forces,
                            Rates                            &rates) const
  {
    Rates pushed, left;
    for (std::size_t p = 0; p < 6; ++p)
      pushed[p] = forces_of_change(loaded, stiffness, base::Vector6::Unit(static_cast<Eigen::Index>(p)));
    if (!by_iteration.solve(pushed, accuracy, rates, left))
      return false;
    LoadedMotion answer;
    for (std::size_t p = 0; p < 6; ++p)
      {
        const auto column  = static_cast<Eigen::Index>(p);
        answer.loads       = base::Vector6::Unit(column);
        answer.particles   = rates[p];
        forces.col(column) = load_forces(loaded, stiffness, answer);
        // What is left over would move the particles once more. By symmetry that meets what they do under the other parameters; where links
        // slide it is so but for their share.
        for (std::size_t q = 0; q < 6; ++q)
          forces(static_cast<Eigen::Index>(q), column) -= rates[q].cwiseProduct(left[p]).sum();
      }
    return forces.allFinite();
  }
} // namespace dem
