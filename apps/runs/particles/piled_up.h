#pragma once

#include "apps/runs/particles/model.h"

#include <optional>

namespace apps
{
  /** Equal particles without weight, as they are in a cubic or square lattice. */
  struct LatticeOfParticles
  {
    dem::SpecimenParameters           parameters;
    dem::LinkMaterials                materials; ///< they are of the first
    std::size_t                       number;    ///< about so many
    double                            radius;    ///< [m]
    std::optional<dem::LinkMaterials> ground;    ///< of an open box around them; absent: there is none

    /** Each touches its neighbours, and those outside the box. */
    dem::Specimen piled_up() const;
    /** None touches anything. */
    dem::Specimen apart() const;

  private:
    int           along() const;
    dem::Specimen body(double distance) const;
  };

  /**
   * Seconds by which a step of particles without bonds becomes dearer once gravity has piled them up, when they touch each other and
   * the ground, as few or none do at the start: what a lattice of as many takes more when piled up than apart. 0 without gravity, and
   * of bonded or single particles.
   * @param now its contacts are not counted again @param ground contact with what they lie on, if there is anything
   */
  double dearer_step_when_piled_up(const ParticlesModel                    &model,
                                   const dem::ObservedSpecimen             &now,
                                   const std::optional<dem::LinkMaterials> &ground);
} // namespace apps
