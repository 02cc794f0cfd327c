#pragma once

namespace dem
{
  class ObservedSpecimen;
  struct SpecimenCore;

  /** What an observed specimen keeps for those derived from it: for the sources of this folder. */
  const SpecimenCore &core_of(const ObservedSpecimen &specimen);
  /** The same where several ranks share it, without gathering what others have. */
  SpecimenCore &core_in_parts_of(const ObservedSpecimen &specimen);
} // namespace dem
