#include "apps/runs/particles/break_results.h"

#include "apps/figures/emission_figures.h"
#include "apps/process/mpi_session.h"
#include "apps/results/warning.h"
#include "dem/facets/surface.h"
#include "dem/specimen/told_to_first.h"
#include "postprocess/pictures/break_pictures.h"
#include "postprocess/pictures/force_chains.h"
#include "postprocess/pictures/picture_view.h"
#include "postprocess/vtk/break_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace apps
{
  namespace
  {
    /** Links on which a force acts, on the first rank. */
    struct LoadedLinks
    {
      bool            any = false;
      dem::LinkOutput seen; ///< those within a slab: ends and normal forces
    };

    LoadedLinks loaded_links(const dem::ObservedSpecimen    &specimen,
                             const dem::ParticleOutput      &particles,
                             const postprocess::PictureSlab &slab)
    {
      std::optional<postprocess::PictureView> view;
      if (!particles.position.empty())
        view.emplace(particles, slab);
      LoadedLinks found;
      dem::tell_first_of_links(
        specimen,
        [](const dem::LinkOutput &some, const std::size_t l, std::vector<double> &numbers) {
          if (some.normal_force[l] != 0)
            numbers.insert(numbers.end(), {static_cast<double>(some.ends[l][0]), static_cast<double>(some.ends[l][1]),
                                           some.normal_force[l]});
        },
        [&](const std::vector<double> &numbers) {
          found.any = found.any || !numbers.empty();
          for (std::size_t n = 0; n < numbers.size(); n += 3)
            {
              const auto first  = static_cast<std::size_t>(numbers[n]),
                         second = static_cast<std::size_t>(numbers[n + 1]);
              if (!view->shows(first) || !view->shows(second))
                continue;
              found.seen.ends.push_back({first, second});
              found.seen.normal_force.push_back(numbers[n + 2]);
            }
        });
      return found;
    }
  } // namespace

  void BreakResults::write(const std::filesystem::path &folder, const dem::ParticleOutput &particles) const
  {
    postprocess::PictureSlab slab;
    slab.axis                                    = specimen.parameters().physics.dimension == 2 ? 2 : 1;
    slab.materials                               = materials;
    const LoadedLinks                   loaded   = loaded_links(specimen, particles, slab);
    const std::vector<dem::WallContact> on_walls = specimen.surfaces().contacts(); // meets the other ranks
    on_first_rank([&] {
      if (loaded.any)
        warn_of_missing("forces.png", postprocess::picture_of_forces(folder / "forces.png", particles, loaded.seen,
                                                                     on_walls, "Forces at the end", slab));
      write_alone(folder, particles, slab);
    });
  }

  void BreakResults::write_alone(const std::filesystem::path    &folder,
                                 const dem::ParticleOutput      &particles,
                                 const postprocess::PictureSlab &slab) const
  {
    const std::vector<dem::Break> breaks = specimen.breaks();
    std::vector<std::string>      surfaces;
    for (std::size_t s = 0; s < specimen.surfaces().size(); ++s)
      surfaces.push_back(specimen.surfaces().at(s).name);
    postprocess::write_break_table(folder / "breaks.csv", breaks, materials, surfaces);
    write_emission(specimen, folder, "", slab.axis);
    if (breaks.empty())
      return;
    const double thickness = specimen.parameters().physics.dimension == 2 ? specimen.parameters().thickness : 0.0;
    warn_of_missing("breaks.png", postprocess::picture_of_breaks(folder / "breaks.png", particles, breaks, thickness,
                                                                 "What broke", slab));
    warn_of_missing("directions.png", postprocess::picture_of_directions(
                                        folder / "directions.png", breaks, slab.axis,
                                        "Directions in which cracks lie (not across them), part of their area"));
  }

  std::string BreakResults::text() const
  {
    std::array<std::size_t, 3> count{};
    for (const dem::Break &b : specimen.breaks())
      ++count[static_cast<std::size_t>(b.mode)];
    const double all   = static_cast<double>(std::max<std::size_t>(count[0] + count[1] + count[2], 1));
    const auto   share = [&](const std::size_t mode) {
      return fmt::format("{} ({:.3g} %)", count[mode], 100 * static_cast<double>(count[mode]) / all);
    };
    const auto breaks = specimen.breaks();
    const auto glue   = std::count_if(breaks.begin(), breaks.end(), [](const dem::Break &b) { return b.surface >= 0; });
    return fmt::format("broken       {} in tension, {} in shear, {} gradually; {} links{}\n", share(0), share(1),
                       share(2), specimen.counts().broken,
                       glue > 0 ? fmt::format("; {} of these at glued surfaces", glue) : std::string()) +
           EmissionFigures(specimen).text();
  }
} // namespace apps
