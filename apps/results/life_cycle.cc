#include "apps/results/life_cycle.h"

#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/run_observer.h"
#include "apps/results/shared_state.h"
#include "base/errors.h"
#include "dem/specimen/observation.h"
#include "dem/specimen/rank_shares.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace apps
{
  namespace
  {
    /** Visits a state with the checkpoint of the first rank, or of the only one. */
    template <typename Checkpoint>
    void visit_with(Checkpoint                            *checkpoint,
                    const RunWork                         &work,
                    const bool                             reads,
                    const std::function<void(RunState &)> &visit)
    {
      std::optional<WholeState<Checkpoint>> whole;
      if (checkpoint)
        whole.emplace(*checkpoint, reads);
      if (rank_count() == 1)
        return visit(*whole);
      SharedState shared(whole ? &*whole : nullptr, reads, work.whole_on_each_rank());
      visit(shared);
    }

    /** What surrounds the work of a request, as long as it lives: what stops it, and silence where nobody shows progress. */
    class Surroundings
    {
    public:
      explicit Surroundings(const RunRequest &request)
        : stops(request.stop)
      {
        if (!shows_progress(request))
          silence.emplace();
      }

    private:
      StopsToo                  stops;
      std::optional<SilentWork> silence;
    };
  } // namespace

  std::string way_to_go_on(const RunRequest &request)
  {
    const std::string ranks = rank_count() > 1 ? fmt::format("mpirun -n {} ", rank_count()) : "";
    return fmt::format("Go on with: {}breccia {} {} --resume", ranks, request.command,
                       (request.output_folder / "running" / "scene.prm").string());
  }

  namespace
  {
    void append_shares(nlohmann::json &summary, const dem::ObservedSpecimen &specimen)
    {
      const std::vector<dem::RankWork>   work   = specimen.shares();
      const std::vector<dem::RankMemory> memory = dem::memory_of_ranks(specimen);
      for (std::size_t r = 0; r < work.size(); ++r)
        summary["ranks"].push_back({{"particles", work[r].particles},
                                    {"links", work[r].links},
                                    {"copied_links", work[r].copies},
                                    {"wall_contacts", work[r].wall_contacts},
                                    {"ghosts", work[r].ghosts},
                                    {"neighbours", work[r].neighbours},
                                    {"messages", work[r].messages},
                                    {"bytes", work[r].bytes},
                                    {"memory", memory[r].in_steps}});
    }
  } // namespace

  // --- When to save ---

  CheckpointClock::CheckpointClock(const double longest_interval)
    : longest(longest_interval)
  {
  }

  double CheckpointClock::seconds_since_saved() const { return since_saved.seconds(); }

  bool CheckpointClock::is_due() const
  {
    constexpr double usual = 60, costs_at_least = 50;
    return seconds_since_saved() > std::min(longest, std::max(usual, costs_at_least * cost));
  }

  void CheckpointClock::save(const std::function<void()> &write)
  {
    const base::Stopwatch watch;
    write();
    cost        = watch.seconds();
    since_saved = base::Stopwatch();
  }

  // --- The run ---

  LifeCycle::LifeCycle(const RunRequest &requested, const double checkpoint_interval, RunWork &what)
    : request(requested)
    , work(what)
    , location(requested.output_folder.empty() ? std::filesystem::path() : requested.output_folder / "running")
    , clock(checkpoint_interval)
  {
    result.folder = requested.output_folder;
  }

  RunResult LifeCycle::execute()
  {
    start();
    while (go_on())
      continue;
    return finish();
  }

  void LifeCycle::start()
  {
    const Surroundings around(request);
    if (request.resume)
      resume();
    else
      begin();
  }

  RunResult LifeCycle::finish()
  {
    const Surroundings around(request);
    if (result.end == RunResult::End::complete)
      complete();
    notify(request, &RunObserver::ends, result);
    return std::move(result);
  }

  void LifeCycle::begin()
  {
    if (keeps_files() && !request.restart)
      on_first_rank([&] { refuse_to_overwrite(request.output_folder); });
    notify(request, &RunObserver::prepares);
    work.prepare();
    result.series = empty_series(work.series_columns(), "series");
    if (keeps_files())
      {
        on_first_rank([&] {
          files = std::make_unique<RunFiles>(request);
          files->begin(work.series_columns());
        });
        keep_files(true);
      }
    const RunOutline outline{request.scene_file, work.size(), work.series_columns(), location, false};
    notify(request, &RunObserver::begins, outline);
    work.begin([this](const SeriesRow &row) { record(row); });
  }

  void LifeCycle::resume()
  {
    if (!keeps_files())
      throw base::InputError("--resume: a run without a folder has nothing to go on from.");
    std::unique_ptr<postprocess::CheckpointReader> checkpoint;
    on_first_rank([&] {
      files      = std::make_unique<RunFiles>(request);
      checkpoint = files->last_checkpoint();
    });
    work.reopen(location);
    keep_files(false);
    std::int64_t rows = 0;
    visit_with(checkpoint.get(), work, true, [&](RunState &state) { visit_run(state, rows); });
    result.series = empty_series(work.series_columns(), "series");
    on_first_rank([&] {
      checkpoint->finish();
      result.series = files->go_on(work.series_columns(), rows);
    });
    const RunOutline outline{request.scene_file, work.size(), work.series_columns(), location, true};
    notify(request, &RunObserver::begins, outline);
  }

  void LifeCycle::by_those_who_write(const std::function<void()> &action) const
  {
    if (work.whole_on_each_rank())
      on_first_rank(action);
    else
      action();
  }

  void LifeCycle::keep_files(const bool fresh)
  {
    by_those_who_write([&] { work.keep_files(location, fresh); });
  }

  void LifeCycle::visit_run(RunState &state, std::int64_t &rows)
  {
    std::int64_t ranks   = rank_count();
    double       seconds = wall_seconds();
    state.group("run");
    state.scalar("ranks", ranks);
    if (ranks != rank_count() && !work.whole_on_each_rank())
      throw base::InputError(fmt::format("--resume: {} was written by {} ranks, and there are {} now. Start as many.",
                                         (location / checkpoint_name).string(), ranks, rank_count()));
    state.scalar("wall_seconds", seconds);
    state.scalar("series_rows", rows);
    if (state.reads())
      seconds_before = seconds;
    work.visit_state(state);
  }

  void LifeCycle::save()
  {
    if (!keeps_files())
      return;
    clock.save([this] { write_checkpoint(); });
    result.go_on = way_to_go_on(request);
    notify(request, &RunObserver::saved, result.go_on);
  }

  void LifeCycle::write_checkpoint()
  {
    std::unique_ptr<postprocess::CheckpointWriter> checkpoint;
    std::int64_t                                   rows = 0;
    on_first_rank([&] { checkpoint = files->new_checkpoint(rows); });
    visit_with(checkpoint.get(), work, false, [&](RunState &state) { visit_run(state, rows); });
    on_first_rank([&] { checkpoint->commit(); });
  }

  void LifeCycle::record(const SeriesRow &row)
  {
    append(result.series, row);
    if (keeps_files())
      on_first_rank([&] { files->record(row); });
    notify(request, &RunObserver::row, row);
  }

  bool LifeCycle::go_on()
  {
    const Surroundings around(request);
    if (work.finished())
      {
        result.stage.clear();
        return false;
      }
    if (work.stage() != result.stage)
      {
        result.stage = work.stage();
        notify(request, &RunObserver::stage, result.stage);
      }
    advance();
    notify(request, &RunObserver::progress, work.done(), work.details());
    if (interrupted_on_any_rank())
      {
        interrupt();
        return false;
      }
    if (on_any_rank(clock.is_due()))
      save();
    return true;
  }

  void LifeCycle::interrupt()
  {
    const AnsweringInterrupt answering;
    save();
    result.end = RunResult::End::interrupted;
  }

  void LifeCycle::advance()
  {
    try
      {
        work.advance([this](const SeriesRow &row) { record(row); });
      }
    catch (const StoppedShort &stop)
      {
        save();
        work.leave_last_state();
        throw base::NumericalError(keeps_files() ?
                                     std::string(stop.what()) + " What was computed until then stands in " +
                                       location.string() + "." :
                                     stop.what());
      }
  }

  void LifeCycle::complete()
  {
    constexpr double worth_saving = 10; // seconds of work that an interrupt of the last words would lose
    if (on_any_rank(clock.seconds_since_saved() > worth_saving))
      save();
    notify(request, &RunObserver::stage, "results");
    if (keeps_files())
      on_first_rank([&] { files->flush(); });
    RunFindings found = work.findings(result.series, wall_seconds());
    if (found.specimen)
      append_shares(found.summary, *found.specimen);
    if (keeps_files())
      {
        work.write_results(location, result.series);
        on_first_rank([&] { files->publish(found.summary); });
      }
    result.summary  = std::move(found.summary);
    result.words    = std::move(found.words);
    result.specimen = std::move(found.specimen);
    result.go_on.clear();
  }
} // namespace apps
