#include "apps/runs/peridynamics/outcome.h"

#include "apps/runs/peridynamics/analysis.h"

namespace apps
{
  RunOutcome outcome(const PeridynamicsModel &model)
  {
    PeridynamicBody body(model); // refuses what a run would refuse
    RunOutcome      found;
    found.set_columns(make_analysis(model, body)->columns());
    if (model.analysis.quiet())
      found.add_figures({"first_break", "broken_through", "load_factor", "states"});
    else
      found.add_figures({"steps", "step", "energy_balance_error"});
    std::vector<std::string> lattices = {"lattice/"};
    for (const std::string &material : model.materials.names())
      lattices.push_back("lattice_of/" + material + "/");
    for (const std::string &lattice : lattices)
      for (const char *constant :
           {"young_modulus", "young_modulus_at_45_degrees", "poisson_ratio", "shear_modulus", "neighbours"})
        found.figures.push_back(lattice + constant);
    found.add_figures({"largest_displacement", "broken_bonds", "damage"});
    return found;
  }
} // namespace apps
