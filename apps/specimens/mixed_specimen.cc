#include "apps/specimens/mixed_specimen.h"

#include "apps/models/mix_materials.h"
#include "apps/specimens/specimen_packing.h"
#include "base/errors.h"

#include <algorithm>

namespace apps
{
  void MixedSpecimen::check(const base::EntryPath &root) const
  {
    const base::EntryPath specimen = root.at("Specimen");
    if (source.body == SpecimenSection::Body::cell)
      mix.check_for_cell(specimen, dimension);
    else
      mix.check(specimen, source.has_box() ? source.box_edges() : Eigen::Vector3d(0, 0, 0), dimension);
    if (!mix.given() || !material.named.empty())
      return;
    try
      {
        mix_materials(mix, material.only, 2);
      }
    catch (const base::InputError &refusal)
      {
        specimen.at("Mix").refuse_within(refusal.what());
      }
  }

  dem::Packing MixedSpecimen::packing() const
  {
    if (!mix.given())
      return make_packing(source, material, dimension);
    dem::Packing packed = make_packing(source, MaterialSection(), dimension);
    number(packed, origin_of(source));
    return packed;
  }

  void MixedSpecimen::number(dem::Packing &packed, const std::string &origin) const
  {
    const bool own = !material.named.empty(); // constants of their own, and links between aggregates as within one
    if (mix.given())
      take_mix(packed, mix, packed.periodic_cell ? *packed.periodic_cell : source.box_edges(),
               own ? 0 : source.interaction_ratio);
    if (own || !mix.given())
      material.assign(packed, dimension, origin);
  }

  dem::LinkMaterials MixedSpecimen::materials(const std::vector<std::string> &names) const
  {
    return mix.given() && material.named.empty() ?
             mix_materials(mix, material.only, std::max<std::size_t>(1, names.size())) :
             material.materials();
  }

  std::vector<std::string> MixedSpecimen::link_classes(const std::vector<std::string> &names) const
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

  MixFigures MixedSpecimen::figures(const std::optional<Eigen::Vector3d> &cell) const
  {
    return mix_figures(mix, cell ? *cell : source.box_edges(), cell.has_value());
  }
} // namespace apps
