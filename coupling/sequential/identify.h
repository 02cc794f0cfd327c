#pragma once

#include "coupling/sequential/mapping_law.h"

#include <vector>

namespace fem
{
  class MaterialConstants;
}

namespace coupling
{
  /** One state of a particle run: its mean damage tensor, and its stress over the run's peak. */
  struct ParticleObservation
  {
    Eigen::Matrix3d damage_tensor   = Eigen::Matrix3d::Zero();
    double          relative_stress = 0; ///< stress over peak stress, in [0, 1]
    bool            after_peak      = false;
  };

  /** What one continuum element under the same load says of a relative stress: hardening before its peak, damage after. */
  class ContinuumReference
  {
  public:
    /**
     * Load a point with free sides until its stress has fallen to `lowest` of its peak.
     * @param material that takes initial states @param size of the element [m] @param compression or else tension @param strain_step of the path [-]
     * @throws fem::MaterialFailure; base::InputError for its constants
     */
    ContinuumReference(
      const fem::MaterialConstants &material, double size, bool compression, double strain_step, double lowest);

    double peak() const { return largest; }            ///< stress in magnitude [Pa]
    double hardening_at(double relative_stress) const; ///< at most 1, before the peak
    double damage_at(double relative_stress) const;    ///< omega, after the peak

  private:
    struct Sample
    {
      double stress, hardening, damage;
    };
    std::vector<Sample> samples;
    std::size_t         at_peak = 0;
    double              largest = 0;
  };

  /** A law found from a pair of runs, and how well it fits. */
  struct Identification
  {
    MappingLaw  law;
    std::size_t damaged = 0, undamaged = 0; ///< observations after and before the peak that were used
    double      damage_error    = 0;        ///< root mean square of omega - wanted, after the peak
    double      hardening_error = 0;        ///< root mean square of kappa_P - wanted, before
  };

  /**
   * Constants of the mapping law that make the particles' tensors give what the continuum has at the same relative stress:
   * factor, exponent and the share b of the weights (b, 0, 1 - b) by Levenberg and Marquardt from the states after the peak; then the
   * hardening line by linear least squares from those before, kept below 1 at the switch.
   * @throws base::InputError with fewer than four states after the peak
   */
  Identification identify(const std::vector<ParticleObservation> &observations,
                          const ContinuumReference               &reference,
                          const MappingLaw                       &start);
} // namespace coupling
