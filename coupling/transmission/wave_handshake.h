#pragma once

#include "coupling/participants/solid_participant.h"
#include "coupling/transmission/wave_case.h"
#include "coupling/volume/overlap.h"
#include "fem/mesh/shapes.h"
#include "fem/points/material_points.h"

#include <memory>
#include <string>
#include <vector>

namespace coupling
{
  constexpr const char *continuum_name = "continuum"; ///< of its material

  /** A boundary of the continuum that slides: nothing moves across it. */
  struct SlidingSide
  {
    std::string  name;
    unsigned int axis = 0; ///< that is held
  };

  /** What a wave runs into. */
  template <int dim>
  struct WaveContinuum
  {
    /** @param density [kg/m^3] @param wave says how it shares with particles */
    WaveContinuum(const fem::BodiesShape              &shape,
                  std::unique_ptr<fem::MaterialPoints> material,
                  double                               density,
                  const std::vector<SlidingSide>      &sides,
                  const WaveCase                      &wave,
                  const Overlap                       &overlap);

    double energy() const; ///< [J]

    fem::Solid<dim>                           solid;
    std::unique_ptr<fem::ExplicitSolver<dim>> motion;
    std::unique_ptr<SolidParticipant<dim>>    participant;
  };

  /** @param speed of waves of compression in the continuum [m/s] */
  VolumeCouplingParameters coupling_of(const WaveCase &wave, const Overlap &overlap, double speed);
} // namespace coupling
