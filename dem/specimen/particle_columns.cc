#include "dem/specimen/particle_columns.h"

#include "dem/specimen/core.h"
#include "dem/specimen/inside.h"

namespace dem
{
  const Particles &particle_columns(const ObservedSpecimen &specimen) { return core_of(specimen).particles; }
} // namespace dem
