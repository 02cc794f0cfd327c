#include "apps/runs/uniaxial/model.h"

#include "apps/models/specimen_parameters.h"
#include "apps/specimens/specimen_packing.h"

namespace apps
{
  void UniaxialModel::check(const base::EntryPath &root) const
  {
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    gravity.check(root, physics.dimension);
    loading.check(root, physics.dimension);
  }

  dem::SpecimenParameters UniaxialModel::specimen() const
  {
    dem::SpecimenParameters parameters = specimen_parameters(source, physics, time);
    parameters.gravity                 = gravity.vector();
    return parameters;
  }

  dem::Packing UniaxialModel::packing() const { return make_packing(source, material, physics.dimension); }
} // namespace apps
