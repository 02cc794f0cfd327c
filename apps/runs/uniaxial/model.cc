#include "apps/runs/uniaxial/model.h"

#include "apps/models/mix_materials.h"
#include "apps/models/specimen_parameters.h"
#include "apps/specimens/mix_work.h"
#include "apps/specimens/specimen_packing.h"

namespace apps
{
  void UniaxialModel::check(const base::EntryPath &root) const
  {
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    mix.check(root.at("Specimen"), source.has_box() ? source.box_edges() : Eigen::Vector3d(0, 0, 0), physics.dimension);
    if (mix.given() && material.named.empty())
      try
        {
          mix_materials(mix, material.only, 2);
        }
      catch (const base::InputError &refusal)
        {
          root.at("Specimen").at("Mix").refuse_within(refusal.what());
        }
    gravity.check(root, physics.dimension);
    loading.check(root, physics.dimension);
  }

  dem::SpecimenParameters UniaxialModel::specimen() const
  {
    dem::SpecimenParameters parameters = specimen_parameters(source, physics, time);
    parameters.gravity                 = gravity.vector();
    return parameters;
  }

  dem::Packing UniaxialModel::packing() const
  {
    if (!mix.given())
      return make_packing(source, material, physics.dimension);
    const bool   own    = !material.named.empty(); // constants of their own, and links between aggregates as within one
    dem::Packing packed = make_packing(source, own ? material : MaterialSection(), physics.dimension);
    take_mix(packed, mix, source.box_edges(), own ? 0 : source.interaction_ratio);
    if (own)
      material.assign(packed, physics.dimension, origin_of(source));
    return packed;
  }

  dem::LinkMaterials UniaxialModel::materials(const std::vector<std::string> &names) const
  {
    return mix.given() && material.named.empty() ?
             mix_materials(mix, material.only, std::max<std::size_t>(1, names.size())) :
             material.materials();
  }

  std::vector<std::string> UniaxialModel::link_classes(const std::vector<std::string> &names) const
  {
    if (mix.given() && material.named.empty())
      return classes_of_mix(names.size());
    std::vector<std::string> classes;
    if (names.size() > 1)
      for (std::size_t one = 0; one < names.size(); ++one)
        for (std::size_t other = 0; other <= one; ++other)
          classes.push_back(one == other ? names[one] : names[other] + "-" + names[one]);
    return classes;
  }
} // namespace apps
