#include "apps/runs/cell/run.h"

#include "apps/figures/energy_terms.h"
#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/warning.h"
#include "apps/runs/cell/report.h"
#include "apps/specimens/specimen_packing.h"
#include "base/voigt.h"
#include "dem/specimen/told_to_first.h"
#include "postprocess/pictures/specimen_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  CellRun::CellRun(const RunRequest &requested, const CellModel &what)
    : request(requested)
    , model(what)
  {
  }

  RunResult CellRun::execute() { return LifeCycle(request, model.output.checkpoint_interval, *this).execute(); }

  void CellRun::make_test()
  {
    const Progress progress("links");
    specimen = std::make_shared<dem::Specimen>(packing, model.specimen(),
                                               model.mixed().materials(packing.material_names), launched_team().get());
    share_among_ranks(*specimen);
    materials = MaterialCounts(packing.material_names, *specimen);
    test.emplace(*specimen, model.loading());
    constexpr double limit = 1e12; // a year at thirty thousand steps a second
    double           all   = 0;
    for (const dem::CellLeg &leg : model.loading().path)
      all += std::max(1.0, std::round(leg.duration / specimen->time_step()));
    if (!(all < limit))
      throw base::InputError(
        fmt::format("Loading: the legs would take {:.1e} steps of {:.1e} s. Check durations, density, "
                    "moduli and sizes: all in SI units.",
                    all, specimen->time_step()));
    steps    = static_cast<std::int64_t>(all);
    sampling = StepSampling(steps, model.output);
  }

  void CellRun::prepare()
  {
    packing = model.mixed().packing();
    make_test();
  }

  void CellRun::reopen(const std::filesystem::path &folder)
  {
    packing = kept_packing(folder);
    make_test();
  }

  void CellRun::begin(const Record &) { snapshots.take(*specimen); }

  void CellRun::keep_files(const std::filesystem::path &folder, const bool fresh)
  {
    if (fresh)
      keep_packing(packing, folder);
    if (model.output.snapshots > 0)
      snapshots.open(folder, "cell", model.output.pieces,
                     {false, false, LinkClasses(model.mixed().link_classes(packing.material_names))});
  }

  void CellRun::visit_state(RunState &state)
  {
    state.group("cell");
    state.scalar("worst_balance_error", worst_balance_error);
    state.group("specimen");
    specimen->visit_state(state);
    state.group("test");
    test->visit_state(state);
    snapshots.visit_state(state);
  }

  std::string CellRun::size() const
  {
    const dem::Counts counts = specimen->counts();
    return fmt::format("{} particles, {} links", counts.particles, counts.links);
  }

  double CellRun::done() const
  {
    return std::min(1.0, static_cast<double>(specimen->steps()) / static_cast<double>(steps));
  }

  std::string CellRun::details() const
  {
    if (test->curve().empty())
      return "";
    const dem::CellSample &sample = test->curve().back();
    return fmt::format("strain xx {:.2e}, stress xx {:.3g} MPa{}", sample.strain[0], 1e-6 * sample.stress[0],
                       sample.localised ? ", localised" : "");
  }

  std::vector<postprocess::SeriesColumn> CellRun::columns_of_series()
  {
    std::vector<postprocess::SeriesColumn> columns = {{"time", "s"}};
    for (const char *component : base::voigt_names)
      columns.push_back({std::string("strain_") + component, "-"});
    for (const char *component : base::voigt_names)
      columns.push_back({std::string("stress_") + component, "Pa"});
    for (const auto &[name, unit] : std::initializer_list<std::pair<const char *, const char *>>{{"skew_stress", "Pa"},
                                                                                                 {"servo_error", "Pa"},
                                                                                                 {"unbalanced", "-"},
                                                                                                 {"localised", ""},
                                                                                                 {"mean_damage", "-"},
                                                                                                 {"broken_links", ""}})
      columns.push_back({name, unit});
    append_energy_columns(columns);
    return columns;
  }

  SeriesRow CellRun::row()
  {
    const dem::CellSample &s   = test->curve().back();
    std::vector<double>    row = {s.time};
    row.insert(row.end(), s.strain.data(), s.strain.data() + 6);
    row.insert(row.end(), s.stress.data(), s.stress.data() + 6);
    row.insert(row.end(), {s.skew_stress, s.servo_error, s.unbalanced, s.localised ? 1.0 : 0.0, specimen->mean_damage(),
                           static_cast<double>(specimen->counts().broken)});
    const dem::EnergyAccount energy = specimen->energy();
    append_energies(row, energy);
    worst_balance_error = std::max(worst_balance_error, energy.balance_error());
    return {{}, row, {}};
  }

  void CellRun::advance(const Record &record)
  {
    test->advance(sampling.steps());
    record(row());
    if (finished() || sampling.snapshot_due(static_cast<std::int64_t>(test->curve().size())))
      snapshots.take(*specimen);
  }

  std::string CellRun::draw_crack(const std::filesystem::path &file,
                                  const dem::ParticleOutput   &particles,
                                  const dem::LinkOutput       &links) const
  {
    postprocess::PictureSlab slab;
    slab.axis      = model.physics.dimension == 2 ? 2 : 1;
    slab.materials = packing.material_names;
    if (model.mix.given())
      slab.classes = model.mixed().link_classes(packing.material_names);
    slab.images = dem::link_images(*specimen, links, particles);
    return postprocess::picture_of_specimen(file, particles, links, "Periodic cell at the end of its path", slab);
  }

  CellReport CellRun::report(const double wall_seconds) const
  {
    return {request, model, packing, *specimen, *test, materials, worst_balance_error, wall_seconds};
  }

  RunFindings CellRun::findings(const postprocess::CsvTable &, const double wall_seconds)
  {
    const CellReport found = report(wall_seconds);
    return {found.summary(), found.text(), specimen};
  }

  void CellRun::write_results(const std::filesystem::path &folder, const postprocess::CsvTable &)
  {
    const CellReport          found     = report(0);
    const dem::ParticleOutput particles = dem::particles_for_first(*specimen);
    const dem::LinkOutput     damaged   = dem::damaged_links_for_first(*specimen);
    on_first_rank([&] {
      warn_of_missing("curve.png", found.draw_curve(folder / "curve.png"));
      warn_of_missing("cell_crack.png", draw_crack(folder / "cell_crack.png", particles, damaged));
      warn_of_missing("grading.png", model.mixed().draw_grading(folder, packing.periodic_cell));
    });
  }

  RunResult run(const CellModel &model, const RunRequest &request)
  {
    start_mpi_for_ranks();
    return CellRun(request, model).execute();
  }
} // namespace apps
