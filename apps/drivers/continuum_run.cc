#include "apps/drivers/continuum_run.h"

#include "apps/drivers/continuum_picture.h"
#include "apps/drivers/continuum_solid.h"
#include "apps/drivers/continuum_summary.h"
#include "apps/drivers/solid_snapshot.h"
#include "apps/exit_status.h"
#include "apps/interrupt.h"
#include "apps/mpi_session.h"
#include "apps/progress.h"
#include "apps/results/shared_state.h"
#include "apps/scene/nearest_name.h"
#include "postprocess/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr const char *scene_name    = "scene.prm";
    constexpr const char *series_name   = "series.csv";
    constexpr const char *snapshot_name = "solid";

    double seconds_since(const std::chrono::steady_clock::time_point &start)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    template <int dim>
    std::unique_ptr<ContinuumAnalysis<dim>> make_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
    {
      return model.is_static() ? make_static_analysis(solid, model) : make_explicit_analysis(solid, model);
    }
  } // namespace

  template <int dim>
  ContinuumRun<dim>::ContinuumRun(const RunRequest     &asked,
                                  const ContinuumModel &what,
                                  const Prepare        &prepare,
                                  const Settle         &settle_)
    : request(asked)
    , model(what)
    , settle(settle_)
    , start(Clock::now())
    , last_saved(start)
  {
    solid = make_solid<dim>(model);
    if (prepare)
      prepare(*solid);
    analysis = make_analysis<dim>(*solid, model);
    gauges   = std::make_unique<ContinuumGauges<dim>>(*solid, model);
    choose_curve();
  }

  template <int dim>
  double ContinuumRun<dim>::wall_seconds() const
  {
    return seconds_before + seconds_since(start);
  }

  template <int dim>
  std::vector<postprocess::SeriesColumn> ContinuumRun<dim>::columns() const
  {
    std::vector<postprocess::SeriesColumn> all = analysis->columns();
    for (const auto &column : gauges->columns())
      all.push_back(column);
    for (const char *energy : {"energy_external", "energy_internal"})
      all.push_back({energy, "J"});
    all.push_back({"energy_balance_error", "-"});
    return all;
  }

  template <int dim>
  void ContinuumRun<dim>::choose_curve()
  {
    std::vector<std::string> names;
    for (const auto &column : columns())
      names.push_back(column.name);
    const auto has = [&](const std::string &name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    const auto chosen = [&](const std::string &asked, const char *entry, const std::string &otherwise) {
      if (!asked.empty() && !has(asked))
        throw dem::InputError(std::string("Output/") + entry + " = " + asked + ": series.csv has no such column. " +
                              did_you_mean(asked, names));
      return asked.empty() ? otherwise : asked;
    };
    const std::string reaction = gauges->first_reaction();
    horizontal     = chosen(model.output.horizontal, "Curve horizontal", has("opening") ? "opening" : names.front());
    vertical       = chosen(model.output.vertical, "Curve vertical", reaction.empty() ? "energy_internal" : reaction);
    vertical_index = static_cast<std::size_t>(std::find(names.begin(), names.end(), vertical) - names.begin());
  }

  template <int dim>
  int ContinuumRun<dim>::execute()
  {
    if (request.resume)
      resume();
    else
      begin();
    if (is_first_rank() && !request.quiet)
      fmt::print(stderr, "{}: {} elements, {} unknowns; results {} in {}\n", request.scene_file,
                 solid->mesh().triangulation->n_global_active_cells(), solid->dofs().n_dofs(),
                 request.resume ? "go on" : "grow", location.string());
    complete();
    if (was_interrupted)
      return exit_interrupted;
    finish();
    return exit_success;
  }

  template <int dim>
  void ContinuumRun<dim>::begin()
  {
    location = request.output_folder / "running";
    on_first_rank([&] {
      folder   = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::afresh);
      location = folder->running();
      postprocess::write_text(location / scene_name, request.scene_text);
      series = std::make_unique<postprocess::SeriesWriter>(location / series_name, columns());
      if (model.output.snapshots > 0)
        snapshots.emplace(location, snapshot_name, rank_count() > 1 ? ".pvtu" : ".vtu");
    });
    if (settle)
      {
        settle(*solid, *analysis);
        gauges->start_at(*analysis->state().displacement);
      }
    snapshot();
    if (settle)
      record();
  }

  template <int dim>
  void ContinuumRun<dim>::visit_own_state(dem::StateVisitor &visitor)
  {
    visitor.scalar("series_rows", row_count);
    visitor.scalar("peak", peak);
    visitor.scalar("snapshot_count", snapshot_count);
    visitor.scalar("snapshots_due", snapshots_due);
    gauges->visit_state(visitor);
  }

  template <int dim>
  void ContinuumRun<dim>::resume()
  {
    location = request.output_folder / "running";
    std::unique_ptr<postprocess::CheckpointReader> checkpoint;
    on_first_rank([&] {
      folder     = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::resume);
      checkpoint = std::make_unique<postprocess::CheckpointReader>(location / checkpoint_name, request.deciding_text);
      checkpoint->group("run");
      std::int64_t ranks = 0;
      checkpoint->scalar("ranks", ranks);
      if (ranks != rank_count())
        throw dem::InputError(fmt::format("--resume: {} was written by {} ranks, and there are {} now. Start as many.",
                                          (location / checkpoint_name).string(), ranks, rank_count()));
      checkpoint->scalar("wall_seconds", seconds_before);
      if (model.output.snapshots > 0)
        {
          snapshots.emplace(location, snapshot_name, rank_count() > 1 ? ".pvtu" : ".vtu");
          snapshots->visit_state(*checkpoint);
        }
    });
    SharedState shared(checkpoint.get(), SharedState::Direction::read);
    visit_own_state(shared);
    on_first_rank([&] { checkpoint->group("analysis"); });
    analysis->visit_state(shared);
    on_first_rank([&] {
      checkpoint->finish();
      series = std::make_unique<postprocess::SeriesWriter>(location / series_name, columns(), row_count);
    });
  }

  template <int dim>
  void ContinuumRun<dim>::save()
  {
    std::unique_ptr<postprocess::CheckpointWriter> checkpoint;
    on_first_rank([&] {
      series->flush();
      checkpoint = std::make_unique<postprocess::CheckpointWriter>(location / checkpoint_name, request.deciding_text);
      std::int64_t ranks   = rank_count();
      double       seconds = wall_seconds();
      checkpoint->group("run");
      checkpoint->scalar("ranks", ranks);
      checkpoint->scalar("wall_seconds", seconds);
      if (snapshots)
        snapshots->visit_state(*checkpoint);
    });
    SharedState shared(checkpoint.get(), SharedState::Direction::write);
    visit_own_state(shared);
    on_first_rank([&] { checkpoint->group("analysis"); });
    analysis->visit_state(shared);
    on_first_rank([&] { checkpoint->commit(); });
    last_saved = Clock::now();
  }

  template <int dim>
  void ContinuumRun<dim>::snapshot()
  {
    if (model.output.snapshots == 0)
      return;
    const SolidState state    = analysis->state();
    fem::Vector      reaction = *state.internal_force;
    reaction -= *state.external_force;
    reaction.update_ghost_values();
    const double coordinate = analysis->coordinate();
    write_solid(*solid, *state.displacement, reaction,
                {location / snapshot_name, snapshot_name, static_cast<std::size_t>(snapshot_count), coordinate});
    ++snapshot_count;
    on_first_rank([&] { snapshots->add(coordinate); });
  }

  /** The row of a new state, and what else is due. False ends the run. */
  template <int dim>
  bool ContinuumRun<dim>::record()
  {
    const ContinuumEnergy energy = analysis->energy();
    std::vector<double>   row    = analysis->values();
    for (const double value : gauges->read(analysis->state(), energy.internal))
      row.push_back(value);
    row.insert(row.end(), {energy.external, energy.internal, energy.balance_error()});
    on_first_rank([&] { series->append(row); });
    ++row_count;

    const double part = analysis->coordinate() / analysis->end();
    if (const auto due = static_cast<std::int64_t>(std::floor(part * static_cast<double>(model.output.snapshots)));
        due > snapshots_due)
      {
        snapshots_due = due;
        snapshot();
      }
    peak = std::max(peak, std::fabs(row[vertical_index]));
    if (std::fabs(row[vertical_index]) < model.control.stop_fraction * peak)
      {
        was_stopped = true;
        return false;
      }
    was_interrupted = on_any_rank(interrupted());
    if (!was_interrupted && on_any_rank(seconds_since(last_saved) > model.output.checkpoint_interval))
      save();
    return !was_interrupted;
  }

  template <int dim>
  void ContinuumRun<dim>::complete()
  {
    std::optional<Progress> progress;
    if (is_first_rank())
      progress.emplace(model.is_static() ? "equilibrium" : "motion");
    try
      {
        analysis->run([&] {
          const bool        goes_on = record();
          const double      part    = std::min(1.0, analysis->coordinate() / analysis->end());
          const std::string details = analysis->details();
          if (progress)
            progress->update(part, details);
          return goes_on;
        });
      }
    catch (const fem::NoEquilibrium &failure)
      {
        fail(failure.what());
      }
    catch (const fem::MaterialFailure &failure)
      {
        fail(failure.what());
      }
    catch (const dem::InputError &)
      {
        throw;
      }
    catch (const std::invalid_argument &refusal)
      {
        throw dem::InputError(refusal.what());
      }
    if (!was_interrupted)
      return;
    save();
    if (progress)
      progress->clear();
    if (is_first_rank() && !request.quiet)
      fmt::print(stderr, "breccia: interrupted, state saved. Go on with: breccia run {} --resume\n",
                 (location / scene_name).string());
  }

  /** The last state that was found stays, with what leads to it. */
  template <int dim>
  void ContinuumRun<dim>::fail(const std::string &reason)
  {
    save();
    snapshot();
    throw dem::NumericalError(reason + " What was computed until then stands in " + location.string() + ".");
  }

  template <int dim>
  void ContinuumRun<dim>::finish()
  {
    // The way to the end asks for a snapshot there; a run that stopped early shows where.
    if (was_stopped || snapshots_due < model.output.snapshots)
      snapshot();
    ContinuumSize size;
    size.elements             = static_cast<double>(solid->mesh().triangulation->n_global_active_cells());
    size.unknowns             = static_cast<double>(solid->dofs().n_dofs());
    size.points               = size.elements * solid->quadrature().size();
    const std::string problem = draw_damage(*solid, *analysis->state().displacement, location / "damage.png",
                                            std::filesystem::path(request.scene_file).stem().string());
    const bool        at_end  = analysis->coordinate() >= analysis->end() * (1 - 1e-9);
    on_first_rank([&] {
      if (!problem.empty())
        fmt::print(stderr, "breccia: warning: no damage.png: {}\n", problem);
      series->flush();
      ContinuumReport report{request,
                             postprocess::read_csv_table(location / series_name, true),
                             size,
                             analysis->cost(),
                             analysis->linear_solver(),
                             wall_seconds(),
                             horizontal,
                             vertical,
                             model.is_static(),
                             was_stopped ? "stop fraction" :
                             at_end      ? "end" :
                                           "steps at most"};
      report.write(location);
      folder->publish();
      if (!request.quiet)
        fmt::print("{}", report.text());
    });
  }

  template class ContinuumRun<2>;
  template class ContinuumRun<3>;
} // namespace apps
