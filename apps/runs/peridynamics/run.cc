#include "apps/runs/peridynamics/run.h"

#include "apps/figures/summary_head.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/run_observer.h"
#include "apps/results/snapshots.h"
#include "apps/results/warning.h"

#include <fmt/format.h>

#include <omp.h>

#include <algorithm>

namespace apps
{
  namespace pd = dem::peridynamics;

  PeridynamicsRun::PeridynamicsRun(const RunRequest &requested, const PeridynamicsModel &what)
    : request(requested)
    , model(what)
  {
  }

  RunResult PeridynamicsRun::execute() { return LifeCycle(request, model.output.checkpoint_interval, *this).execute(); }

  void PeridynamicsRun::prepare()
  {
    const Progress progress("nodes and bonds");
    body     = std::make_unique<PeridynamicBody>(model);
    analysis = make_analysis(model, *body);
  }

  void PeridynamicsRun::keep_files(const std::filesystem::path &folder, bool)
  {
    if (model.output.snapshots > 0)
      nodes.emplace(folder, "nodes");
  }

  void PeridynamicsRun::begin(const Record &record)
  {
    notify(request, &RunObserver::says, lattice_lines(body->bonds, model.materials.names()));
    for (const std::string &warning : body->loads.warnings)
      notify(request, &RunObserver::warns, warning);
    analysis->begin(record);
    snapshot();
  }

  void PeridynamicsRun::visit_state(RunState &state)
  {
    state.group("bonds");
    body->bonds.visit_state(state);
    analysis->visit_state(state);
    visit_snapshots(state, "node_snapshots", nodes);
  }

  std::string PeridynamicsRun::stage() const { return model.analysis.quiet() ? "equilibrium" : "motion"; }

  void PeridynamicsRun::advance(const Record &record)
  {
    analysis->advance(record);
    if (analysis->snapshot_due())
      snapshot();
  }

  void PeridynamicsRun::snapshot()
  {
    if (!nodes)
      return;
    state().write_points(nodes->next(), analysis->clock());
    nodes->add(analysis->clock());
  }

  std::string lattice_lines(const pd::Bonds &bonds, const std::vector<std::string> &names)
  {
    const pd::LatticeConstants      &l     = bonds.lattice();
    const std::vector<pd::Material> &all   = bonds.mixture().materials;
    std::string                      lines = "grid         Young's modulus ";
    for (std::size_t n = 0; n < std::max<std::size_t>(1, names.size()); ++n) // copies of the last are all alike
      lines += fmt::format("{}{:.5g} Pa{}", n == 0 ? "" : ", ", l.young_modulus * all[n].young_modulus,
                           names.empty() ? "" : " (" + names[n] + ")");
    lines += fmt::format(" along its axes ({:+.2f} %)", 100 * (l.young_modulus - 1));
    if (bonds.grid().dimension() > 1)
      lines += fmt::format(", {:+.2f} % at 45 degrees; Poisson's ratio {:.4f} ({:.4f}); shear {:+.2f} %",
                           100 * (l.young_modulus_oblique - 1), l.poisson_ratio,
                           pd::poisson_ratio(bonds.grid().body().space), 100 * (l.shear_modulus - 1));
    return lines + fmt::format("; {} neighbours\n", l.neighbours);
  }

  namespace
  {
    /** Of one material. */
    nlohmann::json lattice_figures(const pd::Bonds &bonds, const pd::Material &material)
    {
      const pd::LatticeConstants &l = bonds.lattice();
      const double E = material.young_modulus, shear = E / (2 * (1 + pd::poisson_ratio(bonds.grid().body().space)));
      return {{"young_modulus", quantity(l.young_modulus * E, "Pa")},
              {"young_modulus_at_45_degrees", quantity(l.young_modulus_oblique * E, "Pa")},
              {"poisson_ratio", quantity(l.poisson_ratio, "-")},
              {"shear_modulus", quantity(l.shear_modulus * shear, "Pa")},
              {"neighbours", l.neighbours}};
    }
  } // namespace

  namespace
  {
    /** Tractions act on nodes that have broken off as before: said of those whose boundary is cracked. */
    std::vector<std::string> doubts_of_tractions(const PeridynamicsModel &model, const PeridynamicBody &body)
    {
      constexpr double          cracked = 0.35; // a crack beside a node leaves 0.39
      const std::vector<double> damage  = body.bonds.damage();
      std::vector<std::string>  doubts;
      auto                      transfer = body.loads.transfers.begin();
      for (const PeridynamicTraction &traction : model.loads.tractions)
        {
          double most = 0;
          for (const pd::BoundaryPoint &p : (*transfer++)->points())
            most = std::max(most, damage[static_cast<std::size_t>(body.bonds.grid().number(p.outer))]);
          if (most > cracked)
            doubts.push_back(fmt::format("Tractions/{}: damage is {:.2f} at its boundary: it still acts on nodes that "
                                         "have broken off. Keep the boundary whole by No-fail zones.",
                                         traction.name, most));
        }
      return doubts;
    }
  } // namespace

  RunFindings PeridynamicsRun::findings(const postprocess::CsvTable &series, const double wall_seconds)
  {
    const pd::Bonds &bonds   = body->bonds;
    nlohmann::json   figures = nlohmann::json::object();
    analysis->add_figures(figures);
    const std::vector<std::string>   names = model.materials.names();
    const std::vector<pd::Material> &all   = bonds.mixture().materials;
    figures["lattice"]                     = lattice_figures(bonds, all.front());
    for (std::size_t n = 0; n < names.size(); ++n)
      figures["lattice_of"][names[n]] = lattice_figures(bonds, all[n]);
    figures["largest_displacement"] = quantity(series.column("largest_displacement").back(), "m");
    figures["broken_bonds"]         = bonds.broken();
    figures["damage"]               = quantity(body->largest_damage(), "-");

    nlohmann::json summary            = summary_head(request, "peridynamics");
    summary["figures"]                = figures;
    std::vector<std::string> warnings = body->loads.warnings;
    for (const std::string &warning : analysis->warnings())
      warnings.push_back(warning);
    for (const std::string &warning : doubts_of_tractions(model, *body))
      warnings.push_back(warning);
    summary["warnings"] = warnings;
    summary["cost"]     = {{"nodes", bonds.grid().nodes().size()},
                           {"bonds", bonds.count()},
                           {"threads", omp_get_max_threads()},
                           {"wall_seconds", wall_seconds}};

    std::string words;
    if (const auto found = figures.find("first_break"); found != figures.end())
      words += !found->at("value").is_null() ?
                 fmt::format("first break  at {:.5g} Pa, load factor {:.5g}\n", (*found)["value"].get<double>(),
                             (*found)["load_factor"].get<double>()) :
                 fmt::format("first break  not determined: {}\n", (*found)["not_determined"].get<std::string>());
    if (const auto found = figures.find("broken_through"); found != figures.end() && !found->at("value").is_null())
      words += fmt::format("broken       through at {:.5g} Pa\n", (*found)["value"].get<double>());
    words +=
      fmt::format("displacement {:.5g} m at most, {} of {} bonds broken, damage {:.4f} at most\n",
                  series.column("largest_displacement").back(), bonds.broken(), bonds.count(), body->largest_damage());
    words += warning_lines(warnings);
    words += fmt::format("cost         {} with {} threads\n", duration_text(wall_seconds), omp_get_max_threads());
    return {summary, words, nullptr};
  }

  void PeridynamicsRun::write_results(const std::filesystem::path &folder, const postprocess::CsvTable &)
  {
    const PeridynamicState last = state();
    last.write_table(folder / "nodes.csv");
    const std::string title = std::filesystem::path(request.scene_file).stem().string();
    warn_of_missing("displacement.png",
                    last.draw(folder / "displacement.png", title, PeridynamicState::Shown::displacement));
    warn_of_missing("damage.png", last.draw(folder / "damage.png", title, PeridynamicState::Shown::damage));
  }

  RunResult run(const PeridynamicsModel &model, const RunRequest &request)
  {
    return PeridynamicsRun(request, model).execute();
  }
} // namespace apps
