#include "apps/results/life_cycle.h"

#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/process/threads.h"
#include "apps/results/result_listing.h"
#include "apps/results/shared_state.h"
#include "base/errors.h"
#include "postprocess/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr const char *scene_name  = "scene.prm";
    constexpr const char *series_name = "series.csv";

    /** Visits a state with the checkpoint of the first rank, or of the only one. */
    template <typename Checkpoint>
    void visit_with(Checkpoint *checkpoint, const bool reads, const std::function<void(RunState &)> &visit)
    {
      std::optional<WholeState<Checkpoint>> whole;
      if (checkpoint)
        whole.emplace(*checkpoint, reads);
      if (rank_count() == 1)
        return visit(*whole);
      SharedState shared(whole ? &*whole : nullptr, reads);
      visit(shared);
    }
  } // namespace

  std::string way_to_go_on(const RunRequest &request)
  {
    const std::string ranks = rank_count() > 1 ? fmt::format("mpirun -n {} ", rank_count()) : "";
    return fmt::format("Go on with: {}breccia {} {} --resume", ranks, request.command,
                       (request.output_folder / "running" / scene_name).string());
  }

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
    const Stopwatch watch;
    write();
    cost        = watch.seconds();
    since_saved = Stopwatch();
  }

  // --- The run ---

  LifeCycle::LifeCycle(const RunRequest &asked, const double checkpoint_interval, RunWork &what)
    : request(asked)
    , work(what)
    , location(asked.output_folder / "running")
    , clock(checkpoint_interval)
  {
  }

  double LifeCycle::wall_seconds() const { return seconds_before + watch.seconds(); }

  int LifeCycle::execute()
  {
    if (request.resume)
      resume();
    else
      begin();
    announce();
    if (!complete())
      return exit_interrupted;
    finish();
    return exit_success;
  }

  void LifeCycle::begin()
  {
    if (!request.restart)
      on_first_rank([&] { refuse_to_overwrite(request.output_folder); });
    if (!request.quiet)
      set_last_words(is_first_rank() ? "interrupted before there was a state to save." : "");
    work.prepare();
    on_first_rank([&] {
      folder = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::afresh);
      postprocess::write_text(location / scene_name, request.scene_text);
      series = std::make_unique<postprocess::SeriesWriter>(location / series_name, work.series_columns());
    });
    work.begin(location, [this](const SeriesRow &row) { record(row); });
  }

  void LifeCycle::resume()
  {
    std::unique_ptr<postprocess::CheckpointReader> checkpoint;
    on_first_rank([&] {
      folder     = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::resume);
      checkpoint = std::make_unique<postprocess::CheckpointReader>(location / checkpoint_name, request.deciding_text);
      require_same_content(request.inputs, checkpoint->text("inputs"));
    });
    work.reopen(location);
    std::int64_t rows = 0;
    visit_with(checkpoint.get(), true, [&](RunState &state) { visit_run(state, rows); });
    on_first_rank([&] {
      checkpoint->finish();
      series = std::make_unique<postprocess::SeriesWriter>(location / series_name, work.series_columns(), rows);
      postprocess::write_text(location / scene_name, request.scene_text); // entries of output may have changed
    });
  }

  void LifeCycle::visit_run(RunState &state, std::int64_t &rows)
  {
    std::int64_t ranks   = rank_count();
    double       seconds = wall_seconds();
    state.group("run");
    state.scalar("ranks", ranks);
    if (ranks != rank_count())
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
    clock.save([this] { write_checkpoint(); });
    if (request.quiet)
      return;
    set_last_words(is_first_rank() ?
                     "interrupted in work that cannot be stopped half-way; the state of the last checkpoint is kept. " +
                       way_to_go_on(request) :
                     "");
  }

  void LifeCycle::write_checkpoint()
  {
    std::unique_ptr<postprocess::CheckpointWriter> checkpoint;
    std::int64_t                                   rows = 0;
    on_first_rank([&] {
      series->flush();
      rows       = series->rows();
      checkpoint = std::make_unique<postprocess::CheckpointWriter>(location / checkpoint_name, request.deciding_text);
      checkpoint->text("inputs", listed(request.inputs));
    });
    visit_with(checkpoint.get(), false, [&](RunState &state) { visit_run(state, rows); });
    on_first_rank([&] { checkpoint->commit(); });
  }

  void LifeCycle::announce() const
  {
    if (is_first_rank() && !request.quiet)
      fmt::print(stderr, "{}: {}{}; results {} in {}\n", request.scene_file, work.size(), threads_in_words(),
                 request.resume ? "go on" : "grow", location.string());
  }

  void LifeCycle::record(const SeriesRow &row)
  {
    on_first_rank([&] { series->append(row.first, row.values, row.last); });
  }

  bool LifeCycle::complete()
  {
    std::optional<Progress> progress;
    std::string             stage;
    while (!work.finished())
      {
        if (work.stage() != stage)
          {
            stage = work.stage();
            progress.emplace(stage);
          }
        advance();
        progress->update(work.done(), work.details());
        if (on_any_rank(interrupted()))
          {
            const AnsweringInterrupt answering;
            save();
            progress.reset();
            if (is_first_rank() && !request.quiet)
              fmt::print(stderr, "breccia: interrupted in {}, state saved. {}\n", stage, way_to_go_on(request));
            return false;
          }
        if (on_any_rank(clock.is_due()))
          save();
      }
    return true;
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
        throw base::NumericalError(std::string(stop.what()) + " What was computed until then stands in " +
                                   location.string() + ".");
      }
  }

  void LifeCycle::finish()
  {
    constexpr double worth_saving = 10; // seconds of work that an interrupt of the last words would lose
    if (on_any_rank(clock.seconds_since_saved() > worth_saving))
      save();
    std::optional<Progress> progress(std::in_place, "results");
    on_first_rank([&] { series->flush(); });
    const std::string words = work.finish(location, wall_seconds());
    progress.reset();
    on_first_rank([&] {
      folder->publish();
      if (!request.quiet)
        fmt::print("{}{}", words, result_listing(request.output_folder));
    });
  }
} // namespace apps
