#include "apps/runs/peridynamics/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/runs/peridynamics/motion.h"
#include "apps/runs/peridynamics/run.h"

#include <fmt/format.h>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    /** Steps of a relaxation to 1e-6 of a plate of a hundred nodes across, by which others take more in proportion to their width. */
    constexpr double steps_per_width = 4;

    double seconds_per_pass(const pd::Bonds &bonds, const pd::Kinematics kinematics)
    {
      pd::BondForces  forces(bonds, kinematics);
      const pd::Field u = bonds.grid().field();
      pd::Field       f = bonds.grid().field();
      return seconds_per_unit([&](const std::int64_t passes) {
        for (std::int64_t n = 0; n < passes; ++n)
          forces.add_up(bonds, u, f);
        return passes;
      });
    }
  } // namespace

  std::string forecast(const PeridynamicsModel &model)
  {
    const PeridynamicBody body(model); // refuses what a run would refuse
    const pd::Grid       &grid = body.bonds.grid();
    std::string           text = fmt::format("  nodes        {}\n  bonds        {}, {} broken at the start\n",
                                             grid.nodes().size(), body.bonds.count(), body.bonds.broken());
    text += fmt::format("  horizon      {:.6g} m, {:.4g} spacings\n  memory       about {:.3g} MB for bonds\n",
                        body.bonds.horizon(), model.horizon.ratio,
                        1e-6 * static_cast<double>(8 * body.bonds.stiffness().size()));
    text += "  " + lattice_lines(body.bonds, model.materials.names());
    for (const std::string &warning : body.loads.warnings)
      text += "  warning      " + warning + "\n";
    if (model.analysis.method == PeridynamicAnalysisSection::Method::motion)
      {
        const double stable =
                       model.analysis.step_factor * pd::Motion::stable_step(body.bonds, model.analysis.repulsion),
                     steps = model.analysis.end_time / stable;
        text += fmt::format("  step         {:.4g} s\n  steps        {:.0f}\n", stable, steps);
        return text + duration_line(steps * seconds_per_pass(body.bonds, model.analysis.kinematics) * 1.5);
      }
    if (model.analysis.method == PeridynamicAnalysisSection::Method::relaxation)
      {
        const double steps = steps_per_width * grid.counts()[0] * static_cast<double>(model.analysis.increments);
        text += fmt::format("  steps        about {:.0f} where no bond breaks\n", steps);
        return text + duration_line(steps * seconds_per_pass(body.bonds, model.analysis.kinematics) * 2);
      }
    text += fmt::format("  unknowns     {}\n  equilibria   at least {}\n",
                        grid.nodes().size() * static_cast<std::size_t>(grid.dimension()), model.analysis.increments);
    return text;
  }

} // namespace apps
