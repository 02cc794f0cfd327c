#include "apps/runs/coupled/run.h"

#include "apps/figures/drawn_curve.h"
#include "apps/forecasts/duration.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/snapshots.h"
#include "apps/results/warning.h"
#include "apps/runs/coupled/report.h"
#include "apps/runs/particles/break_results.h"
#include "apps/specimens/left_out_of_balance.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/specimens/written_state.h"
#include "base/errors.h"
#include "dem/specimen/told_to_first.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  CoupledRun::CoupledRun(const RunRequest &requested, const CoupledModel &what)
    : SampledMotion(what.particles.end_time, what.particles.output)
    , request(requested)
    , model(what)
  {
  }

  RunResult CoupledRun::execute()
  {
    return LifeCycle(request, model.particles.output.checkpoint_interval, *this).execute();
  }

  void CoupledRun::make_body()
  {
    const Progress progress("links");
    body      = make_coupled_body(model, packing, media);
    materials = MaterialCounts(packing.material_names, body->particles().specimen());
  }

  void CoupledRun::prepare()
  {
    std::optional<dem::Packing> cell;
    packing = model.packing(&cell);
    media   = model.media(cell);
    make_body();
    const Progress progress("initial state");
    start = body->start();
  }

  void CoupledRun::keep_files(const std::filesystem::path &folder, const bool fresh)
  {
    location = folder;
    if (fresh)
      keep_packing(packing, folder);
    if (fresh && !media.empty())
      media.write(folder / ParticleMedia::file_name);
    if (model.particles.output.snapshots == 0)
      return;
    snapshots.open(folder, "particles", model.particles.output.pieces,
                   {true, model.particles.bonded(), body->particles().link_classes()});
    solids.emplace(folder, "solid", ".vtu");
  }

  void CoupledRun::begin(const Record &record)
  {
    snapshot();
    record({{}, body->row(), {}});
    body->watch();
  }

  void CoupledRun::reopen(const std::filesystem::path &folder)
  {
    packing = kept_packing(folder);
    media   = ParticleMedia::kept_in(folder, model.continuum);
    make_body();
  }

  void CoupledRun::visit_state(RunState &state)
  {
    state.group("coupled");
    apps::visit_state(state, start);
    visit_sampling(state);
    body->visit_state(state);
    snapshots.visit_state(state);
    visit_snapshots(state, "solid_snapshots", solids);
    if (state.reads())
      windows_before = body->windows();
  }

  std::string CoupledRun::size() const
  {
    const dem::Counts counts = body->particles().specimen().counts();
    return fmt::format("{} elements, {} unknowns, {} particles, {} links", body->elements(), body->unknowns(),
                       counts.particles, counts.links);
  }

  std::string CoupledRun::details() const
  {
    const dem::Counts counts = body->particles().specimen().counts();
    return fmt::format("time {:.4g} s, {} contacts, {} links broken, {:.0f} steps/s", body->time(),
                       counts.contacts + counts.wall_contacts, counts.broken,
                       static_cast<double>(body->windows() - windows_before) / std::max(stepping_seconds, 1e-9));
  }

  void CoupledRun::advance_to(const double time)
  {
    const base::Stopwatch watch;
    body->advance_to(time, most_windows);
    stepping_seconds += watch.seconds();
  }

  void CoupledRun::record_row(const Record &record)
  {
    const std::vector<double> row = body->row();
    std::vector<std::string>  names;
    for (const auto &column : body->columns())
      names.push_back(column.name);
    if (!model.particles.stops.fulfilled(names, row).empty() || !body->end_of_validity().empty())
      stop();
    record({{}, row, {}});
    body->watch();
  }

  void CoupledRun::snapshot()
  {
    snapshots.take(body->particles().specimen());
    if (!solids)
      return;
    body->write_solid(location, solids->size());
    solids->add(body->time());
    list_together();
  }

  void CoupledRun::list_together() const
  {
    std::vector<postprocess::PvdPart> parts;
    const base::Column               &times = solids->listed();
    for (std::size_t i = 0; i < times.size(); ++i)
      {
        const auto list = [&](const int part, const char *name, const char *folder, const char *extension) {
          parts.push_back({times[i], part, name, fmt::format("{0}/{0}_{1:06}{2}", folder, i, extension)});
        };
        list(0, "solid", "solid", ".vtu");
        list(1, "particles", "particles_particles",
             model.particles.output.pieces == SnapshotPieces::per_rank ? ".pvtp" : ".vtp");
        list(2, "surfaces", "particles_walls", ".vtp");
      }
    postprocess::write_pvd(location / "coupled.pvd", parts);
  }

  RunFindings CoupledRun::findings(const postprocess::CsvTable &series, const double wall_seconds)
  {
    const CoupledReport found{
      request,
      model,
      *body,
      materials,
      start,
      series,
      wall_seconds,
      left_out_of_balance(*model.particles.materials(packing).bonds(model.particles.physics), packing.radius)};
    return {found.summary(), found.text(),
            std::shared_ptr<const dem::ObservedSpecimen>(body, &body->particles().specimen())};
  }

  void CoupledRun::write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series)
  {
    const dem::ObservedSpecimen &specimen = body->particles().specimen();
    {
      const dem::ParticleOutput particles = dem::particles_for_first(specimen);
      write_pictures(folder, particles);
      if (model.particles.bonded() || specimen.logged_breaks() > 0) // glue may have a law of its own
        BreakResults{specimen, packing.material_names}.write(folder, particles);
    }
    if (model.particles.bonded())
      write_state(specimen, folder / "state.h5");
    on_first_rank([&] {
      const auto [horizontal, vertical] = model.curve(body->columns(), body->reported());
      write_curve(folder, series, horizontal, vertical, title());
    });
  }

  void CoupledRun::write_pictures(const std::filesystem::path &folder, const dem::ParticleOutput &particles) const
  {
    const bool            bonded = model.particles.bonded();
    const dem::LinkOutput damaged =
      bonded ? dem::damaged_links_for_first(body->particles().specimen()) : dem::LinkOutput();
    on_first_rank([&] {
      if (bonded)
        warn_of_missing("crack.png", body->draw_cracks(folder / "crack.png", title(), particles, damaged));
      warn_of_missing("coupled.png", body->draw(folder / "coupled.png", title(), particles));
      warn_of_missing("grading.png", model.particles.mixed().draw_grading(folder));
      warn_of_missing("damage.png", body->draw_damage(folder / "damage.png", title()));
      warn_of_missing("promoted.png", body->draw_promotion(folder / "promoted.png", title()));
    });
  }

  std::string CoupledRun::title() const { return std::filesystem::path(request.scene_file).stem().string(); }

  RunResult run(const CoupledModel &model, const RunRequest &request)
  {
    start_mpi();
    if (rank_count() > 1 && model.continuum.has_cells())
      throw base::InputError(fmt::format("Materials: a solid of cells beside particles runs in one process, and mpirun "
                                         "has started {}. Use --threads.",
                                         rank_count()));
    return CoupledRun(request, model).execute();
  }
} // namespace apps
