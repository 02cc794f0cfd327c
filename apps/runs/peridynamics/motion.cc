#include "apps/runs/peridynamics/motion.h"

#include "apps/figures/summary_head.h"
#include "base/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    /** Steps of equal length, not above the stable one, to the end. */
    double length_of_steps(const PeridynamicsModel &model, const pd::Bonds &bonds)
    {
      const double stable = model.analysis.step_factor * pd::Motion::stable_step(bonds, model.analysis.repulsion);
      return model.analysis.end_time / std::ceil(model.analysis.end_time / stable);
    }

    pd::Field velocity_at_start(const PeridynamicsModel &model, const pd::Grid &grid)
    {
      pd::Field v = grid.field();
      for (const std::size_t i : grid.nodes())
        v.add(i, value_of(model.velocity, grid.position(i), 0));
      return v;
    }
  } // namespace

  PeridynamicMotion::PeridynamicMotion(const PeridynamicsModel &what, PeridynamicBody &of)
    : model(what)
    , body(of)
    , length(length_of_steps(what, of.bonds))
    , motion(of.bonds, of.loads.act, what.analysis.kinematics, velocity_at_start(what, of.bonds.grid()), length)
    , sampling(what.analysis.end_time, what.output, 1e-9)
  {
    if (what.analysis.repulsion > 0)
      motion.repel(of.bonds, what.analysis.repulsion);
  }

  std::int64_t PeridynamicMotion::steps() const { return std::llround(model.analysis.end_time / length); }

  std::vector<postprocess::SeriesColumn> PeridynamicMotion::columns() const
  {
    return {{"time", "s"},
            {"largest_displacement", "m"},
            {"broken_bonds", ""},
            {"damage", "-"},
            {"energy_kinetic", "J"},
            {"energy_strain", "J"},
            {"energy_repulsion", "J"},
            {"energy_released", "J"},
            {"energy_external", "J"},
            {"energy_residual", "J"}};
  }

  void PeridynamicMotion::record_row(const RunWork::Record &record)
  {
    const pd::Energies e    = motion.energies(body.bonds);
    double             most = 0;
    for (const std::size_t i : body.bonds.grid().nodes())
      most = std::max(most, motion.displacement().at(i).norm());
    if (!std::isfinite(e.kinetic) || !std::isfinite(most))
      throw base::NumericalError(fmt::format(
        "peridynamics: the motion has left the real numbers at {:.6g} s. Lower Analysis/Step factor.", motion.time()));
    worst   = std::max(worst, std::abs(e.residual()));
    largest = std::max(largest, e.largest());
    record({{},
            {motion.time(), most, static_cast<double>(motion.broken()), body.largest_damage(), e.kinetic, e.strain,
             e.repulsion, e.released, e.external, e.residual()},
            {}});
  }

  void PeridynamicMotion::begin(const RunWork::Record &record) { record_row(record); }

  void PeridynamicMotion::advance(const RunWork::Record &record)
  {
    // A checkpoint may stand between: some million bonds' steps take a second or less.
    const auto many =
      std::max<std::int64_t>(1, 20000000 / static_cast<std::int64_t>(body.bonds.stiffness().size() + 1));
    sampled = 0;
    for (std::int64_t n = 0; n < many && sampled == 0 && !finished(); ++n)
      {
        motion.step(body.bonds, body.loads.act);
        sampled = sampling.take(motion.time()) ? 1 : 0;
      }
    if (sampled != 0)
      record_row(record);
  }

  double PeridynamicMotion::done() const { return std::min(1.0, motion.time() / model.analysis.end_time); }

  std::string PeridynamicMotion::details() const
  {
    return fmt::format("{:.4g} s, {} bonds broken", motion.time(), motion.broken());
  }

  void PeridynamicMotion::visit_state(RunState &state)
  {
    state.group("motion");
    motion.visit_state(state);
    state.scalar("worst", worst);
    state.scalar("largest", largest);
    state.scalar("sampled", sampled);
    state.group("sampling");
    sampling.visit_state(state);
  }

  void PeridynamicMotion::add_figures(nlohmann::json &figures) const
  {
    figures["steps"]                = motion.steps();
    figures["step"]                 = quantity(length, "s");
    figures["energy_balance_error"] = quantity(largest > 0 ? worst / largest : 0.0, "-");
  }
} // namespace apps
