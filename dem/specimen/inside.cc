#include "dem/specimen/inside.h"

#include "dem/specimen/core.h"
#include "dem/specimen/observation.h"

namespace dem
{
  namespace
  {
    struct Inside : ObservedSpecimen
    {
      static const SpecimenCore &core_of(const ObservedSpecimen &specimen)
      {
        SpecimenCore &core = *(specimen.*(&Inside::self));
        core.gather();
        return core;
      }
    };
  } // namespace

  const SpecimenCore &core_of(const ObservedSpecimen &specimen) { return Inside::core_of(specimen); }
} // namespace dem
