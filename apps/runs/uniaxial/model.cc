#include "apps/runs/uniaxial/model.h"

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
    dem::SpecimenParameters parameters;
    parameters.physics           = physics;
    parameters.density           = source.density;
    parameters.interaction_ratio = source.interaction_ratio;
    parameters.thickness         = source.thickness;
    parameters.step_factor       = time.step_factor;
    parameters.damping           = time.damping;
    parameters.gravity           = gravity.vector();
    return parameters;
  }

  dem::Packing UniaxialModel::packing() const { return make_packing(source, material, physics.dimension); }
} // namespace apps
