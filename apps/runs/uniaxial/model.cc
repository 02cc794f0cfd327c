#include "apps/runs/uniaxial/model.h"

#include "apps/models/specimen_parameters.h"

namespace apps
{
  void UniaxialModel::check(const base::EntryPath &root) const
  {
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    mixed().check(root);
    gravity.check(root, physics.dimension);
    loading.check(root, physics.dimension);
  }

  dem::SpecimenParameters UniaxialModel::specimen() const
  {
    dem::SpecimenParameters parameters = specimen_parameters(source, physics, time);
    parameters.gravity                 = gravity.vector();
    parameters.emission_reach          = emission.reach;
    return parameters;
  }

  MixedSpecimen UniaxialModel::mixed() const { return {source, mix, material, physics.dimension}; }
} // namespace apps
