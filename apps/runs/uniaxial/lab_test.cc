#include "apps/runs/uniaxial/lab_test.h"

#include "apps/figures/emission_figures.h"
#include "apps/figures/energy_terms.h"
#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "apps/results/warning.h"
#include "apps/specimens/written_state.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "dem/specimen/told_to_first.h"
#include "postprocess/pictures/specimen_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  std::int64_t most_steps(const UniaxialLoadingSection &loading, const UniaxialLoad load, const double time_step)
  {
    constexpr double              limit = 1e12; // a year at thirty thousand steps a second
    const dem::UniaxialParameters test  = loading.parameters(load);
    const double                  steps = std::ceil(test.stop_strain / std::abs(test.strain_rate) / time_step);
    if (!(steps < limit))
      throw base::InputError(fmt::format(
        "Loading, {}: strain {} at {} 1/s would take {:.1e} steps of {:.1e} s. Check density, moduli, sizes and "
        "rates: all in SI units.",
        name_of(load), test.stop_strain, std::abs(test.strain_rate), steps, time_step));
    constexpr double fewest = 20; // below, the body has not begun to answer when the test is over
    if (steps < fewest)
      throw base::InputError(
        fmt::format("Loading, {}: strain {} at {} 1/s would take {:.0f} steps of {:.1e} s, too few to "
                    "follow. Lower the rate, or check density, moduli and sizes: all in SI units.",
                    name_of(load), test.stop_strain, std::abs(test.strain_rate), steps, time_step));
    return static_cast<std::int64_t>(steps);
  }

  namespace
  {
    /** By the damage of bonds so far, half way between where their ends were at the start. */
    SpreadAmount dissipated_by_links(const dem::ObservedSpecimen &specimen)
    {
      const dem::ParticleKinematics particles = specimen.kinematics();
      const dem::LinkOutput         links     = specimen.links();
      SpreadAmount                  sum;
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          Eigen::Vector3d place = Eigen::Vector3d::Zero();
          for (const std::size_t end : links.ends[l])
            place += 0.5 * (particles.position[end] - particles.displacement[end]);
          sum.add(links.dissipated[l], place);
        }
      return sum;
    }
  } // namespace

  UniaxialLabTest::UniaxialLabTest(const UniaxialModel &model, const dem::Packing &packing, const std::size_t which)
    : UniaxialLabTest(model, model.jointed(packing), which)
  {
  }

  UniaxialLabTest::UniaxialLabTest(const UniaxialModel &model, const JointedPacking &jointed, const std::size_t which)
    : name(name_of(model.loading.tests[which]))
    , classes(jointed.link_classes(model.mixed().link_classes(jointed.packing().material_names)))
    , axis(model.loading.axis)
    , specimen(jointed.packing(),
               model.specimen(),
               jointed.materials(model.mixed().materials(jointed.packing().material_names)),
               launched_team().get())
    , test(specimen, model.loading.parameters(model.loading.tests[which]))
    , gravity(model.gravity)
    , steps_at_most(most_steps(model.loading, model.loading.tests[which], specimen.time_step()))
    , sampling(steps_at_most, model.output)
    , shown(model.output.snapshots > 0)
    , pieces(model.output.pieces)
    , zone_wanted(model.fracture_zone)
  {
    result.load               = model.loading.tests[which];
    result.notes.name         = name;
    result.notes.section      = test.section();
    result.notes.gauge_length = test.gauge_length();
    result.time_step          = specimen.time_step();
    result.at_start           = specimen.counts();
    share_among_ranks(specimen);
    if (model.mix.given())
      crack_classes = classes.of_pairs();
    materials         = MaterialCounts(jointed.packing().material_names, specimen);
    const double sign = result.load == UniaxialLoad::tension ? 1 : -1;
    test.watch([this, sign](const dem::UniaxialSample &now) { sideways.note(specimen, axis, sign * now.stress); });
  }

  void UniaxialLabTest::settle() { result.start = start_statically(specimen, gravity); }

  void UniaxialLabTest::open(const std::filesystem::path &folder)
  {
    if (shown)
      snapshots.open(folder, name, pieces, {false, false, classes});
  }

  void UniaxialLabTest::advance()
  {
    if (specimen.steps() == 0)
      snapshots.take(specimen);
    const base::Stopwatch watch;
    const std::int64_t    before = specimen.steps();
    test.advance(sampling.steps());
    result.stepping_seconds += watch.seconds();

    result.at_end                = specimen.counts();
    result.steps                 = specimen.steps();
    result.energy                = specimen.energy();
    result.notes.figures         = test.figures();
    result.notes.deepest_overlap = result.at_end.deepest_overlap;
    result.link_updates +=
      static_cast<double>(result.steps - before) * static_cast<double>(result.at_end.links + result.at_end.contacts);
    result.worst_balance_error = std::max(result.worst_balance_error, result.energy.balance_error());
    result.notes.poisson_ratio = sideways.poisson_ratio(result.notes.figures.strength);
    if (zone_wanted)
      zone.note(std::abs(test.curve().back().stress), dissipated_by_links(specimen));
    if (snapshot_due())
      snapshots.take(specimen);
  }

  bool UniaxialLabTest::snapshot_due() const
  {
    return sampling.snapshot_due(static_cast<std::int64_t>(test.curve().size()));
  }

  std::vector<postprocess::SeriesColumn> UniaxialLabTest::series_columns(const UniaxialModel &)
  {
    std::vector<postprocess::SeriesColumn> columns = {{"test", "", true},   {"time", "s"},        {"strain", "-"},
                                                      {"stress", "Pa"},     {"mean_damage", "-"}, {"links", ""},
                                                      {"broken_links", ""}, {"contacts", ""}};
    append_energy_columns(columns);
    return columns;
  }

  SeriesRow UniaxialLabTest::row() const
  {
    const dem::UniaxialSample &sample = test.curve().back();
    std::vector<double>        row    = {sample.time,
                                         sample.strain,
                                         sample.stress,
                                         specimen.mean_damage(),
                                         static_cast<double>(result.at_end.links),
                                         static_cast<double>(result.at_end.broken),
                                         static_cast<double>(result.at_end.contacts)};
    append_energies(row, result.energy);
    return {{name}, row, {}};
  }

  void UniaxialLabTest::visit_state(RunState &state)
  {
    state.group("specimen");
    specimen.visit_state(state);
    state.group("test");
    test.visit_state(state);
    snapshots.visit_state(state);
    sideways.visit_state(state);
    if (zone_wanted)
      zone.visit_state(state);
  }

  void UniaxialLabTest::complete()
  {
    if (!snapshot_due())
      snapshots.take(specimen);
    for (const dem::UniaxialSample &sample : test.curve())
      {
        result.strain.push_back(sample.strain);
        result.stress.push_back(sample.stress);
      }
    result.emission            = EmissionFigures(specimen).row();
    result.fracture_zone_width = zone.width(specimen.parameters().physics.dimension).value_or(0.0);
    note_work_of_fracture(result.notes, test.figures());
    result.link_classes = classes.figures(specimen);
    result.notes.crack  = dem::measure_crack(specimen);
  }

  void UniaxialLabTest::write(const std::filesystem::path &folder) const
  {
    if (!on_any_rank(!folder.empty()))
      return;
    {
      const dem::ParticleOutput particles = dem::particles_for_first(specimen);
      const dem::LinkOutput     damaged   = dem::damaged_links_for_first(specimen);
      on_first_rank([&] {
        warn_of_missing("crack picture", draw_crack(folder, particles, damaged));
        write_emission(specimen, folder, name + "_", seen_along());
      });
    }
    write_state(specimen, folder / (name + "_state.h5"));
  }

  std::shared_ptr<const dem::ObservedSpecimen> UniaxialLabTest::specimen_at_end()
  {
    return std::make_shared<const dem::Specimen>(std::move(specimen));
  }

  std::string UniaxialLabTest::draw_crack(const std::filesystem::path &folder,
                                          const dem::ParticleOutput   &particles,
                                          const dem::LinkOutput       &links) const
  {
    postprocess::PictureSlab slab;
    slab.axis      = seen_along();
    slab.materials = materials.names;
    slab.classes   = crack_classes;
    return postprocess::picture_of_specimen(folder / (name + "_crack.png"), particles, links, "After " + name, slab);
  }

  std::string UniaxialLabTest::size() const
  {
    return fmt::format("{} particles, {} links", result.at_start.particles, result.at_start.links);
  }

  double UniaxialLabTest::done() const
  {
    return std::min(1.0, static_cast<double>(specimen.steps()) / static_cast<double>(steps_at_most));
  }

  std::string UniaxialLabTest::details() const
  {
    const double seconds = std::max(result.stepping_seconds, 1e-9);
    const double strain  = test.curve().empty() ? 0 : test.curve().back().strain,
                 stress  = test.curve().empty() ? 0 : test.curve().back().stress;
    return fmt::format("strain {:.2e}, stress {:.3g} MPa, {:.0f} steps/s, {:.1f} million link updates/s", strain,
                       1e-6 * stress, static_cast<double>(result.steps) / seconds,
                       1e-6 * result.link_updates / seconds);
  }
} // namespace apps
