#include "apps/drivers/cell_run.h"

#include "apps/drivers/cell_report.h"
#include "apps/drivers/specimen_packing.h"
#include "apps/exit_status.h"
#include "apps/interrupt.h"
#include "apps/progress.h"
#include "postprocess/atomic_file.h"
#include "postprocess/checkpoint.h"
#include "postprocess/packing_io.h"
#include "postprocess/specimen_picture.h"
#include "postprocess/summary.h"
#include "postprocess/vtk_links.h"
#include "postprocess/vtk_particles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    std::vector<postprocess::SeriesColumn> series_columns()
    {
      std::vector<postprocess::SeriesColumn> columns = {{"time", "s"}};
      for (const char *component : {"xx", "yy", "zz", "yz", "zx", "xy"})
        columns.push_back({std::string("strain_") + component, "-"});
      for (const char *component : {"xx", "yy", "zz", "yz", "zx", "xy"})
        columns.push_back({std::string("stress_") + component, "Pa"});
      for (const auto &[name, unit] :
           std::initializer_list<std::pair<const char *, const char *>>{{"skew_stress", "Pa"},
                                                                        {"servo_error", "Pa"},
                                                                        {"unbalanced", "-"},
                                                                        {"localised", ""},
                                                                        {"mean_damage", "-"},
                                                                        {"broken_links", ""}})
        columns.push_back({name, unit});
      dem::EnergyAccount().each([&](const std::string &term, double) { columns.push_back({"energy_" + term, "J"}); });
      return columns;
    }
  } // namespace

  CellRun::CellRun(const RunRequest &asked, const CellModel &what)
    : request(asked)
    , model(what)
    , start(Clock::now())
    , last_saved(start)
  {
  }

  double CellRun::wall_seconds() const
  {
    return seconds_before + std::chrono::duration<double>(Clock::now() - start).count();
  }

  void CellRun::make_test()
  {
    specimen.emplace(packing, model.specimen, model.material.materials());
    if (packing.material_names.size() > 1)
      materials = MaterialCounts(packing.material_names, specimen->particles().material, specimen->links().law);
    test.emplace(*specimen, model.loading);
    constexpr double limit = 1e12; // a year at thirty thousand steps a second
    double           all   = 0;
    for (const dem::CellLeg &leg : model.loading.path)
      all += std::max(1.0, std::round(leg.duration / specimen->time_step()));
    if (!(all < limit))
      throw dem::InputError(
        fmt::format("Loading: the legs would take {:.1e} steps of {:.1e} s. Check durations, density, "
                    "moduli and sizes: all in SI units.",
                    all, specimen->time_step()));
    steps                        = static_cast<std::int64_t>(all);
    steps_per_sample             = std::max<std::int64_t>(1, steps / model.output.samples);
    const std::int64_t snapshots = model.output.snapshots;
    samples_per_snapshot         = snapshots > 0 ? std::max<std::int64_t>(1, model.output.samples / snapshots) : 0;
  }

  int CellRun::execute()
  {
    if (request.resume)
      resume();
    else
      begin();
    const dem::Counts counts = specimen->counts();
    fmt::print(stderr, "{}: {} particles, {} links; results {} in {}\n", request.scene_file, counts.particles,
               counts.links, request.resume ? "go on" : "grow", folder->running().string());
    if (!complete())
      return exit_interrupted;
    finish();
    return exit_success;
  }

  void CellRun::open(const std::filesystem::path &location)
  {
    if (samples_per_snapshot == 0)
      return;
    particles.emplace(location, "cell_particles");
    links.emplace(location, "cell_links");
  }

  void CellRun::begin()
  {
    // All refusals come before the folder is touched.
    packing = make_packing(model.source, model.material, model.specimen.physics.dimension);
    make_test();
    folder              = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::afresh);
    const auto location = folder->running();
    postprocess::write_text(location / "scene.prm", request.scene_text);
    postprocess::write_packing(packing, location / "packing.h5");
    series = std::make_unique<postprocess::SeriesWriter>(location / "series.csv", series_columns());
    open(location);
    if (particles)
      snapshot();
  }

  template <typename Checkpoint>
  void CellRun::visit_state(Checkpoint &checkpoint)
  {
    checkpoint.group("specimen");
    specimen->visit_state(checkpoint);
    checkpoint.group("test");
    test->visit_state(checkpoint);
    checkpoint.group("particle_snapshots");
    if (particles)
      particles->visit_state(checkpoint);
    checkpoint.group("link_snapshots");
    if (links)
      links->visit_state(checkpoint);
  }

  void CellRun::resume()
  {
    folder              = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::resume);
    const auto location = folder->running();

    postprocess::CheckpointReader checkpoint(location / checkpoint_name, request.deciding_text);
    std::int64_t                  rows = 0;
    checkpoint.group("run");
    checkpoint.scalar("series_rows", rows);
    checkpoint.scalar("wall_seconds", seconds_before);
    checkpoint.scalar("worst_balance_error", worst_balance_error);
    packing = postprocess::read_packing(location / "packing.h5");
    make_test();
    open(location);
    visit_state(checkpoint);
    checkpoint.finish();
    series = std::make_unique<postprocess::SeriesWriter>(location / "series.csv", series_columns(), rows);
  }

  void CellRun::save()
  {
    series->flush();
    postprocess::CheckpointWriter checkpoint(folder->running() / checkpoint_name, request.deciding_text);
    std::int64_t                  rows    = series->rows();
    double                        seconds = wall_seconds();
    checkpoint.group("run");
    checkpoint.scalar("series_rows", rows);
    checkpoint.scalar("wall_seconds", seconds);
    checkpoint.scalar("worst_balance_error", worst_balance_error);
    visit_state(checkpoint);
    checkpoint.commit();
    last_saved = Clock::now();
  }

  void CellRun::append_row()
  {
    const dem::CellSample &s   = test->curve().back();
    std::vector<double>    row = {s.time};
    row.insert(row.end(), s.strain.data(), s.strain.data() + 6);
    row.insert(row.end(), s.stress.data(), s.stress.data() + 6);
    row.insert(row.end(), {s.skew_stress, s.servo_error, s.unbalanced, s.localised ? 1.0 : 0.0, specimen->mean_damage(),
                           static_cast<double>(specimen->counts().broken)});
    const dem::EnergyAccount energy = specimen->energy();
    energy.each([&](const std::string &, const double value) { row.push_back(value); });
    worst_balance_error = std::max(worst_balance_error, energy.balance_error());
    series->append(row);
  }

  void CellRun::snapshot()
  {
    const dem::ParticleOutput state = specimen->particles();
    postprocess::write_vtk_particles(particles->next(), state, specimen->time());
    particles->add(specimen->time());
    const dem::LinkOutput joined = specimen->links();
    postprocess::write_vtk_links(links->next(), joined, state, specimen->time(),
                                 dem::link_images(*specimen, joined, state));
    links->add(specimen->time());
  }

  bool CellRun::complete()
  {
    Progress progress("cell");
    while (!test->finished())
      {
        const dem::CellSample sample = test->advance(steps_per_sample);
        append_row();
        if (particles && static_cast<std::int64_t>(test->curve().size()) % samples_per_snapshot == 0)
          snapshot();
        progress.update(std::min(1.0, static_cast<double>(specimen->steps()) / static_cast<double>(steps)),
                        fmt::format("strain xx {:.2e}, stress xx {:.3g} MPa{}", sample.strain[0],
                                    1e-6 * sample.stress[0], sample.localised ? ", localised" : ""));
        if (interrupted())
          {
            save();
            progress.clear();
            fmt::print(stderr, "breccia: interrupted, state saved. Go on with: breccia run {} --resume\n",
                       (folder->running() / "scene.prm").string());
            return false;
          }
        if (std::chrono::duration<double>(Clock::now() - last_saved).count() > model.output.checkpoint_interval)
          save();
      }
    return true;
  }

  std::string CellRun::draw_crack(const std::filesystem::path &file) const
  {
    const dem::ParticleOutput state  = specimen->particles();
    const dem::LinkOutput     joined = specimen->links();
    postprocess::PictureSlab  slab;
    slab.axis      = model.specimen.physics.dimension == 2 ? 2 : 1;
    slab.materials = packing.material_names;
    slab.images    = dem::link_images(*specimen, joined, state);
    return postprocess::picture_of_specimen(file, state, joined, "Periodic cell at the end of its path", slab);
  }

  void CellRun::finish()
  {
    series->flush();
    const CellReport report{request, model, *specimen, *test, materials, worst_balance_error, wall_seconds()};
    postprocess::write_json(folder->running() / "summary.json", report.summary());
    const auto warn = [](const char *what, const std::string &problem) {
      if (!problem.empty())
        fmt::print(stderr, "breccia: warning: no {}: {}\n", what, problem);
    };
    warn("curve.png", report.draw_curve(folder->running() / "curve.png"));
    warn("cell_crack.png", draw_crack(folder->running() / "cell_crack.png"));
    folder->publish();
    fmt::print("{}", report.text());
  }
} // namespace apps
