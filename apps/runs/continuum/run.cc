#include "apps/runs/continuum/run.h"

#include "apps/figures/drawn_curve.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/run_observer.h"
#include "apps/results/warning.h"
#include "apps/runs/continuum/picture.h"
#include "apps/runs/continuum/snapshot.h"
#include "apps/runs/continuum/solid.h"
#include "apps/runs/continuum/stress_picture.h"
#include "apps/runs/continuum/summary.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr const char *snapshot_name = "solid";

    template <int dim>
    std::unique_ptr<ContinuumAnalysis<dim>> make_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
    {
      return model.is_static() ? make_static_analysis(solid, model) : make_explicit_analysis(solid, model);
    }

    /** What solvers throw, as a run reports it. */
    template <typename Work>
    void in_words_of_a_run(const ContinuumModel &model, const Work &work)
    {
      try
        {
          work();
        }
      catch (const fem::NoEquilibrium &failure)
        {
          const bool led_by_time = model.is_static() && model.control.follow == ControlSection::Follow::time;
          throw StoppedShort(std::string(failure.what()) +
                             (led_by_time ? " Where the load falls at once (snap-back), time cannot lead the path: set "
                                            "Control/Follow = indirect or arc length." :
                                            ""));
        }
      catch (const fem::MaterialFailure &failure)
        {
          throw StoppedShort(failure.what());
        }
    }
  } // namespace

  template <int dim>
  ContinuumRun<dim>::ContinuumRun(const RunRequest     &requested,
                                  const ContinuumModel &what,
                                  const Prepare        &prepare,
                                  const Settle         &settle_)
    : request(requested)
    , model(what)
    , settle(settle_)
  {
    solid = make_solid<dim>(model);
    if (prepare)
      prepare(*solid);
    analysis = make_analysis<dim>(*solid, model);
    probes   = std::make_unique<ContinuumProbes<dim>>(*solid, model);
    choose_curve();
  }

  template <int dim>
  std::vector<postprocess::SeriesColumn> ContinuumRun<dim>::series_columns() const
  {
    std::vector<postprocess::SeriesColumn> all = analysis->columns();
    for (const ProbeColumn &probe : probes->columns())
      all.push_back(probe.column);
    for (const char *energy : {"energy_external", "energy_internal", "energy_residual"})
      all.push_back({energy, "J"});
    all.push_back({"energy_balance_error", "-"});
    return all;
  }

  template <int dim>
  void ContinuumRun<dim>::choose_curve()
  {
    std::vector<std::string> names;
    for (const auto &column : series_columns())
      names.push_back(column.name);
    const auto has = [&](const std::string &name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    const std::string reaction = probes->first_reaction();
    horizontal =
      chosen_column(names, "Curve horizontal", model.output.horizontal, has("opening") ? "opening" : names.front());
    vertical =
      chosen_column(names, "Curve vertical", model.output.vertical, reaction.empty() ? "energy_internal" : reaction);
    vertical_index = static_cast<std::size_t>(std::find(names.begin(), names.end(), vertical) - names.begin());
  }

  template <int dim>
  RunResult ContinuumRun<dim>::execute()
  {
    return LifeCycle(request, model.output.checkpoint_interval, *this).execute();
  }

  template <int dim>
  typename ContinuumRun<dim>::Rehearsal ContinuumRun<dim>::rehearse(const double states, const double enough)
  {
    Rehearsal             found;
    const base::Stopwatch spent;
    try
      {
        // Ranks go on together or not at all, whatever their clocks say.
        while (!finished() && found.states < states && (found.states < 2 || !on_any_rank(spent.seconds() >= enough)))
          {
            in_words_of_a_run(model, [this] {
              while (!analysis->advance())
                continue;
              row();
              invalid = solid->end_of_validity();
            });
            found.first = found.states == 0 ? spent.seconds() : found.first;
            ++found.states;
          }
      }
    catch (const StoppedShort &stop)
      {
        if (found.states == 0)
          throw;
        failure = found.failure = stop.what();
      }
    found.seconds = spent.seconds();
    found.ended   = finished();
    return found;
  }

  template <int dim>
  std::string ContinuumRun<dim>::size() const
  {
    return fmt::format("{} elements, {} unknowns", solid->mesh().triangulation->n_global_active_cells(),
                       solid->dofs().n_dofs());
  }

  template <int dim>
  std::string ContinuumRun<dim>::stage() const
  {
    return model.is_static() ? "equilibrium" : "motion";
  }

  template <int dim>
  double ContinuumRun<dim>::done() const
  {
    return std::min(1.0, analysis->coordinate() / analysis->end());
  }

  template <int dim>
  void ContinuumRun<dim>::keep_files(const std::filesystem::path &folder, bool)
  {
    location = folder;
    on_first_rank([&] {
      if (model.output.snapshots > 0)
        snapshots.emplace(location, snapshot_name,
                          model.ranks_of_mesh() == MPI_COMM_WORLD && rank_count() > 1 ? ".pvtu" : ".vtu");
    });
  }

  template <int dim>
  void ContinuumRun<dim>::begin(const Record &record)
  {
    for (const std::string &warning : coarse_elements(*solid, model))
      notify(request, &RunObserver::warns, warning);
    if (settle)
      {
        Progress progress("equilibrium of the start");
        analysis->tell_iterations_to([&](const std::string &so_far) { progress.update(so_far); });
        settle(*solid, *analysis);
        analysis->tell_iterations_to({});
        probes->start_at(*analysis->state().displacement);
        if (model.output.fracture_zone)
          dissipated.start_at(*solid, *analysis->state().displacement);
      }
    snapshot();
    if (settle)
      record(row());
  }

  template <int dim>
  void ContinuumRun<dim>::visit_state(RunState &state)
  {
    std::int64_t stopped = was_stopped ? 1 : 0;
    auto         column  = static_cast<std::int64_t>(vertical_index);
    state.scalar("vertical_column", column);
    if (model.control.stop_fraction > 0 && column != static_cast<std::int64_t>(vertical_index))
      throw base::InputError("Output/Curve vertical = " + vertical +
                             ": the run was begun with another column, which decides by Control/Stop fraction when it "
                             "ends.");
    state.scalar("peak", peak);
    state.scalar("was_stopped", stopped);
    state.scalar("snapshot_count", snapshot_count);
    state.scalar("snapshots_due", snapshots_due);
    was_stopped = stopped == 1;
    // Columns are spread over the ranks: all of this one is the first rank's.
    snapshot_times.resize(is_first_rank() ? static_cast<std::size_t>(snapshot_count) : 0);
    state.column("snapshot_times", snapshot_times);
    if (state.reads() && model.output.snapshots > 0)
      on_first_rank([&] { snapshots->restore(snapshot_times); });
    probes->visit_state(state);
    state.group("analysis");
    analysis->visit_state(state);
    if (least_left > 0)
      watch.visit_state(state, *solid);
    if (model.output.fracture_zone)
      {
        dissipated.visit_state(state);
        zone.visit_state(state);
      }
    invalid = solid->end_of_validity();
  }

  template <int dim>
  void ContinuumRun<dim>::snapshot()
  {
    if (model.output.snapshots == 0 || location.empty())
      return;
    const SolidState state    = analysis->state();
    fem::Vector      reaction = *state.internal_force;
    reaction -= *state.external_force;
    reaction.update_ghost_values();
    const double coordinate = analysis->coordinate();
    write_solid(*solid, *state.displacement, reaction,
                {location / snapshot_name, snapshot_name, static_cast<std::size_t>(snapshot_count), coordinate});
    ++snapshot_count;
    on_first_rank([&] {
      snapshots->add(coordinate);
      snapshot_times = snapshots->listed();
    });
  }

  template <int dim>
  SeriesRow ContinuumRun<dim>::row()
  {
    ContinuumEnergy     energy = analysis->energy();
    std::vector<double> values = analysis->values();
    for (const double value : probes->read(analysis->state(), energy))
      values.push_back(value);
    values.insert(values.end(), {energy.external, energy.internal, energy.residual(), energy.balance_error()});

    const double now = std::fabs(values[vertical_index]);
    peak             = std::max(peak, now);
    was_stopped      = now < model.control.stop_fraction * peak;
    if (model.output.fracture_zone)
      {
        dissipated.update(*solid, *analysis->state().displacement);
        zone.note(now, dissipated.so_far());
      }
    if (least_left > 0)
      {
        watch.update(*solid, now);
        has_softened = watch.softens_everywhere() && now < least_left * peak;
      }
    return {{}, values, {}};
  }

  template <int dim>
  void ContinuumRun<dim>::snapshot_if_due()
  {
    const double part = analysis->coordinate() / analysis->end();
    const auto   due  = static_cast<std::int64_t>(std::floor(part * static_cast<double>(model.output.snapshots)));
    if (due > snapshots_due)
      snapshot();
    snapshots_due = due; // fewer than before where a resumed run requests fewer
  }

  template <int dim>
  void ContinuumRun<dim>::advance(const Record &record)
  {
    try
      {
        in_words_of_a_run(model, [&] {
          if (!analysis->advance())
            return;
          record(row());
          snapshot_if_due();
          invalid = solid->end_of_validity();
        });
      }
    catch (const StoppedShort &stop)
      {
        if (!failure_is_an_end)
          throw;
        failure = stop.what();
      }
  }

  template <int dim>
  std::string ContinuumRun<dim>::draw_bodies() const
  {
    const fem::Vector &displacement = *analysis->state().displacement;
    unsigned int       across       = 2;
    if constexpr (dim == 3)
      across = calmest_axis(*solid, displacement);
    return draw_cut(location / "bodies.png", cut_of(*solid, displacement, across),
                    std::filesystem::path(request.scene_file).stem().string());
  }

  template <int dim>
  std::string ContinuumRun<dim>::ended_by() const
  {
    const bool        at_end = analysis->coordinate() >= analysis->end() * (1 - 1e-9);
    const std::string left   = analysis->ended_by();
    return !invalid.empty() ? "end of validity: " + invalid :
           !failure.empty() ? no_equilibrium + failure :
           was_stopped      ? "stop fraction" :
           has_softened     ? softened :
           !left.empty()    ? left :
           at_end           ? "end" :
                              "steps at most";
  }

  template <int dim>
  RunFindings ContinuumRun<dim>::findings(const postprocess::CsvTable &series, const double wall_seconds)
  {
    if (model.is_static())
      extremes = fem::extremes_of(*solid, *analysis->state().displacement);
    ContinuumSize size;
    size.elements = static_cast<double>(solid->mesh().triangulation->n_global_active_cells());
    size.unknowns = static_cast<double>(solid->dofs().n_dofs());
    size.points   = size.elements * solid->quadrature().size();
    const ContinuumReport found{request,
                                series,
                                probes->columns(),
                                size,
                                analysis->cost(),
                                analysis->linear_solver(),
                                wall_seconds,
                                model.is_static(),
                                analysis->contact_figures(),
                                model.references,
                                solid->notes(),
                                extremes,
                                solid->linear(),
                                ended_by(),
                                zone.width(dim), // of all ranks, reported by the first
                                analysis->warning()};
    return is_first_rank() ? RunFindings{found.summary(), found.text(), nullptr} : RunFindings{};
  }

  template <int dim>
  void ContinuumRun<dim>::write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series)
  {
    // A snapshot is due at the end of the path; a run that stopped early shows where.
    if (was_stopped || has_softened || !failure.empty() || !invalid.empty() || snapshots_due < model.output.snapshots)
      snapshot();
    const std::string  title        = std::filesystem::path(request.scene_file).stem().string();
    const fem::Vector &displacement = *analysis->state().displacement;
    const std::string  problem      = draw_damage(*solid, displacement, folder / "damage.png", title);
    const std::string  unshown      = draw_promotion(*solid, displacement, folder / "promoted.png", title);
    std::string        undrawn, unstressed;
    if (extremes && solid->linear())
      unstressed = draw_stress(*solid, displacement, *extremes, folder / "stress.png", title);
    if (!model.contacts.empty()) // on one rank
      undrawn = draw_bodies();
    on_first_rank([&] {
      warn_of_missing("damage.png", problem);
      warn_of_missing("bodies.png", undrawn);
      warn_of_missing("stress.png", unstressed);
      warn_of_missing("promoted.png", unshown);
      write_curve(folder, series, horizontal, vertical, title, model.is_static() && !settle);
    });
  }

  template class ContinuumRun<2>;
  template class ContinuumRun<3>;

  RunResult run(const ContinuumModel &model, const RunRequest &request)
  {
    start_mpi();
    return model.solid.dimension == 2 ? ContinuumRun<2>(request, model).execute() :
                                        ContinuumRun<3>(request, model).execute();
  }
} // namespace apps
