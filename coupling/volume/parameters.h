#pragma once

#include "coupling/volume/overlap.h"

#include <Eigen/Geometry>

#include <functional>
#include <string>
#include <utility>
#include <vector>

/** What a handshake is made with: without any mesh, so that a scene can hold it. */
namespace coupling
{
  /** What is made equal in the overlap. */
  enum class Compatibility
  {
    strict, ///< the velocity of each particle, and of the solid where it is
    coarse  ///< the mean of the difference around each node, by its weight
  };

  /** How particles and a solid are kept together where both fill the same space (doc/theory/volume-coupling.md). */
  enum class VolumeMethod
  {
    constrained, ///< particles of the overlap are constrained to move with the solid, which alone has stiffness and mass there
    legacy,     ///< the same, and both are fully stiff there: as published by Stransky (2018), for comparison
    multipliers ///< both share, and multipliers keep their velocities together
  };

  struct VolumeCouplingParameters
  {
    std::string name; ///< for messages
    Overlap     overlap;
    std::vector<std::pair<std::string, Overlap>>
                                     others; ///< of the same scene, by name: what lies in them is not its own
    std::vector<Eigen::AlignedBox3d> taken;  ///< around each element whose place the particles of the region have [m]
    std::function<bool(const Eigen::Vector3d &)>
                  empty; ///< places in them that are meant to be, as a notch is; not given: none
    VolumeMethod  method        = VolumeMethod::multipliers;
    Compatibility compatibility = Compatibility::coarse;
    bool          lumped        = false; ///< multipliers with the sums of their rows

    bool   absorbs   = false; ///< what the mesh cannot carry is damped; with multipliers
    int    sharpness = 3;     ///< p of the absorber
    double layer     = 0;     ///< how far the absorber reaches into the particles' own region [m]
    double rate      = 0;     ///< of the absorber at the overlap's outer side [1/s]
    double spacing   = 0;     ///< of its grid [m]
    double phase     = 1.9;   ///< longest time damped at once, times its largest eigenvalue: below 2
  };

  /** Measures of an absorber beside those of the mesh; as here where nothing else is said (doc/theory/volume-coupling.md, 4). */
  struct AbsorberProportions
  {
    double layer = 4;    ///< how far it reaches into the particles' own region, in elements
    double rate  = 8;    ///< at its largest, times element size over speed of compression waves
    double grid  = 0.84; ///< spacing of its averages, in elements
    double phase = 1.9;  ///< longest time damped at once, times the largest eigenvalue
  };

  /** What the mesh cannot carry is damped. @param element_size of the solid in the overlap [m] @param wave_speed of compression there [m/s] */
  void set_absorber(VolumeCouplingParameters  &parameters,
                    const AbsorberProportions &proportions,
                    double                     element_size,
                    double                     wave_speed);
} // namespace coupling
