#include "apps/runs/coupled/particle_medium.h"

#include "apps/runs/homogenisation/report.h"
#include "apps/specimens/specimen_packing.h"
#include "base/errors.h"
#include "postprocess/files/summary.h"

#include <deal.II/base/types.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <set>
#include <vector>

namespace apps
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr const char *no_region = "";

    /** The cell, its particles of one material; of `no_region`: as the packing numbers them. */
    dem::Packing numbered(const MediumSource &source, const std::string &material)
    {
      MaterialSection everywhere = source.specimen.material;
      everywhere.regions.clear(); // places in the scene, which the cell of a packing is not part of
      dem::Packing cell = *source.cell;
      if (material != no_region)
        cell.material.clear();
      everywhere.number(cell, source.specimen.dimension, origin_of(source.specimen.source));
      if (material == no_region)
        return cell;
      const std::vector<std::string> known = everywhere.names();
      const auto number = static_cast<std::int32_t>(std::find(known.begin(), known.end(), material) - known.begin());
      cell.material.assign(cell.size(), number);
      return cell;
    }

    std::optional<coupling::ParticleMedium> medium_of(const MediumSource &source, const std::string &material)
    {
      dem::NetworkParameters links;
      links.dimension         = source.specimen.dimension;
      links.rotations         = source.rotations;
      links.interaction_ratio = source.specimen.source.interaction_ratio;
      links.thickness         = source.specimen.source.thickness;
      return coupling::medium_of_cell(numbered(source, material), links, source.specimen.material.materials(),
                                      source.specimen.source.density);
    }

    /** What the middles of a group's elements are of, by the regions; those in the particles' own region go. */
    template <int dim>
    std::map<std::string, std::set<std::string>>
    materials_by_group(const MediumSource &source, const ContinuumModel &continuum, const HandshakesSection &handshakes)
    {
      const fem::Mesh<dim>                              mesh = make_mesh<dim>(continuum.mesh, MPI_COMM_SELF);
      std::map<dealii::types::material_id, std::string> named;
      std::map<std::string, std::set<std::string>>      found;
      for (const auto &[name, number] : mesh.materials)
        named[number] = name;
      for (const auto &element : mesh.triangulation->active_cell_iterators())
        {
          const auto     middle = element->center();
          const Vector3d place(middle[0], middle[1], dim == 3 ? middle[dim - 1] : 0.0);
          if (handshakes.is_taken(place))
            continue;
          std::string material = no_region;
          for (const MaterialRegion &region : source.specimen.material.regions)
            if (region.region.holds(place, dim))
              material = region.material; // later ones win
          found[named.at(element->material_id())].insert(material);
        }
      return found;
    }

    nlohmann::json described(const coupling::ParticleMedium &medium)
    {
      return {{"relaxed", {{"stiffness", json_of(medium.stiffness)}}}, {"density", medium.density}};
    }
  } // namespace

  const coupling::ParticleMedium *ParticleMedia::of(const std::string &group) const
  {
    const auto found = of_group.find(group);
    return found == of_group.end() ? nullptr : &found->second;
  }

  std::vector<std::string> ParticleMedia::several_in(const std::string &group) const
  {
    const auto found = mixed.find(group);
    return found == mixed.end() ? std::vector<std::string>() : found->second;
  }

  ParticleMedia
  media_of(const MediumSource &source, const ContinuumModel &continuum, const HandshakesSection &handshakes)
  {
    ParticleMedia media;
    if (!source.cell || source.specimen.given())
      return media;
    std::map<std::string, std::set<std::string>> of_groups;
    for (const auto &group : continuum.materials.groups)
      of_groups[group->group] = {no_region};
    if (!source.specimen.material.regions.empty())
      for (const auto &[group, materials] : source.specimen.dimension == 2 ?
                                              materials_by_group<2>(source, continuum, handshakes) :
                                              materials_by_group<3>(source, continuum, handshakes))
        of_groups[group] = materials;
    std::map<std::string, std::optional<coupling::ParticleMedium>> known;
    for (const auto &[group, materials] : of_groups)
      {
        if (materials.size() != 1)
          {
            media.set_several(group, {materials.begin(), materials.end()});
            continue;
          }
        const std::string &material = *materials.begin();
        if (known.count(material) == 0)
          known[material] = medium_of(source, material);
        if (known[material])
          media.set(group, *known[material]);
      }
    return media;
  }

  void give_media(const MaterialsSection &materials, const ParticleMedia &media)
  {
    for (const auto &group : materials.groups)
      {
        if (!group->is_homogenised())
          continue;
        const std::string where = group->place.text() + ": Materials/" + group->group + ": ";
        if (const coupling::ParticleMedium *medium = media.of(group->group))
          {
            group->become(medium->stiffness, medium->density);
            continue;
          }
        std::vector<std::string> several = media.several_in(group->group);
        if (several.empty())
          throw base::InputError(where + "Homogenised wants particles of a packing that is periodic and resists every "
                                         "strain, and of no mix, whose aggregates lie in the specimen. Give the "
                                         "constants, or a Stiffness file of breccia homogenise.");
        std::replace(several.begin(), several.end(), std::string(no_region), std::string("that of no region"));
        throw base::InputError(
          fmt::format("{}Homogenised: by Regions its elements are of several materials of the particles "
                      "({}). Give the elements of each a group of their own.",
                      where, fmt::join(several, ", ")));
      }
  }

  void ParticleMedia::write(const std::filesystem::path &file) const
  {
    const coupling::ParticleMedium &first = of_group.begin()->second;
    const bool                      same  = std::all_of(of_group.begin(), of_group.end(), [&](const auto &of) {
      return of.second.stiffness == first.stiffness && of.second.density == first.density;
    });
    if (same)
      return postprocess::write_json(file, described(first));
    nlohmann::json each;
    for (const auto &[group, medium] : of_group)
      each["groups"][group] = described(medium);
    postprocess::write_json(file, each);
  }

  ParticleMedia ParticleMedia::kept_in(const std::filesystem::path &folder, const ContinuumModel &continuum)
  {
    ParticleMedia               media;
    const std::filesystem::path file = folder / file_name;
    if (!std::filesystem::exists(file))
      return media;
    std::ifstream        stream(file);
    const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    for (const auto &group : continuum.materials.groups)
      {
        const bool           each = json.is_object() && json.contains("groups");
        const std::string    path = each ? "groups/" + group->group + "/" : "";
        const nlohmann::json of   = each ? json["groups"].value(group->group, nlohmann::json::object()) : json;
        if (each && of.empty())
          continue; // it is given by its constants, and stands for nothing that was found
        if (!of.is_object() || !of.contains("density") || !of["density"].is_number())
          throw base::InputError(file.string() + ": cannot be read. Begin the run anew.");
        media.set(group->group, {stiffness_in(file, path + "relaxed"), of["density"].get<double>()});
      }
    return media;
  }

} // namespace apps
