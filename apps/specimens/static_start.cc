#include "apps/specimens/static_start.h"

#include "apps/process/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  StaticStart start_statically(dem::Specimen &specimen, const GravitySection &gravity)
  {
    if (!gravity.asks_for_equilibrium())
      return {};
    Progress progress("initial equilibrium");
    return specimen.find_equilibrium(
      [&](const dem::InitialEquilibrium &so_far) { progress.update(search_text(so_far)); });
  }

  std::string search_text(const dem::InitialEquilibrium &so_far)
  {
    const std::string next = fmt::format("solution {}", so_far.solutions + 1);
    return so_far.solutions == 0 ? next :
                                   fmt::format("{}: unbalanced force {:.2g} of the link forces, sought {:.0e}", next,
                                               so_far.unbalanced_ratio, dem::wanted_unbalanced_ratio);
  }

  namespace
  {
    /** As users count, from 1; the first ten. */
    std::string numbers_of(const std::vector<std::int32_t> &particles)
    {
      constexpr std::size_t named = 10;
      std::string           text;
      for (std::size_t k = 0; k < particles.size() && k < named; ++k)
        text += (k ? ", " : "") + std::to_string(particles[k] + 1);
      return text + (particles.size() > named ? ", ..." : "");
    }
  } // namespace

  std::string text_of(const dem::InitialEquilibrium &found)
  {
    std::string text =
      fmt::format("displaced by {:.3g} m at most, links strained to {:.2g} of their limit; unbalanced "
                  "ratio {:.1e} after {} solutions",
                  found.largest_displacement, found.largest_strain, found.unbalanced_ratio, found.solutions);
    if (found.unbalanced_ratio > dem::wanted_unbalanced_ratio)
      text += fmt::format(" (rounding of coordinates: {:.0e})", found.rounding);
    if (!found.unsettled.empty())
      text += fmt::format("; {} of the particles {} no equilibrium and will move: {}", found.unsettled.size(),
                          found.unsettled.size() == 1 ? "finds" : "find", numbers_of(found.unsettled));
    if (found.undetermined > 0)
      text += fmt::format("; {} particles have motions that nothing resists and nothing loads", found.undetermined);
    return text;
  }

  nlohmann::json json_of(const dem::InitialEquilibrium &found)
  {
    nlohmann::json json = {{"largest_displacement", {{"value", found.largest_displacement}, {"unit", "m"}}},
                           {"largest_strain_over_limit", found.largest_strain},
                           {"damaged_links", 0},
                           {"unbalanced_ratio", found.unbalanced_ratio},
                           {"of_it_rounding", found.rounding},
                           {"solutions", found.solutions},
                           {"undetermined_particles", found.undetermined}};
    for (const std::int32_t i : found.unsettled)
      json["unsettled_particles"].push_back(i + 1);
    if (!found.solver.empty())
      json["solver"] = found.solver;
    return json;
  }

  void visit_state(base::StateVisitor &visitor, StaticStart &found)
  {
    std::int64_t there = found.has_value();
    visitor.scalar("equilibrium", there);
    if (there == 0)
      return;
    if (!found)
      found.emplace();
    auto solutions    = static_cast<std::int64_t>(found->solutions),
         undetermined = static_cast<std::int64_t>(found->undetermined);
    visitor.column("equilibrium_unsettled", found->unsettled);
    visitor.scalar("equilibrium_displacement", found->largest_displacement);
    visitor.scalar("equilibrium_unbalanced_ratio", found->unbalanced_ratio);
    visitor.scalar("equilibrium_rounding", found->rounding);
    visitor.scalar("equilibrium_strain", found->largest_strain);
    visitor.scalar("equilibrium_solutions", solutions);
    visitor.scalar("equilibrium_undetermined", undetermined);
    found->solutions    = static_cast<int>(solutions);
    found->undetermined = static_cast<std::size_t>(undetermined);
  }
} // namespace apps
