#pragma once

#include "coupling/sequential/section_forces.h"

namespace coupling
{
  struct ParticleField;
  struct MappedPoint;

  /**
   * Forces and moments over the cuts of a body, by its particles and by the mapped field: both as mean stress over the slab times the
   * section of the solid there, so that they differ by stresses and not by how much of a slab is filled.
   */
  struct CutComparison
  {
    std::vector<SectionForce> particles, points;
    double                    section = 0; ///< mean of the solid over the cuts [m^2]
    double filled = 0; ///< volume of the particles, gripped ones like the others, over that of the solid

    /** Largest difference of force over the larger of the largest force and what the section bears at the strength [Pa]. */
    double force_error(double strength) const;
    /** The same for moments, of which a square section bears sqrt(section)/6 per force. */
    double moment_error(double strength) const;
  };

  /** Cuts across the longest direction of the points, each about an element thick, where there are both particles and points. */
  CutComparison compare_cuts(const ParticleField &field, const std::vector<MappedPoint> &points);
} // namespace coupling
