#pragma once

#include "dem/model/rigid_clump.h"

#include <cstddef>
#include <optional>

namespace dem
{
  struct SpecimenCore;

  /** The rigid clumps of a specimen as they are (doc/theory/clumps.md). Valid as long as the specimen. */
  class ClumpReadings
  {
  public:
    explicit ClumpReadings(const SpecimenCore &specimen)
      : core(&specimen)
    {
    }

    std::size_t size() const;
    ClumpState  state(std::size_t number) const;
    /** The clump that a particle is a pebble of; none: it moves on its own. @param particle by packing number */
    std::optional<std::size_t> of(std::size_t particle) const;

  private:
    const SpecimenCore *core;
  };

  /** Particles that move as one rigid body. Valid as long as the specimen. */
  class RigidClumps : public ClumpReadings
  {
  public:
    explicit RigidClumps(SpecimenCore &specimen)
      : ClumpReadings(specimen)
      , core(&specimen)
    {
    }

    /**
     * Before the first step: particles move as one rigid body from now on. Bonds and contacts between them go.
     * @return its number, from 0 @throws base::InputError for particles that are held, left to a partner or of another clump, for a mass or
     * an inertia that is not positive, once there was a step, and in a periodic cell
     */
    std::size_t add(const RigidClump &clump);

  private:
    SpecimenCore *core;
  };
} // namespace dem
