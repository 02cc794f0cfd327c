#include "dem/specimen/particle_columns.h"

#include "dem/specimen/core.h"
#include "dem/specimen/observation.h"

namespace dem
{
  namespace
  {
    /** Reads what an observed specimen keeps for those derived from it. */
    struct Inside : ObservedSpecimen
    {
      static const SpecimenCore &core_of(const ObservedSpecimen &specimen) { return *(specimen.*(&Inside::self)); }
    };
  } // namespace

  const Particles &particle_columns(const ObservedSpecimen &specimen) { return Inside::core_of(specimen).particles; }
} // namespace dem
