#include "apps/runs/uniaxial/model.h"

#include "apps/models/specimen_parameters.h"

namespace apps
{
  void UniaxialModel::check(const base::EntryPath &root) const
  {
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    mixed().check(root);
    joints.check(root, physics.dimension);
    gravity.check(root, physics.dimension);
    if (joints.given() && gravity.asks_for_equilibrium())
      root.at("Gravity").refuse("Initial equilibrium", "is not found for a specimen with joints. Choose none.");
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

  JointedPacking UniaxialModel::jointed(const dem::Packing &packing) const
  {
    return {joints, source, packing, physics.dimension};
  }

  std::vector<std::string> UniaxialModel::link_classes(const std::vector<std::string> &materials) const
  {
    return classes_with_joints(joints, mixed().link_classes(materials));
  }
} // namespace apps
