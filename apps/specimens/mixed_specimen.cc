#include "apps/specimens/mixed_specimen.h"

#include "apps/models/mix_materials.h"
#include "apps/specimens/specimen_packing.h"
#include "base/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  void MixedSpecimen::check(const base::EntryPath &root) const
  {
    const base::EntryPath specimen = root.at("Specimen");
    if (source.body == SpecimenSection::Body::cell)
      mix.check_for_cell(specimen);
    else
      {
        if (mix.given() && source.source == SpecimenSection::Source::none)
          specimen.refuse("Source", "there are no particles that the aggregates of Mix could be made of.");
        mix.check(specimen, walls(), dimension);
      }
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

  void MixedSpecimen::number_part(dem::Packing &part, const std::string &origin) const
  {
    const bool own = !material.named.empty(); // constants of their own, and links between aggregates as within one
    if (mix.given())
      take_mix(part, mix, box(part.periodic_cell), own ? 0 : source.interaction_ratio);
    if (own || !mix.given())
      material.number(part, dimension, origin);
  }

  void MixedSpecimen::number(dem::Packing &packed, const std::string &origin) const
  {
    number_part(packed, origin);
    material.require_all(packed, origin);
  }

  Eigen::Vector3d MixedSpecimen::walls() const
  {
    if (source.source == SpecimenSection::Source::genesis)
      return source.genesis.vessel(dimension).size;
    return source.has_box() ? source.box_edges() : Eigen::Vector3d(0, 0, 0);
  }

  MixBox MixedSpecimen::box(const std::optional<Eigen::Vector3d> &cell) const
  {
    const Eigen::Vector3d edges = cell ? *cell : walls();
    if (dimension == 2)
      return {mix.box_behind(edges), true};
    return {edges, cell.has_value()};
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
    return mix_figures(mix, box(cell));
  }

  void MixedSpecimen::put_into(nlohmann::json &summary, const std::optional<Eigen::Vector3d> &cell) const
  {
    if (mix.given())
      summary["mix"] = figures(cell).json();
  }

  std::string MixedSpecimen::text(const std::optional<Eigen::Vector3d> &cell) const
  {
    return mix.given() ? fmt::format("mix          {}\n", figures(cell).text()) : "";
  }

  std::string MixedSpecimen::draw_grading(const std::filesystem::path          &folder,
                                          const std::optional<Eigen::Vector3d> &cell) const
  {
    return mix.given() ? figures(cell).draw(folder / "grading.png") : "";
  }
} // namespace apps
