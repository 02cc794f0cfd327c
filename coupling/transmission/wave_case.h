#pragma once

#include "coupling/transmission/wave_medium.h"
#include "coupling/volume/parameters.h"
#include "dem/packing/compaction.h"

#include <cstdint>
#include <functional>
#include <string>

namespace coupling
{
  /** How particles and continuum meet. */
  struct WaveMethod
  {
    std::string         name; ///< in tables
    VolumeMethod        method        = VolumeMethod::multipliers;
    Compatibility       compatibility = Compatibility::coarse;
    bool                lumped        = false;
    bool                absorbs       = false;
    int                 sharpness     = 3; ///< p
    AbsorberProportions proportions   = {};
  };

  /** A packet of waves that runs through particles and into a continuum that begins at x = 0. */
  struct WaveCase
  {
    WaveMedium   medium;
    WaveMethod   method;
    std::int64_t element = 8, overlap = 4; ///< size of an element over the spacing; width of the overlap in elements
    bool         shear          = false;
    double       angle          = 0;     ///< of the packet's way with x; of a plane only [rad]
    double       wavelength     = 0;     ///< [m]
    double       step_factor    = 0.8;   ///< of the particles' stable step
    bool         nearest_masses = false; ///< of nodes in the overlap: what lies nearest to them (fem::SharedMass)
    /** How the packing of a bar is made; a caller may show its progress, or keep it. */
    std::function<dem::CompactionResult(const dem::CompactionParameters &)> compact =
      [](const dem::CompactionParameters &parameters) { return dem::compact(parameters); };
  };

  /** Where the energy of the packet went, over what it had; particles alone are taken off first (doc/theory/volume-coupling.md, 6). */
  struct WaveAnswer
  {
    double       reflected = 0, transmitted = 0; ///< in the particles' own region; in the continuum
    double       absorbed      = 0;              ///< by the absorber, as its account says
    double       balance_error = 0;              ///< of all energies of the coupled run
    double       cost          = 0; ///< processor time of a particle's step, over the same of particles alone
    double       made          = 0; ///< by the multipliers, over the packet's energy
    double       unhindered    = 0; ///< what particles alone carry to where the continuum is, over the packet's energy
    double       left_behind = 0, left_behind_alone = 0; ///< what is in the particles' own region in the end: of a bar
    std::int64_t steps = 0, particles = 0;
  };

  /** What a case costs, in particle steps. */
  double wave_cost(const WaveCase &wave);

  /** Run it. @throws base::InputError for a wavelength that the particles cannot carry */
  WaveAnswer transmit(const WaveCase &wave);
} // namespace coupling
