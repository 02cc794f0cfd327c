#pragma once

namespace dem
{
  class ObservedSpecimen;
  struct Particles;

  /**
   * The particles of a specimen as it holds them, without a copy; in the order of a space-filling curve: Particles::number says which is
   * which. Columns keep their place as long as the specimen does, and change as it moves.
   */
  const Particles &particle_columns(const ObservedSpecimen &specimen);
} // namespace dem
