#include "apps/drivers/uniaxial/stage.h"

#include "apps/process/progress.h"
#include "dem/core/errors.h"
#include "dem/observation/discrete_state.h"
#include "postprocess/discrete_state_hdf5.h"
#include "postprocess/specimen_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace apps
{
  namespace
  {
    /** 0 for none, otherwise at least 1. */
    std::int64_t rounded_up(const std::int64_t parts, const std::int64_t into)
    {
      return into > 0 ? (parts + into - 1) / into : 0;
    }
  } // namespace

  std::int64_t most_steps(const UniaxialLoadingSection &loading, const UniaxialLoad load, const double time_step)
  {
    constexpr double              limit = 1e12; // a year at thirty thousand steps a second
    const dem::UniaxialParameters test  = loading.parameters(load);
    const double                  steps = std::ceil(test.stop_strain / std::abs(test.strain_rate) / time_step);
    if (!(steps < limit))
      throw dem::InputError(fmt::format(
        "Loading, {}: strain {} at {} 1/s would take {:.1e} steps of {:.1e} s. Check density, moduli, sizes and "
        "rates: all in SI units.",
        name_of(load), test.stop_strain, std::abs(test.strain_rate), steps, time_step));
    constexpr double fewest = 20; // below, the body has not begun to answer when the test is over
    if (steps < fewest)
      throw dem::InputError(
        fmt::format("Loading, {}: strain {} at {} 1/s would take {:.0f} steps of {:.1e} s, too few to "
                    "follow. Lower the rate, or check density, moduli and sizes: all in SI units.",
                    name_of(load), test.stop_strain, std::abs(test.strain_rate), steps, time_step));
    return static_cast<std::int64_t>(steps);
  }

  UniaxialStage::UniaxialStage(const UniaxialModel &model, const dem::Packing &packing, const std::size_t which)
    : name(name_of(model.loading.tests[which]))
    , axis(model.loading.axis)
    , specimen(packing, model.specimen, model.material.materials())
    , test(specimen, model.loading.parameters(model.loading.tests[which]))
    , gravity(model.gravity)
    , steps_at_most(most_steps(model.loading, model.loading.tests[which], specimen.time_step()))
    , steps_per_sample(std::max<std::int64_t>(1, steps_at_most / model.output.samples))
    , samples_per_snapshot(rounded_up(model.output.samples, model.output.snapshots))
  {
    result.load               = model.loading.tests[which];
    result.notes.name         = name;
    result.notes.section      = test.section();
    result.notes.gauge_length = test.gauge_length();
    result.time_step          = specimen.time_step();
    result.at_start           = specimen.counts();
    if (packing.material_names.size() > 1)
      materials = MaterialCounts(packing.material_names, specimen.particles().material, specimen.links().law);
  }

  void UniaxialStage::settle()
  {
    const Progress progress("initial equilibrium");
    result.start = start_statically(specimen, gravity);
  }

  void UniaxialStage::open(const std::filesystem::path &folder)
  {
    if (samples_per_snapshot > 0)
      snapshots.open(folder, name);
  }

  bool UniaxialStage::advance()
  {
    if (specimen.steps() == 0)
      snapshots.take(specimen);
    const auto         start  = std::chrono::steady_clock::now();
    const std::int64_t before = specimen.steps();
    test.advance(steps_per_sample);
    result.stepping_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    result.at_end        = specimen.counts();
    result.steps         = specimen.steps();
    result.energy        = specimen.energy();
    result.notes.figures = test.figures();
    result.link_updates +=
      static_cast<double>(result.steps - before) * static_cast<double>(result.at_end.links + result.at_end.contacts);
    result.worst_balance_error = std::max(result.worst_balance_error, result.energy.balance_error());
    if (snapshots.wanted() && static_cast<std::int64_t>(test.curve().size()) % samples_per_snapshot == 0)
      snapshots.take(specimen);
    return true;
  }

  std::vector<postprocess::SeriesColumn> UniaxialStage::series_columns()
  {
    std::vector<postprocess::SeriesColumn> columns = {{"test", ""},         {"time", "s"},        {"strain", "-"},
                                                      {"stress", "Pa"},     {"mean_damage", "-"}, {"links", ""},
                                                      {"broken_links", ""}, {"contacts", ""}};
    dem::EnergyAccount().each([&](const std::string &term, double) { columns.push_back({"energy_" + term, "J"}); });
    return columns;
  }

  SeriesRow UniaxialStage::row() const
  {
    const dem::UniaxialSample &sample = test.curve().back();
    std::vector<double>        row    = {sample.time,
                                         sample.strain,
                                         sample.stress,
                                         specimen.mean_damage(),
                                         static_cast<double>(result.at_end.links),
                                         static_cast<double>(result.at_end.broken),
                                         static_cast<double>(result.at_end.contacts)};
    result.energy.each([&](const std::string &, const double value) { row.push_back(value); });
    return {{name}, row, {}};
  }

  void UniaxialStage::visit_state(RunState &state)
  {
    state.group("specimen");
    specimen.visit_state(state);
    state.group("test");
    test.visit_state(state);
    snapshots.visit_state(state);
  }

  void UniaxialStage::finish()
  {
    if (snapshots.wanted() && static_cast<std::int64_t>(test.curve().size()) % samples_per_snapshot != 0)
      snapshots.take(specimen);
    for (const dem::UniaxialSample &sample : test.curve())
      {
        result.strain.push_back(sample.strain);
        result.stress.push_back(sample.stress);
      }
    const dem::SpecimenParameters &made = specimen.parameters();
    result.notes.crack                  = dem::measure_crack(specimen.particles(), specimen.links(),
                                                             {made.physics.dimension, made.density, made.thickness});
  }

  void UniaxialStage::save_discrete_state(const std::filesystem::path &folder) const
  {
    postprocess::write_discrete_state(dem::discrete_state(specimen), folder / (name + "_state.h5"));
  }

  std::string UniaxialStage::draw_crack(const std::filesystem::path &folder) const
  {
    postprocess::PictureSlab slab;
    slab.axis      = axis == 2 ? 1 : 2; // seen across the load
    slab.materials = materials.names;
    return postprocess::picture_of_specimen(folder / (name + "_crack.png"), specimen.particles(), specimen.links(),
                                            "After " + name, slab);
  }

  double UniaxialStage::done() const
  {
    return std::min(1.0, static_cast<double>(specimen.steps()) / static_cast<double>(steps_at_most));
  }

  std::string UniaxialStage::details() const
  {
    const double seconds = std::max(result.stepping_seconds, 1e-9);
    const double strain  = test.curve().empty() ? 0 : test.curve().back().strain,
                 stress  = test.curve().empty() ? 0 : test.curve().back().stress;
    return fmt::format("strain {:.2e}, stress {:.3g} MPa, {:.0f} steps/s, {:.1f} million link updates/s", strain,
                       1e-6 * stress, static_cast<double>(result.steps) / seconds,
                       1e-6 * result.link_updates / seconds);
  }
} // namespace apps
