#include "dem/specimen/inside.h"

#include "dem/specimen/core.h"
#include "dem/specimen/observation.h"

namespace dem
{
  namespace
  {
    struct Inside : ObservedSpecimen
    {
      static SpecimenCore &core_of(const ObservedSpecimen &specimen) { return *(specimen.*(&Inside::self)); }
    };
  } // namespace

  SpecimenCore &core_in_parts_of(const ObservedSpecimen &specimen) { return Inside::core_of(specimen); }

  const SpecimenCore &core_of(const ObservedSpecimen &specimen)
  {
    SpecimenCore &core = core_in_parts_of(specimen);
    core.gather();
    return core;
  }
} // namespace dem
