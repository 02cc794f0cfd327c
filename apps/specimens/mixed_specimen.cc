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
    mix.require_among(material.names(), specimen);
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

  MaterialSection MixedSpecimen::named_materials(const std::size_t numbers) const
  {
    return mix.given() && !material.named.empty() ? with_copies(mix, material, numbers) : material;
  }

  void MixedSpecimen::number_part(dem::Packing &part, const std::string &origin) const
  {
    std::size_t copies = 0; // of the aggregate
    if (mix.given())
      {
        take_mix(part, mix, box(part.periodic_cell), source.interaction_ratio);
        copies = std::max<std::size_t>(part.material_names.size(), 2) - 2;
      }
    if (!mix.given() || !material.named.empty())
      named_materials(material.named.size() + copies).number(part, dimension, origin);
  }

  void MixedSpecimen::number(dem::Packing &packed, const std::string &origin) const
  {
    number_part(packed, origin);
    require_all(packed, origin);
  }

  void MixedSpecimen::require_all(const dem::Packing &packed, const std::string &origin) const
  {
    if (material.named.empty())
      return;
    dem::Packing folded;
    folded.material = packed.material;
    for (std::int32_t &number : folded.material)
      number = static_cast<std::int32_t>(number_in_scene(static_cast<std::size_t>(number)));
    material.require_all(folded, origin);
  }

  std::size_t MixedSpecimen::number_in_scene(const std::size_t number) const
  {
    const std::vector<std::string> known = material.names();
    return number < known.size() ?
             number :
             static_cast<std::size_t>(std::find(known.begin(), known.end(), mix.aggregate) - known.begin());
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
             named_materials(names.size()).materials();
  }

  std::vector<std::string> MixedSpecimen::link_classes(const std::vector<std::string> &names) const
  {
    if (mix.given() && material.named.empty())
      return classes_of_mix(names.size());
    std::vector<std::string> classes;
    if (names.size() > 1)
      for (std::size_t one = 0; one < names.size(); ++one)
        for (std::size_t other = 0; other <= one; ++other)
          classes.push_back(class_of(names, one, other));
    return classes;
  }

  std::string
  MixedSpecimen::class_of(const std::vector<std::string> &names, const std::size_t one, const std::size_t other) const
  {
    const auto of = [&](const std::size_t number) {
      const std::string &name = mix.given() ? names[number_in_scene(number)] : names[number];
      return !mix.given() ? name : name == mix.mortar ? "mortar" : name == mix.aggregate ? "aggregate" : name;
    };
    const std::string first = of(other), second = of(one);
    const auto        of_mix = [](const std::string &name) { return name == "mortar" || name == "aggregate"; };
    if (one == other)
      return second;
    return mix.given() && of_mix(first) && of_mix(second) ? "interface" : first + "-" + second;
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
