#include "apps/runs/particles/run.h"

#include "apps/figures/drawn_curve.h"
#include "apps/forecasts/duration.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/warning.h"
#include "apps/runs/particles/break_results.h"
#include "apps/runs/particles/laboratory_report.h"
#include "apps/runs/particles/report.h"
#include "apps/specimens/left_out_of_balance.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/specimens/written_state.h"
#include "base/errors.h"
#include "dem/specimen/told_to_first.h"
#include "postprocess/packings/packing_io.h"
#include "postprocess/pictures/specimen_picture.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    /** Part of a test's speed at which its loading is repeated. */
    constexpr double slower = 0.5;

    /** What another scene can begin with: places as they are, outside any mould. */
    dem::Packing
    at_end(const dem::Packing &packing, const std::vector<Eigen::Vector3d> &places, const dem::ClumpReadings &clumps)
    {
      dem::Packing now = packing;
      now.centre       = places;
      const auto first = clumps.size() - packing.bodies.size(); // others come from the scene
      for (std::size_t b = 0; b < packing.bodies.size(); ++b)
        {
          const dem::ClumpState clump = clumps.state(first + b);
          now.bodies[b].centre        = clump.position;
          now.bodies[b].inertia       = clump.turned * packing.bodies[b].inertia * clump.turned.transpose();
        }
      return now;
    }
  }

  ParticlesRun::ParticlesRun(const RunRequest &requested, const ParticlesModel &what)
    : request(requested)
    , model(what)
    , sampling(model.end_time, model.output)
    , rows_of_test(model.output)
  {
  }

  RunResult ParticlesRun::execute() { return LifeCycle(request, model.output.checkpoint_interval, *this).execute(); }

  void ParticlesRun::make_body()
  {
    const Progress progress("links");
    body      = std::make_shared<ParticlesBody>(model, packing);
    materials = MaterialCounts(packing.material_names, body->specimen());
    if (!model.precice.given())
      return;
    if (rank_count() > 1)
      throw base::InputError("preCICE: particles spread over several processes cannot be coupled yet. Start one.");
    driven   = std::make_unique<DrivenParticles>(*body);
    exchange = model.precice.couple(*driven, body->all_groups().at(model.precice.vertices));
  }

  void ParticlesRun::make_start()
  {
    make_body();
    const Progress progress("initial state");
    start = body->start();
  }

  void ParticlesRun::prepare()
  {
    if (model.source.source == SpecimenSection::Source::genesis)
      {
        genesis = std::make_unique<GenesisWork>(model.source, model.physics.dimension);
        genesis->take_kept();
        return;
      }
    packing = model.packing();
    make_start();
  }

  void ParticlesRun::open(const std::filesystem::path &folder)
  {
    if (model.output.snapshots > 0)
      snapshots.open(folder, "particles", model.output.pieces,
                     {!model.walls.walls.empty() || model.laboratory.given(), model.bonded(), body->link_classes()});
  }

  void ParticlesRun::keep_files(const std::filesystem::path &folder, const bool fresh)
  {
    location = folder;
    if (genesis)
      return;
    if (fresh)
      keep_packing(packing, folder);
    open(folder);
  }

  void ParticlesRun::begin(const Record &record)
  {
    if (!genesis)
      begin_motion(record);
  }

  void ParticlesRun::begin_motion(const Record &record)
  {
    snapshots.take(body->specimen());
    record({{}, body->row(), {}});
    if (body->test())
      begin_rows_of_test();
  }

  void ParticlesRun::begin_rows_of_test()
  {
    const dem::ObservedSpecimen &specimen = body->specimen();
    rows_of_test.begin(specimen.time(),
                       static_cast<double>(body->test()->parameters().ramp_steps) * specimen.time_step());
  }

  void ParticlesRun::reopen(const std::filesystem::path &folder)
  {
    resumed = folder;
    if (model.source.source == SpecimenSection::Source::genesis) // its state says whether it is over
      return prepare();
    packing = kept_packing(folder);
    make_body();
  }

  void ParticlesRun::visit_state(RunState &state)
  {
    state.group("particles");
    std::int64_t growing = genesis ? 1 : 0;
    if (model.source.source == SpecimenSection::Source::genesis)
      state.scalar("growing", growing);
    if (growing != 0)
      {
        state.group("genesis");
        return genesis->visit_state(state);
      }
    if (genesis) // a reader, of a run whose particles have grown up
      {
        genesis.reset();
        packing = kept_packing(resumed);
        make_body();
        if (!location.empty())
          open(location);
      }
    apps::visit_state(state, start);
    sampling.visit_state(state);
    if (model.laboratory.given())
      rows_of_test.visit_state(state);
    state.group("specimen");
    body->visit_state(state);
    if (exchange)
      exchange->visit_state(state);
    snapshots.visit_state(state);
    visit_slow(state);
    if (state.reads())
      steps_before = body->specimen().steps();
  }

  void ParticlesRun::visit_slow(RunState &state)
  {
    if (!model.laboratory.check_speed)
      return;
    std::int64_t kept = slow ? 1 : 0;
    state.group("half_speed");
    state.scalar("kept", kept);
    if (kept == 0)
      return;
    if (!slow)
      {
        slow = std::make_unique<ParticlesBody>(model, packing);
        slow->load_at(slower);
      }
    slow->visit_state(state);
  }

  std::string ParticlesRun::size() const
  {
    if (genesis)
      return fmt::format("{} particles", genesis->particles());
    const dem::Counts counts = body->specimen().counts();
    return fmt::format("{} particles, {} links", counts.particles, counts.links);
  }

  double ParticlesRun::done() const
  {
    if (genesis)
      return genesis->done();
    return sampling.finished() && slow ? slow->done() : body->done();
  }

  std::string ParticlesRun::details() const
  {
    if (genesis)
      return genesis->details();
    const dem::ObservedSpecimen &moves  = sampling.finished() && slow ? slow->specimen() : body->specimen();
    const dem::Counts            counts = moves.counts();
    const std::string            text =
      fmt::format("time {:.4g} s, {} contacts, {} links broken", moves.time(), counts.contacts, counts.broken);
    if (&moves != &body->specimen())
      return text;
    return text + fmt::format(", {:.0f} steps/s",
                              static_cast<double>(moves.steps() - steps_before) / std::max(stepping_seconds, 1e-9));
  }

  void ParticlesRun::grow(const Record &record)
  {
    if (!genesis->finished()) // it may have grown before
      genesis->advance();
    if (!genesis->finished())
      return;
    const auto made = std::make_shared<const dem::Packing>(genesis->packing());
    if (!location.empty())
      genesis->write(location, *made);
    grown_text         = genesis->text();
    model.source.grown = made;
    genesis.reset();
    packing = model.packing();
    make_start();
    if (!location.empty())
      keep_files(location, true);
    begin_motion(record);
  }

  void ParticlesRun::advance(const Record &record)
  {
    if (genesis)
      return grow(record);
    if (sampling.finished())
      return slow->advance_to(std::min(slow->specimen().time() + seconds_of_a_row(), last_time_of_slow()));
    keep_start_of_loading();
    const base::Stopwatch watch;
    const bool            due = move();
    stepping_seconds += watch.seconds();
    if (!due) // interrupted on the way
      return;
    record_row(record);
    if (sampling.finished() || (body->test() ? rows_of_test.snapshot_due() : sampling.snapshot_due()))
      snapshots.take(body->specimen());
  }

  bool ParticlesRun::move()
  {
    if (exchange)
      {
        exchange->advance();
        const bool due = sampling.take(body->specimen().time());
        if (exchange->is_over())
          sampling.stop();
        return due || exchange->is_over();
      }
    if (!body->test())
      {
        body->advance_to(sampling.next_time());
        return sampling.take(body->specimen().time());
      }
    const bool loaded = body->test_is_loading();
    body->advance_to(std::min(rows_of_test.next_time(), model.last_time()));
    const double now = body->specimen().time();
    if (body->test_is_over() || now >= model.last_time())
      sampling.stop();
    if (!loaded && body->test_is_loading())
      {
        begin_rows_of_test();
        return true;
      }
    return rows_of_test.take(now) || sampling.finished();
  }

  void ParticlesRun::keep_start_of_loading()
  {
    if (slow || !model.laboratory.check_speed || !body->test_is_loading())
      return;
    slow = std::make_unique<ParticlesBody>(model, packing);
    slow->repeat_loading_of(*body, slower);
  }

  bool ParticlesRun::checks_speed() const
  {
    return slow && body->test_is_over() && body->test()->figures().strength.found && !slow->test_is_over() &&
           slow->specimen().time() < last_time_of_slow();
  }

  void ParticlesRun::record_row(const Record &record)
  {
    const std::vector<double> row = body->row();
    if (!model.stops.fulfilled(model.column_names(), row).empty())
      sampling.stop();
    record({{}, row, {}});
  }

  std::string ParticlesRun::draw_crack(const std::filesystem::path &file,
                                       const dem::ParticleOutput   &particles,
                                       const dem::LinkOutput       &links) const
  {
    postprocess::PictureSlab slab;
    slab.axis      = model.physics.dimension == 2 ? 2 : 1;
    slab.materials = packing.material_names;
    if (model.mix.given())
      slab.classes = body->link_classes().of_pairs();
    return postprocess::picture_of_specimen(file, particles, links, "At the end", slab);
  }

  RunFindings ParticlesRun::findings(const postprocess::CsvTable &series, const double wall_seconds)
  {
    const ParticlesReport found{request,
                                model,
                                *body,
                                materials,
                                start,
                                series,
                                wall_seconds,
                                left_out_of_balance(*model.materials(packing).bonds(model.physics), packing.radius),
                                slow ? slow->test() : nullptr,
                                exchange.get()};
    return {found.summary(), grown_text + found.text(),
            std::shared_ptr<const dem::ObservedSpecimen>(body, &body->specimen())};
  }

  void ParticlesRun::write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series)
  {
    const dem::ObservedSpecimen &specimen = body->specimen();
    {
      const dem::ParticleOutput particles = dem::particles_for_first(specimen);
      on_first_rank([&] {
        postprocess::write_packing(at_end(packing, particles.position, specimen.clumps()),
                                   folder / "packing_at_end.h5");
      });
      if (model.bonded())
        write_cracks(folder, particles);
    }
    if (model.bonded())
      write_state(specimen, folder / "state.h5");
    on_first_rank([&] { write_curves(folder, series); });
  }

  void ParticlesRun::write_cracks(const std::filesystem::path &folder, const dem::ParticleOutput &particles) const
  {
    {
      const dem::LinkOutput damaged = dem::damaged_links_for_first(body->specimen());
      on_first_rank([&] { warn_of_missing("crack.png", draw_crack(folder / "crack.png", particles, damaged)); });
    }
    BreakResults{body->specimen(), packing.material_names}.write(folder, particles);
  }

  void ParticlesRun::write_curves(const std::filesystem::path &folder, const postprocess::CsvTable &series) const
  {
    warn_of_missing("grading.png", model.mixed().draw_grading(folder));
    const std::string title = std::filesystem::path(request.scene_file).stem().string();
    if (body->test())
      LaboratoryReport{model.laboratory, *body->test(), slow ? slow->test() : nullptr}.write(folder, title);
    if (model.draws_curve())
      write_curve(folder, series, model.curve_horizontal(), model.curve_vertical(), title);
  }

  RunResult run(const ParticlesModel &model, const RunRequest &request)
  {
    start_mpi_for_ranks();
    return ParticlesRun(request, model).execute();
  }
} // namespace apps
