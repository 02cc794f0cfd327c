#include "apps/runs/peridynamic_core/run.h"

#include "apps/figures/drawn_curve.h"
#include "apps/figures/series_figures.h"
#include "apps/figures/summary_head.h"
#include "apps/forecasts/duration.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/run_observer.h"
#include "apps/results/snapshots.h"
#include "apps/results/warning.h"
#include "apps/runs/peridynamics/run.h"

#include <fmt/format.h>

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  PeridynamicCoreRun::PeridynamicCoreRun(const RunRequest &requested, const PeridynamicCoreModel &what)
    : SampledMotion(what.end_time, what.output)
    , request(requested)
    , model(what)
  {
  }

  RunResult PeridynamicCoreRun::execute()
  {
    return LifeCycle(request, model.output.checkpoint_interval, *this).execute();
  }

  void PeridynamicCoreRun::prepare()
  {
    const Progress progress("elements, nodes and bonds");
    body = make_peridynamic_core_body(model);
    std::vector<std::string> names;
    for (const postprocess::SeriesColumn &column : body->columns())
      names.push_back(column.name);
    const std::string reaction = body->first_reaction();
    horizontal                 = chosen_column(names, "Curve horizontal", model.horizontal, "time");
    vertical =
      chosen_column(names, "Curve vertical", model.vertical, reaction.empty() ? "energy_core_kinetic" : reaction);
  }

  void PeridynamicCoreRun::keep_files(const std::filesystem::path &folder, bool)
  {
    location = folder;
    if (model.output.snapshots == 0)
      return;
    solids.emplace(folder, "solid", ".vtu");
    nodes.emplace(folder, "nodes");
  }

  void PeridynamicCoreRun::begin(const Record &record)
  {
    notify(request, &RunObserver::says, lattice_lines(body->core().bonds, model.core.materials.names()));
    for (const std::string &doubt : body->doubts())
      notify(request, &RunObserver::warns, doubt);
    record({{}, body->row(), {}});
    snapshot();
  }

  void PeridynamicCoreRun::visit_state(RunState &state)
  {
    body->visit_state(state);
    state.group("sampling");
    visit_sampling(state);
    visit_snapshots(state, "solid_snapshots", solids);
    visit_snapshots(state, "node_snapshots", nodes);
  }

  std::string PeridynamicCoreRun::size() const
  {
    const PeridynamicCoreSize found = body->size();
    return fmt::format("{} elements, {} unknowns, {} nodes, {} bonds", found.elements, found.unknowns, found.nodes,
                       found.bonds);
  }

  std::string PeridynamicCoreRun::details() const
  {
    return fmt::format("{:.4g} s, {} bonds broken", body->time(), body->core().bonds.broken());
  }

  void PeridynamicCoreRun::advance_to(const double time) { body->advance_to(time); }

  void PeridynamicCoreRun::record_row(const Record &record) { record({{}, body->row(), {}}); }

  void PeridynamicCoreRun::snapshot()
  {
    if (!solids)
      return;
    body->write_solid(location, solids->size());
    solids->add(body->time());
    body->state().write_points(nodes->next(), body->time());
    nodes->add(body->time());
    std::vector<postprocess::PvdPart> parts;
    const base::Column               &times = solids->listed();
    for (std::size_t i = 0; i < times.size(); ++i)
      {
        parts.push_back({times[i], 0, "solid", fmt::format("solid/solid_{:06}.vtu", i)});
        parts.push_back({times[i], 1, "core", fmt::format("nodes/nodes_{:06}.vtp", i)});
      }
    postprocess::write_pvd(location / "peridynamic_core.pvd", parts);
  }

  RunFindings PeridynamicCoreRun::findings(const postprocess::CsvTable &series, const double wall_seconds)
  {
    const PeridynamicCoreSize found   = body->size();
    nlohmann::json            summary = summary_head(request, "peridynamic_core"), figures = nlohmann::json::object();
    std::string               words;
    for (const postprocess::SeriesColumn &column : body->reported())
      {
        figures[column.name]             = figure_of(series, column.name, column.unit);
        const std::vector<double> &value = series.column(column.name);
        const auto [least, largest]      = std::minmax_element(value.begin(), value.end());
        words += fmt::format("{:<28} {:.6g} {} at the end, from {:.6g} to {:.6g} in all\n", column.name, value.back(),
                             column.unit, *least, *largest);
      }
    const double balance            = worst_residual(series);
    figures["steps"]                = body->steps();
    figures["energy_balance_error"] = quantity(balance, "-");
    figures["handshake_spurious"]   = quantity(series.column("handshake_spurious").back(), "J");
    summary["figures"]              = figures;
    for (const std::string &name : series.names)
      if (const std::string all = "energy_"; name.rfind(all, 0) == 0)
        summary["energy"][name.substr(all.size())] = series.column(name).back();
    summary["energy"]["balance_error"] = balance;
    summary["warnings"]                = body->doubts();
    summary["cost"] = {{"elements", found.elements},  {"unknowns", found.unknowns}, {"nodes", found.nodes},
                       {"bonds", found.bonds},        {"steps", body->steps()},     {"threads", omp_get_max_threads()},
                       {"wall_seconds", wall_seconds}};
    words += fmt::format("{:<28} {}\n", "medium", body->text_of_mismatch());
    words += fmt::format("{:<28} {:.3g} of the largest at worst; the handshake made {:.3g} J\n", "energy balance",
                         balance, series.column("handshake_spurious").back());
    words += fmt::format("{:<28} {}, {} steps with {} threads\n", "cost", duration_text(wall_seconds), body->steps(),
                         omp_get_max_threads());
    return {summary, words, nullptr};
  }

  void PeridynamicCoreRun::write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series)
  {
    const std::string title = std::filesystem::path(request.scene_file).stem().string();
    body->state().write_table(folder / "nodes.csv");
    warn_of_missing("displacement.png",
                    body->draw(folder / "displacement.png", title, PeridynamicState::Shown::displacement));
    warn_of_missing("damage.png", body->draw(folder / "damage.png", title, PeridynamicState::Shown::damage));
    write_curve(folder, series, horizontal, vertical, title);
  }

  RunResult run(const PeridynamicCoreModel &model, const RunRequest &request)
  {
    start_mpi();
    return PeridynamicCoreRun(request, model).execute();
  }
} // namespace apps
