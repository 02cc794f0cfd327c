#include "apps/drivers/static_start.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  StaticStart start_statically(dem::Specimen &specimen, const GravitySection &gravity)
  {
    if (!gravity.asks_for_equilibrium())
      return {};
    return specimen.find_equilibrium();
  }

  std::string text_of(const dem::InitialEquilibrium &found)
  {
    std::string text =
      fmt::format("displaced by {:.3g} m at most, links strained to {:.2g} of their limit; unbalanced "
                  "ratio {:.1e} after {} solutions",
                  found.largest_displacement, found.largest_strain, found.unbalanced_ratio, found.solutions);
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
    if (!found.solver.empty())
      json["solver"] = found.solver;
    return json;
  }

  void visit_state(dem::StateVisitor &visitor, StaticStart &found)
  {
    std::int64_t there = found.has_value();
    visitor.scalar("equilibrium", there);
    if (there == 0)
      return;
    if (!found)
      found.emplace();
    auto solutions    = static_cast<std::int64_t>(found->solutions),
         undetermined = static_cast<std::int64_t>(found->undetermined);
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
