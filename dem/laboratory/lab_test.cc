#include "dem/laboratory/lab_test.h"

#include "base/errors.h"
#include "dem/grips/section.h"
#include "dem/loading/curve_figures.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    using Test = LabParameters::Test;

    /** Steps between two checks whether a specimen rests: each costs about as much as a step. */
    constexpr std::int64_t look_every = 50;
    /** Relative deviation from the prescribed pressure that is allowed when a test begins. */
    constexpr double near_enough = 0.01;
    /** How many times a dip of the stress may last that a wave takes through the specimen: as long as its slowest swings. */
    constexpr double dips = 10;
    /** Of particles without bonds the peak is believed once they have been strained this much past it; earlier dips are waves. */
    constexpr double strain_past_peak = 1.1;
    /** Strain rate of the gauges over that of the loading to come, below which a specimen stands still: so much a ratio of strains may err. */
    constexpr double most_drift = 0.01;

    PressParameters press_of(const LabParameters &p)
    {
      PressParameters press = p.press;
      press.kind            = p.test == Test::tension ? PressParameters::Kind::glued :
                              p.test == Test::bending ? PressParameters::Kind::rollers :
                                                        PressParameters::Kind::platens;
      return press;
    }

    void refuse(const std::string &rule) { throw base::InputError("Laboratory/" + rule); }

    void check(const LabParameters &p, const int dimension)
    {
      if (p.press.axis < 0 || p.press.axis >= dimension)
        refuse("Axis: must be one of the specimen's directions.");
      if (!(p.speed > 0 && std::isfinite(p.speed)))
        refuse("Speed: must be above 0 m/s.");
      if (!(p.stop_strain > 0))
        refuse("Largest strain: must be above 0.");
      if (!(p.stop_fraction >= 0 && p.stop_fraction < 1))
        refuse("Stop at: must lie in [0, 1).");
      if (p.test == Test::confined && !(p.pressure > 0))
        refuse("Confining pressure: must be above 0 Pa.");
      if (p.test == Test::confined && p.confinement == LabParameters::Confinement::cylinder && dimension != 3)
        refuse("Confinement: in the plane there are walls or a membrane, no cylinder.");
      if (p.section && !(*p.section > 0))
        refuse("Test: the section must be above 0 m^2.");
      if (p.test == Test::tension && !(p.press.layer > 0))
        refuse("Glued layer: must be above 0 m.");
      if (p.test == Test::bending && !(p.press.span > 0 && p.press.roller > 0))
        refuse("Span: of a beam, and Roller radius, must be above 0 m.");
      const bool has_axis = p.test == Test::bending || (p.test == Test::splitting && dimension == 3);
      if (has_axis && (p.press.along == p.press.axis || p.press.along < 0 || p.press.along >= dimension))
        refuse("Body axis: must be one of the specimen's directions other than that of the load.");
    }

    /** Checked before anything is added to the specimen. */
    const LabParameters &checked(const LabParameters &p, const ObservedSpecimen &body)
    {
      check(p, body.parameters().physics.dimension);
      return p;
    }

    double thickness_of(const ObservedSpecimen &body, const BodyExtent &extent, const int axis)
    {
      return body.parameters().physics.dimension == 2 ? body.parameters().thickness : extent.length(axis);
    }
  } // namespace

  LabTest::LabTest(Specimen &body, const LabParameters &parameters)
    : specimen(&body)
    , what(checked(parameters, body))
    , press(body, press_of(parameters))
  {
    const ParticleKinematics particles = body.kinematics();
    const BodyExtent         extent(particles);
    choose_measures(particles, extent);
    bonded = body.counts().links > 0;
    if (what.seating_speed == 0)
      what.seating_speed = what.speed;
    if (what.largest_speed == 0)
      what.largest_speed = what.speed;
    now = what.seating_stress > 0 ? Stage::seating : Stage::loading;
    if (!is(Test::confined))
      return;
    now = Stage::confining;
    if (what.confinement == LabParameters::Confinement::walls)
      walls.emplace(body, extent, what.press.axis, what.press.contact);
    else if (what.confinement == LabParameters::Confinement::cylinder)
      jacket.emplace(body, particles, what.press.axis, what.press.contact);
    else
      {
        membrane.emplace(body, what.ball > 0 ? what.ball : 0.5 * mean_diameter(particles.radius));
        membrane->lay(press.planes());
      }
  }

  void LabTest::choose_measures(const ParticleKinematics &particles, const BodyExtent &body)
  {
    const int    axis = what.press.axis, dimension = specimen->parameters().physics.dimension;
    const double height = press.height(), diameter = mean_diameter(particles.radius);
    wave_steps          = static_cast<std::int64_t>(std::ceil(dips * 2 * height / diameter));
    strain_per_approach = 1 / height;
    if (is(Test::bending))
      {
        const int    along = what.press.along;
        const double span = what.press.span, deep = body.length(axis);
        const double wide = thickness_of(*specimen, body, 3 - axis - along);
        // A beam swings more slowly than a wave crosses it: the period of its first mode over that time is 2.2 (L/d)^2.
        wave_steps = static_cast<std::int64_t>(std::ceil(2.2 * span * span / (deep * deep) * 2 * deep / diameter));
        stress_per_force    = 1.5 * span / (wide * deep * deep);
        area                = wide * deep;
        strain_per_approach = 6 * deep / (span * span);
        const auto at       = [&](const double place) {
          MeanMotion group = particles_near(particles, along, place, 2 * diameter);
          return group;
        };
        middle_of_beam = at(body.middle(along));
        left_support   = at(body.middle(along) - 0.5 * span);
        right_support  = at(body.middle(along) + 0.5 * span);
        return;
      }
    if (is(Test::splitting))
      {
        // Between platens a disk may have flats; its diameter is that across the load.
        const int across = dimension == 2 ? 1 - axis : 3 - axis - what.press.along;
        area             = body.length(across) * thickness_of(*specimen, body, what.press.along);
        stress_per_force = 2 / (M_PI * area);
      }
    else
      {
        area = what.section.value_or(
          nominal_section({particles.position, particles.radius, dimension, specimen->parameters().thickness}, axis));
        stress_per_force = 1 / area;
        rows_gauge       = rows_along(particles, axis);
      }
    for (int a = 0; a < dimension; ++a)
      if (a != axis && !(is(Test::splitting) && dimension == 3 && a == what.press.along))
        side_gauges.push_back(sides_across(particles, axis, a));
  }

  double LabTest::ramped(const double speed) const
  {
    const auto steps = static_cast<double>(std::max<std::int64_t>(what.ramp_steps, 1));
    return speed * std::min(1.0, (static_cast<double>(stage_steps) + 0.5) / steps);
  }

  double LabTest::pressure_now() const { return now == Stage::confining ? ramped(what.pressure) : what.pressure; }

  void LabTest::drive()
  {
    if (now == Stage::loading)
      press.move(ramped(what.speed));
    else if (now == Stage::seating)
      press.move(ramped(what.seating_speed));
    else if (now == Stage::confining)
      press.hold(pressure_now() / stress_per_force, what.largest_speed, what.gain);
    else
      press.move(0);
    if (walls)
      walls->hold(pressure_now(), press.planes(), what.largest_speed, what.gain);
    if (jacket)
      jacket->hold(pressure_now(), press.planes(), what.largest_speed, what.gain);
    if (membrane)
      membrane->push(pressure_now(), press.planes());
  }

  double LabTest::strain_now() const { return (press.approach() - approached) * strain_per_approach; }

  double LabTest::gauge_strain() const
  {
    const int axis = what.press.axis;
    if (is(Test::bending))
      return strain_per_approach * (0.5 * (left_support.along(*specimen, axis) + right_support.along(*specimen, axis)) -
                                    middle_of_beam.along(*specimen, axis));
    if (!rows_gauge.given())
      return 0;
    return (is(Test::tension) ? 1 : -1) * rows_gauge.strain(*specimen);
  }

  double LabTest::lateral_strain() const
  {
    double sum = 0;
    for (const ParticleGauge &gauge : side_gauges)
      sum += gauge.given() ? gauge.strain(*specimen) : 0.0;
    return side_gauges.empty() ? 0.0 : sum / static_cast<double>(side_gauges.size());
  }

  double LabTest::confinement_now() const
  {
    return walls    ? walls->pressure(press.planes()) :
           jacket   ? jacket->pressure(press.planes()) :
           membrane ? pressure_now() :
                      0.0;
  }

  bool LabTest::sides_near_pressure() const
  {
    if (jacket)
      return std::abs(jacket->pressure(press.planes()) / what.pressure - 1) < near_enough;
    return !walls || walls->error(what.pressure, press.planes()) < near_enough;
  }

  void LabTest::read_rest()
  {
    last.gauge_strain   = gauge_strain() - gauge_zero;
    last.lateral_strain = lateral_strain() - lateral_zero;
    last.confinement    = confinement_now();
    last.kinetic        = specimen->kinetic_energy();
    last.work           = specimen->external_work() - worked;
    last.force_ratio    = specimen->force_ratio();
    last.breaks         = static_cast<double>(specimen->logged_breaks());
  }

  void LabTest::observe()
  {
    if (finished())
      return;
    ++stage_steps;
    last.low    = press.force(Press::low);
    last.high   = press.force(Press::high);
    last.stress = 0.5 * (last.low + last.high) * stress_per_force;
    last.strain = next_strain;
    next_strain = strain_now();
    if (now == Stage::loading)
      follow_load();
    if (rows.step(last.stress, last.low, last.high))
      {
        read_rest();
        rows.row(last);
      }
    if (membrane && specimen->steps() % what.membrane_steps == 0)
      membrane->lay(press.planes());
    next_stage();
  }

  void LabTest::follow_load()
  {
    if (load() > peak)
      {
        peak           = load();
        strain_at_peak = last.strain;
      }
    // Without a break a bonded specimen swings, or turns until both sides bear it; a confined one swings about its pressure.
    const bool   swings   = is(Test::confined) && peak < near_enough * what.pressure;
    const bool   falls    = bonded ? breaks() > breaks_before : last.strain > strain_past_peak * strain_at_peak;
    const bool   believed = falls && !swings;
    const double part     = peak > 0 ? load() / peak : 1;
    low_steps             = believed && part < what.stop_fraction ? low_steps + 1 : 0;
    fallen_steps          = believed && part < std::max(fallen_part, what.stop_fraction) ? fallen_steps + 1 : 0;
  }

  bool LabTest::stands_still()
  {
    const double gauge = gauge_strain(), lateral = lateral_strain();
    const double moved = std::max(std::abs(gauge - gauge_before), std::abs(lateral - lateral_before));
    const double loads = what.speed * strain_per_approach * static_cast<double>(look_every) * specimen->time_step();
    still_steps        = moved <= most_drift * loads ? still_steps + look_every : 0;
    gauge_before       = gauge;
    lateral_before     = lateral;
    return still_steps >= wave_steps;
  }

  bool LabTest::rests()
  {
    if (stage_steps % look_every != 0)
      return false;
    if (!stands_still() || specimen->force_ratio() > what.rest)
      return false;
    if (now != Stage::confining)
      return true;
    return stage_steps >= what.ramp_steps && std::abs(last.stress / what.pressure - 1) < near_enough &&
           sides_near_pressure();
  }

  void LabTest::next_stage()
  {
    if (now == Stage::confining && (rests() || waited_enough()))
      {
        unconfined = waited_enough();
        begin_loading();
      }
    else if (now == Stage::seating && last.stress >= what.seating_stress)
      {
        seated = last.strain;
        enter(Stage::settling);
      }
    else if (now == Stage::seating && last.strain >= what.stop_strain)
      {
        unseated = 1;
        enter(Stage::done);
      }
    else if (now == Stage::settling && (rests() || waited_enough()))
      {
        unsettled = waited_enough();
        enter(Stage::loading);
      }
    else if (now == Stage::loading && test_ends())
      enter(Stage::done);
  }

  bool LabTest::test_ends() const
  {
    // A wave that runs through a specimen may dip below the stop fraction; a crack stays below.
    return last.strain >= what.stop_strain || low_steps > wave_steps;
  }

  double LabTest::longest_loading() const
  {
    // Over the ramp the mean speed is half of it.
    return what.stop_strain / (strain_per_approach * what.speed) +
           0.5 * static_cast<double>(what.ramp_steps) * specimen->time_step();
  }

  double LabTest::done() const
  {
    return finished() ? 1.0 : now == Stage::loading ? std::clamp(last.strain / what.stop_strain, 0.0, 1.0) : 0.0;
  }

  bool LabTest::past_peak() const
  {
    return peak > 0 && (fallen_steps > wave_steps || last.strain >= past_peak_strain * strain_at_peak);
  }

  void LabTest::enter(const Stage stage)
  {
    now         = stage;
    stage_steps = still_steps = 0;
    if (stage == Stage::loading)
      breaks_before = breaks();
  }

  void LabTest::begin_loading()
  {
    enter(Stage::loading);
    approached   = press.approach();
    worked       = specimen->external_work();
    gauge_zero   = gauge_strain();
    lateral_zero = lateral_strain();
    next_strain  = 0;
    rows.clear();
  }

  double LabTest::work() const { return specimen->external_work() - worked; }

  double LabTest::friction() const { return specimen->energy().friction; }

  double LabTest::stress_left() const { return peak > 0 ? load() / peak : 0; }

  TestCurve LabTest::curve() const
  {
    return {rows, is(Test::confined) ? what.pressure : 0.0, past_peak(), peak, strain_at_peak, !is(Test::tension)};
  }

  TestFigures LabTest::figures() const
  {
    TestFigures   found  = figures_of(curve());
    const Finding uneven = Finding::none("stress is not uniform in this test");
    if (is(Test::splitting))
      found.modulus = found.gauge_modulus = found.secant_modulus = uneven;
    if (is(Test::splitting) || is(Test::bending))
      found.poisson_secant = found.poisson_slope = uneven;
    return found;
  }

  std::vector<std::string> LabTest::notes() const
  {
    std::vector<std::string> found;
    if (unconfined != 0)
      found.push_back("the loading began before the specimen had come to rest under the confining pressure");
    if (unsettled != 0)
      found.push_back("the loading began before the seated specimen had come to rest");
    if (unseated != 0)
      found.push_back("the seating stress was not reached at the largest strain");
    return found;
  }

  void LabTest::visit_state(base::StateVisitor &visitor)
  {
    auto stage = static_cast<std::int64_t>(now);
    visitor.scalar("laboratory/stage", stage);
    now = static_cast<Stage>(stage);
    for (const auto &[name, value] :
         std::initializer_list<std::pair<const char *, std::int64_t *>>{{"stage_steps", &stage_steps},
                                                                        {"breaks_before", &breaks_before},
                                                                        {"low_steps", &low_steps},
                                                                        {"fallen_steps", &fallen_steps},
                                                                        {"still_steps", &still_steps},
                                                                        {"unconfined", &unconfined},
                                                                        {"unsettled", &unsettled},
                                                                        {"unseated", &unseated}})
      visitor.scalar(std::string("laboratory/") + name, *value);
    for (const auto &[name, value] :
         std::initializer_list<std::pair<const char *, double *>>{{"approached", &approached},
                                                                  {"worked", &worked},
                                                                  {"next_strain", &next_strain},
                                                                  {"seated", &seated},
                                                                  {"peak", &peak},
                                                                  {"strain_at_peak", &strain_at_peak},
                                                                  {"gauge_zero", &gauge_zero},
                                                                  {"lateral_zero", &lateral_zero},
                                                                  {"gauge_before", &gauge_before},
                                                                  {"lateral_before", &lateral_before},
                                                                  {"last_strain", &last.strain},
                                                                  {"last_stress", &last.stress},
                                                                  {"last_low", &last.low},
                                                                  {"last_high", &last.high},
                                                                  {"last_gauge_strain", &last.gauge_strain},
                                                                  {"last_lateral_strain", &last.lateral_strain},
                                                                  {"last_confinement", &last.confinement},
                                                                  {"last_kinetic", &last.kinetic},
                                                                  {"last_work", &last.work},
                                                                  {"last_force_ratio", &last.force_ratio},
                                                                  {"last_breaks", &last.breaks}})
      visitor.scalar(std::string("laboratory/") + name, *value);
    press.visit_state(visitor);
    rows.visit_state(visitor);
    if (membrane)
      membrane->visit_state(visitor);
  }
} // namespace dem
