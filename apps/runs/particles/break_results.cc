#include "apps/runs/particles/break_results.h"

#include "apps/figures/emission_figures.h"
#include "apps/results/warning.h"
#include "dem/facets/surface.h"
#include "postprocess/pictures/break_pictures.h"
#include "postprocess/pictures/force_chains.h"
#include "postprocess/vtk/break_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace apps
{
  void BreakResults::write(const std::filesystem::path &folder) const
  {
    const std::vector<dem::Break> breaks = specimen.breaks();
    std::vector<std::string>      surfaces;
    for (std::size_t s = 0; s < specimen.surfaces().size(); ++s)
      surfaces.push_back(specimen.surfaces().at(s).name);
    postprocess::write_break_table(folder / "breaks.csv", breaks, materials, surfaces);
    const bool               plane = specimen.parameters().physics.dimension == 2;
    postprocess::PictureSlab slab;
    slab.axis                           = plane ? 2 : 1;
    slab.materials                      = materials;
    const dem::ParticleOutput particles = specimen.particles();
    const dem::LinkOutput     links     = specimen.links();
    bool                      acts      = false;
    for (const double force : links.normal_force)
      acts = acts || force != 0;
    if (acts)
      warn_of_missing("forces.png",
                      postprocess::picture_of_forces(folder / "forces.png", particles, links,
                                                     specimen.surfaces().contacts(), "Forces at the end", slab));
    write_emission(specimen, folder, "", slab.axis);
    if (breaks.empty())
      return;
    warn_of_missing("breaks.png",
                    postprocess::picture_of_breaks(folder / "breaks.png", particles, breaks,
                                                   plane ? specimen.parameters().thickness : 0.0, "What broke", slab));
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
