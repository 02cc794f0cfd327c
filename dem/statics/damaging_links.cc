#include "dem/statics/damaging_links.h"

#include "dem/statics/stiffness_operator.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    Eigen::Vector3d vector(const Vec<double, 3> &v) { return {v[0], v[1], v[2]}; }
    Vec<double, 3>  vector(const Eigen::Vector3d &v) { return {{v[0], v[1], v[2]}}; }
  } // namespace

  Eigen::Vector3d slip_of(const ElasticLink &l, const CellMotion &motion)
  {
    const auto            J = motion.particles.col(l.first), K = motion.particles.col(l.second);
    const Eigen::Vector3d spin = l.arm_first * J.tail<3>() + l.arm_second * K.tail<3>();
    return K.head<3>() - J.head<3>() + l.direction.cross(spin) + strain_tensor(motion.strain) * l.branch;
  }

  DamagingLinks::DamagingLinks(const ElasticNetwork &links, const CpmParameters &parameters)
    : network(&links)
    , law(parameters)
    , state(links.links.size(), CpmState<double, 3>{})
    , trial(state)
    , shear(state.size(), Eigen::Vector3d::Zero())
    , trial_shear(shear)
    , strain(state.size(), 0.0)
    , trial_strain(strain)
    , response(state.size(), CpmResponse<double, 3>{})
    , force(shear)
    , secant(state.size(), Eigen::Matrix3d::Zero())
  {
  }

  void DamagingLinks::evaluate(const CellMotion &motion)
  {
    const std::int64_t n = static_cast<std::int64_t>(state.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < n; ++i)
      {
        const ElasticLink    &l      = network->links[i];
        const double          length = l.branch.norm();
        const Eigen::Vector3d total  = slip_of(l, motion) / length;
        trial_strain[i]              = l.direction.dot(total);
        trial_shear[i]               = total - trial_strain[i] * l.direction;
        trial[i]                     = state[i];
        trial[i].elastic_shear = vector(Eigen::Vector3d(vector(state[i].elastic_shear) + trial_shear[i] - shear[i]));
        const double elastic   = vector(trial[i].elastic_shear).norm() * law.G;
        response[i]            = Cpm<true, true>::update(law, trial_strain[i], trial_shear[i].squaredNorm(), trial[i]);

        const Eigen::Vector3d shear_stress = vector(response[i].shear_stress);
        force[i]                           = l.area * (response[i].normal_stress * l.direction + shear_stress);

        // A sliding link keeps a thousandth: the stiffness only steers the iteration, and must not lose the particle.
        const double          kept = elastic > 0 ? std::max(shear_stress.norm() / elastic, 1e-3) : 1.0;
        const double          open = trial_strain[i] > 0 ? std::max(1 - trial[i].damage, 1e-6) : 1.0;
        const Eigen::Matrix3d nn   = l.direction * l.direction.transpose();
        secant[i] = l.area / length * (open * law.E * nn + kept * law.G * (Eigen::Matrix3d::Identity() - nn));
      }
  }

  void DamagingLinks::commit()
  {
    for (std::size_t i = 0; i < state.size(); ++i)
      {
        const ElasticLink &l      = network->links[i];
        const double       volume = l.area * l.branch.norm();
        lost += volume * (response[i].plastic_work + response[i].damage_work);
        if (law.shear_weight == 0) // then the pass does not sum up what damage takes; the closed form does
          lost += volume * (law.dissipated_at(trial[i].kappa, trial[i].damage) -
                            law.dissipated_at(state[i].kappa, state[i].damage));
      }
    state  = trial;
    shear  = trial_shear;
    strain = trial_strain;
  }

  double DamagingLinks::growth(const std::size_t i) const
  {
    return std::max(trial[i].kappa - std::max(state[i].kappa, law.onset), 0.0);
  }

  double DamagingLinks::mean_damage() const
  {
    double sum = 0;
    for (const auto &s : state)
      sum += s.damage;
    return sum / static_cast<double>(state.size());
  }

  double DamagingLinks::stored() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
      {
        const double open         = std::max(strain[i], 0.0);
        const double shear_energy = law.G * vector(state[i].elastic_shear).squaredNorm();
        sum += 0.5 * network->links[i].area * network->links[i].branch.norm() *
               (law.E * (strain[i] * strain[i] - state[i].damage * open * open) + shear_energy);
      }
    return sum;
  }
} // namespace dem
