#include "apps/drivers/coupled/particle_medium.h"

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
    if (!cell || !material.named.empty() || dimension != 3)
      return std::nullopt;
    dem::NetworkParameters links;
    links.rotations                     = rotations;
    links.interaction_ratio             = specimen.interaction_ratio;
    const dem::ElasticNetwork   network = dem::make_network(*cell, links, material.materials());
    const dem::RelaxedStiffness found   = dem::relaxed_stiffness(network);
    if (!found.solver.converged || found.resisted < dem::strains_of(dimension))
      return std::nullopt;
    const dem::ParticleShape shape{dimension, specimen.density, 0};
    ParticleMedium           medium;
    medium.stiffness = found.stiffness;
    for (const double radius : cell->radius)
      medium.density += specimen.density * shape.volume(radius) / network.volume;
    return medium;
  }

  void homogenise(const MaterialsSection &materials, const std::optional<ParticleMedium> &medium)
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
    nlohmann::json rows = nlohmann::json::array();
    for (int i = 0; i < 6; ++i)
      {
        const Eigen::Matrix<double, 1, 6> row = stiffness.row(i);
        rows.push_back(std::vector<double>(row.data(), row.data() + 6));
      }
    postprocess::write_json(file, {{"relaxed", {{"stiffness", rows}}}, {"density", density}});
  }

  std::optional<ParticleMedium> ParticleMedium::kept_in(const std::filesystem::path &folder)
  {
    const std::filesystem::path file = folder / file_name;
    if (!std::filesystem::exists(file))
      return std::nullopt;
    std::ifstream        stream(file);
    const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    ParticleMedium       medium;
    try
      {
        for (std::size_t i = 0; i < 6; ++i)
          for (std::size_t j = 0; j < 6; ++j)
            medium.stiffness(static_cast<int>(i), static_cast<int>(j)) =
              json.at("relaxed").at("stiffness").at(i).at(j).get<double>();
        medium.density = json.at("density").get<double>();
      }
    catch (const nlohmann::json::exception &)
      {
        throw base::InputError(file.string() + ": cannot be read. Begin the run anew.");
      }
    return medium;
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
