#include "apps/runs/sequential/outcome.h"

#include <fmt/format.h>

namespace apps
{
  RunOutcome outcome(const SequentialModel &model)
  {
    using Source                   = ParticleEventSection::Source;
    std::vector<std::string> names = {
      "severity",         "particle_balance_error", "peak", "horizontal_at_peak", "furthest", "dissipated",
      "particle_seconds", "continuum_seconds"};
    if (model.particles.source == Source::impact)
      names.emplace_back("absorbed");
    if (model.particles.source == Source::uniaxial)
      names.emplace_back("stress");
    if (model.particles.source == Source::uniaxial && model.particles.end_strain != 0)
      names.insert(names.end(), {"error_against_all_particles", "error_near", "near_reaches"});
    if (model.particles.source != Source::file && model.particles.gravity.asks_for_equilibrium())
      for (const char *part : {"largest_displacement", "largest_strain_over_limit", "damaged_links", "unbalanced_ratio",
                               "of_it_rounding", "solutions", "undetermined_particles"})
        names.push_back(std::string("initial_equilibrium/") + part);
    RunOutcome found;
    for (std::size_t k = 0; k < model.particles.cases(); ++k)
      for (const std::string &name : names)
        found.figures.push_back(fmt::format("cases/{}/{}", k, name));
    return found;
  }
} // namespace apps
