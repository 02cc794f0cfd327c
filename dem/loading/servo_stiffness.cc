#include "dem/loading/servo_stiffness.h"

#include "dem/core/symmetric_modes.h"
#include "dem/specimen/observation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace dem
{
  namespace
  {
    /** Components that there are. */
    std::vector<int> components(const ObservedSpecimen &specimen)
    {
      if (specimen.parameters().physics.dimension == 2)
        return {0, 1, 5};
      return {0, 1, 2, 3, 4, 5};
    }

    bool resists_every_strain(const base::Matrix6 &stiffness, const std::vector<int> &there)
    {
      constexpr double      least = 1e-3; // of the largest
      const Eigen::VectorXd modes = symmetric_modes(stiffness(there, there)).values;
      return modes.minCoeff() > least * modes.maxCoeff();
    }

    /** The same with no direction softer than a modulus. */
    base::Matrix6 at_least(const double modulus, const base::Matrix6 &stiffness, const std::vector<int> &there)
    {
      const SymmetricModes modes  = symmetric_modes(stiffness(there, there));
      base::Matrix6        result = base::Matrix6::Zero();
      result(there, there) = modes.vectors * modes.values.cwiseMax(modulus).asDiagonal() * modes.vectors.transpose();
      return result;
    }

    double mass_of(const ParticleKinematics &particles)
    {
      return std::accumulate(particles.mass.begin(), particles.mass.end(), 0.0);
    }

    /**
     * Modulus of equal spheres in closest packing that each have the stiffness around them that the time step allows for [Pa]: with twelve
     * springs k at a distance d it is sqrt(2) k/d, the density sqrt(2) m/d^3 and the step sqrt(2 m/(12 k)), hence density (d/step)^2/6.
     */
    double modulus_of_step(const ObservedSpecimen &specimen)
    {
      const ParticleKinematics particles = specimen.kinematics();
      const double             least     = *std::min_element(particles.radius.begin(), particles.radius.end());
      const double             speed     = 2 * least * specimen.parameters().step_factor / specimen.longest_step();
      return mass_of(particles) / specimen.cell().volume * speed * speed / 6;
    }
  } // namespace

  ServoStiffness::ServoStiffness(const ObservedSpecimen &specimen)
    : stiffness(specimen.affine_stiffness())
    , resists(resists_every_strain(stiffness, components(specimen)))
    , modulus(stiffness.diagonal().head(3).maxCoeff())
  {
    if (!resists)
      modulus = std::max(modulus, modulus_of_step(specimen));
    const CellState       cell   = specimen.cell();
    const Eigen::Vector3d height = cell.base.inverse().rowwise().norm().cwiseInverse();
    const double          highest =
      specimen.parameters().physics.dimension == 3 ? height.maxCoeff() : height.head<2>().maxCoeff();
    crossing = highest / std::sqrt(modulus * cell.volume / mass_of(specimen.kinematics()));
    follow(specimen);
  }

  void ServoStiffness::follow(const ObservedSpecimen &specimen)
  {
    if (!resists)
      stiffness = at_least(modulus, specimen.affine_stiffness(), components(specimen));
  }

  void ServoStiffness::visit_state(base::StateVisitor &visitor)
  {
    base::Column entries(stiffness.data(), stiffness.data() + stiffness.size());
    visitor.column("servo/stiffness", entries);
    stiffness = base::Matrix6(entries.data());
  }
} // namespace dem
