#include "apps/runs/peridynamics/rest.h"

#include "apps/figures/summary_head.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    void visit_field(RunState &state, const std::string &name, pd::Field &field)
    {
      for (std::size_t c = 0; c < 3; ++c)
        state.column(name + "_" + "xyz"[c], field.c[c]);
    }

    /** Without rigid motion where nothing is held. */
    double largest_displacement(const PeridynamicBody &body, pd::Field u)
    {
      const pd::Grid &grid = body.bonds.grid();
      if (!body.loads.held)
        pd::remove_rigid_motion(grid, u);
      double most = 0;
      for (const std::size_t i : grid.nodes())
        most = std::max(most, u.at(i).norm());
      return most;
    }
  } // namespace

  PeridynamicRest::PeridynamicRest(const PeridynamicsModel &what, PeridynamicBody &of)
    : model(what)
    , body(of)
    , u(of.bonds.grid().field())
  {
  }

  double PeridynamicRest::factor() const
  {
    return static_cast<double>(increment) / static_cast<double>(model.analysis.increments);
  }

  double PeridynamicRest::done() const
  {
    return ended != 0 ? 1 : static_cast<double>(increment - 1) / static_cast<double>(model.analysis.increments);
  }

  std::int64_t PeridynamicRest::go_on(const pd::BondForces &forces)
  {
    ++states;
    first.note(factor(), pd::largest_stretch(body.bonds, forces, u).of_limit);
    const std::int64_t broken =
      body.bonds.breaks() ? pd::break_stretched(body.bonds, forces, u, model.analysis.at_once) : 0;
    at_new_load = broken == 0;
    if (broken > 0)
      return broken;
    if (increment == model.analysis.increments)
      ended = 1;
    else
      ++increment;
    return 0;
  }

  void PeridynamicRest::broke_through(const bool mechanism)
  {
    through = mechanism ? 2 : 1;
    ended   = 1;
  }

  void PeridynamicRest::ran_out_of_steps() { restless = ended = 1; }

  void PeridynamicRest::add_figures(nlohmann::json &figures) const
  {
    const std::optional<double> factor_of_break = body.bonds.breaks() ? first.factor() : std::nullopt;
    if (!factor_of_break)
      figures["first_break"] = {
        {"value", nullptr},
        {"not_determined", body.bonds.breaks() ? "no bond is stretched at rest" : "bonds never break"},
        {"unit", "Pa"}};
    else if (body.loads.first_traction == 0)
      figures["first_break"] = {{"value", nullptr},
                                {"not_determined", "there is no traction"},
                                {"unit", "Pa"},
                                {"load_factor", *factor_of_break}};
    else
      figures["first_break"] = {
        {"value", *factor_of_break * body.loads.first_traction}, {"unit", "Pa"}, {"load_factor", *factor_of_break}};
    if (through != 0)
      figures["broken_through"] = {
        {"value", factor() * body.loads.first_traction}, {"unit", "Pa"}, {"load_factor", factor()}};
    else
      figures["broken_through"] = {{"value", nullptr}, {"not_determined", "the body holds"}, {"unit", "Pa"}};
    figures["load_factor"] = quantity(factor(), "-");
    figures["states"]      = states;
  }

  std::vector<std::string> PeridynamicRest::warnings() const
  {
    if (through == 2)
      return {fmt::format(
        "At the load factor {:.6g} no equilibrium was found though every piece is still held: nearly broken nodes "
        "move under their load. That counts as broken through.",
        factor())};
    if (restless == 0)
      return {};
    return {
      fmt::format("The body did not come to rest within {} steps at the load factor {:.6g}: what is reported of the "
                  "end is a state of the relaxation. Raise Analysis/Step limit.",
                  model.analysis.step_limit, factor())};
  }

  void PeridynamicRest::visit_state(RunState &state)
  {
    state.group("rest");
    visit_field(state, "displacement", u);
    first.visit_state(state);
    state.scalar("increment", increment);
    state.scalar("states", states);
    state.scalar("ended", ended);
    state.scalar("through", through);
    state.scalar("restless", restless);
  }

  PeridynamicStatics::PeridynamicStatics(const PeridynamicsModel &what, PeridynamicBody &of)
    : PeridynamicRest(what, of)
    , equilibrium(of.bonds, what.analysis.kinematics, what.analysis.solver)
  {
  }

  std::vector<postprocess::SeriesColumn> PeridynamicStatics::columns() const
  {
    return {
      {"load_factor", "-"}, {"residual", "-"}, {"largest_displacement", "m"}, {"broken_bonds", ""}, {"damage", "-"}};
  }

  void PeridynamicStatics::advance(const RunWork::Record &record)
  {
    const double                 now = factor();
    const pd::Equilibrium::State found =
      equilibrium.find(body.bonds, body.loads.act, now, std::min(1e-9, model.analysis.tolerance), u);
    if (found.loose)
      return broke_through(found.mechanism);
    residual = found.residual;
    broken += go_on(equilibrium.forces());
    record(
      {{}, {now, residual, largest_displacement(body, u), static_cast<double>(broken), body.largest_damage()}, {}});
  }

  std::string PeridynamicStatics::details() const
  {
    return fmt::format("load factor {:.4g}, {} bonds broken", factor(), broken);
  }

  void PeridynamicStatics::visit_state(RunState &state)
  {
    PeridynamicRest::visit_state(state);
    state.scalar("residual", residual);
    state.scalar("broken", broken);
  }

  PeridynamicRelaxation::PeridynamicRelaxation(const PeridynamicsModel &what, PeridynamicBody &of)
    : PeridynamicRest(what, of)
    , relaxation(of.bonds, what.analysis.kinematics, what.analysis.density)
  {
  }

  std::vector<postprocess::SeriesColumn> PeridynamicRelaxation::columns() const
  {
    return {{"step", ""},         {"load_factor", "-"}, {"residual", "-"}, {"largest_displacement", "m"},
            {"broken_bonds", ""}, {"damage", "-"}};
  }

  void PeridynamicRelaxation::load()
  {
    relaxation.load(body.loads.act, factor());
    since_load = 0;
    begun      = 1;
  }

  bool PeridynamicRelaxation::loose() const
  {
    pd::Field acting = body.bonds.grid().field();
    body.loads.act.forces(factor(), nullptr, acting);
    return pd::hold_rigid_motions(body.bonds, body.loads.act.held, acting).imbalance > 1e-6;
  }

  void PeridynamicRelaxation::step(const RunWork::Record &record)
  {
    const bool in_steps = model.analysis.breakage == PeridynamicAnalysisSection::Breakage::steps && body.bonds.breaks();
    const std::int64_t before = broken;
    if (in_steps)
      broken += relaxation.step_and_break(body.bonds, body.loads.act);
    else
      relaxation.step(body.bonds, body.loads.act);
    ++since_load;
    const double now = factor();
    if (relaxation.at_rest(model.analysis.tolerance) && broken == before)
      {
        u                        = relaxation.displacement();
        const std::int64_t broke = go_on(relaxation.forces());
        broken += broke;
        if (broke > 0)
          relaxation.forget_damping();
        if (broke > 0 && loose())
          broke_through();
        else if (!finished())
          load();
      }
    else if (since_load >= model.analysis.step_limit)
      in_steps &&loose() ? broke_through() : ran_out_of_steps();
    if (relaxation.steps() % model.analysis.row_interval != 0 && !finished())
      return;
    u = relaxation.displacement();
    record({{},
            {static_cast<double>(relaxation.steps()), now, relaxation.residual(), largest_displacement(body, u),
             static_cast<double>(broken), body.largest_damage()},
            {}});
  }

  void PeridynamicRelaxation::advance(const RunWork::Record &record)
  {
    if (begun == 0)
      load();
    const std::int64_t last = relaxation.steps() + 50;
    while (!finished() && relaxation.steps() < last)
      step(record);
    u = relaxation.displacement();
  }

  std::string PeridynamicRelaxation::details() const
  {
    return fmt::format("step {}, load factor {:.4g}, residual {:.2g}, {} bonds broken", relaxation.steps(), factor(),
                       relaxation.residual(), broken);
  }

  void PeridynamicRelaxation::visit_state(RunState &state)
  {
    PeridynamicRest::visit_state(state);
    state.scalar("since_load", since_load);
    state.scalar("broken", broken);
    state.scalar("begun", begun);
    state.group("relaxation");
    relaxation.visit_state(state);
  }
} // namespace apps
