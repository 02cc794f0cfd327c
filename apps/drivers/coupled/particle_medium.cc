#include "apps/drivers/coupled/particle_medium.h"

#include "apps/drivers/homogenisation/report.h"
#include "apps/drivers/parts/specimen_packing.h"
#include "base/errors.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/homogenisation/resisted_strains.h"
#include "dem/model/particles.h"
#include "postprocess/summary.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace apps
{
  std::optional<ParticleMedium> medium_of(const std::optional<dem::Packing> &cell,
                                          const SpecimenSection             &specimen,
                                          const MaterialSection             &material,
                                          const int                          dimension,
                                          const bool                         rotations)
  {
    // Regions are places in the scene, which the cell of a packing is not part of.
    if (!cell || !material.regions.empty() || dimension != 3)
      return std::nullopt;
    dem::Packing numbered = *cell;
    material.number(numbered, dimension, origin_of(specimen));
    dem::NetworkParameters links;
    links.rotations                     = rotations;
    links.interaction_ratio             = specimen.interaction_ratio;
    const dem::LinkMaterials    known   = material.materials();
    const dem::ElasticNetwork   network = dem::make_network(numbered, links, known);
    const dem::RelaxedStiffness found   = dem::relaxed_stiffness(network);
    if (!found.solver.converged || found.resisted < dem::strains_of(dimension))
      return std::nullopt;
    const dem::ParticleShape  shape{dimension, specimen.density, 0};
    const std::vector<double> densities = known.densities(specimen.density);
    ParticleMedium            medium;
    medium.stiffness = 0.5 * (found.stiffness + found.stiffness.transpose());
    for (std::size_t i = 0; i < numbered.size(); ++i)
      {
        const std::size_t of = numbered.material.empty() ? 0 : static_cast<std::size_t>(numbered.material[i]);
        medium.density += densities.at(of) * shape.volume(numbered.radius[i]) / network.volume;
      }
    return medium;
  }

  void give_medium(const MaterialsSection &materials, const std::optional<ParticleMedium> &medium)
  {
    for (const auto &group : materials.groups)
      {
        if (!group->is_homogenised())
          continue;
        if (!medium)
          throw base::InputError(
            group->place.text() + ": Materials/" + group->group +
            ": Homogenised wants spheres of one material from a packing that is periodic and resists every strain. "
            "Give the constants, or a Stiffness file of breccia homogenise.");
        group->become(medium->stiffness, medium->density);
      }
  }

  void ParticleMedium::write(const std::filesystem::path &file) const
  {
    postprocess::write_json(file, {{"relaxed", {{"stiffness", json_of(stiffness)}}}, {"density", density}});
  }

  std::optional<ParticleMedium> ParticleMedium::kept_in(const std::filesystem::path &folder)
  {
    const std::filesystem::path file = folder / file_name;
    if (!std::filesystem::exists(file))
      return std::nullopt;
    std::ifstream        stream(file);
    const nlohmann::json json    = nlohmann::json::parse(stream, nullptr, false);
    const auto           density = json.find("density");
    if (!json.is_object() || density == json.end() || !density->is_number())
      throw base::InputError(file.string() + ": cannot be read. Begin the run anew.");
    return ParticleMedium{stiffness_in(file, "relaxed"), density->get<double>()};
  }

  Mismatch reflected_by_mismatch(const ParticleMedium &medium, const base::Stiffness &solid, const double density)
  {
    const double heavier  = density > 0 ? density / medium.density : 1.0;
    const auto   reflects = [&](const int entry) {
      const double ratio = std::sqrt(solid(entry, entry) * heavier / medium.stiffness(entry, entry));
      return std::pow((ratio - 1) / (ratio + 1), 2);
    };
    Mismatch worst;
    for (int c = 0; c < 3; ++c)
      {
        worst.compression = std::max(worst.compression, reflects(c));
        worst.shear       = std::max(worst.shear, reflects(3 + c));
      }
    return worst;
  }
} // namespace apps
