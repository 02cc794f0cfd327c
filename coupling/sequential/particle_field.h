#pragma once

#include "dem/observation/discrete_state.h"

#include <vector>

namespace coupling
{
  /** The discrete side as the mapping sees it: tensors carried by volumes at places. */
  struct ParticleField
  {
    int                          dimension = 3;
    std::vector<Eigen::Vector3d> place;           ///< [m]
    std::vector<double>          radius;          ///< [m]
    std::vector<double>          volume;          ///< [m^3]
    std::vector<Eigen::Matrix3d> stress;          ///< symmetric, tension positive [Pa]
    std::vector<Eigen::Matrix3d> damage;          ///< Omega, trace/dimension = mean strength-type damage [-]
    double                       mean_radius = 0; ///< [m]
    std::size_t                  left_out    = 0; ///< particles of the state that are not here: held, or never linked

    std::size_t size() const { return place.size(); }
  };

  struct FieldOptions
  {
    /** Where a particle's tensors are put. */
    enum class Place
    {
      reference, ///< where it was when the specimen was made: the continuum has the undeformed shape
      present
    };
    dem::DamageFit fit            = dem::DamageFit::even;
    Place          place          = Place::reference;
    bool           leave_out_held = true; ///< particles in grips are not free material
  };

  /**
   * Stress and damage tensor of every particle of a state (doc/theory/sequential-transfer.md, 1); particles that never had a cohesive link have
   * no damage and are left out.
   * @throws base::InputError if none remains
   */
  ParticleField particle_field(const dem::DiscreteState &state, const FieldOptions &options);
} // namespace coupling
