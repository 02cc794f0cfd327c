#pragma once

namespace dem
{
  class ObservedSpecimen;
  struct SpecimenCore;

  /** What an observed specimen keeps for those derived from it: for the sources of this folder. */
  const SpecimenCore &core_of(const ObservedSpecimen &specimen);
} // namespace dem
