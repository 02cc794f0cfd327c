#include "apps/drivers/sequential/particle_stage.h"

#include "apps/drivers/parts/duration.h"
#include "apps/drivers/parts/specimen_packing.h"
#include "apps/scene/physics_section.h"
#include "apps/scene/value_text.h"
#include "postprocess/discrete_state_hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    constexpr std::int64_t samples_per_run = 200;

    /** "a" or "a > b"; nothing if it is neither. */
    std::optional<ParticleStageSection::Instant> instant_in(const std::string &text)
    {
      const auto arrow   = text.find('>');
      const auto forward = number_in(trimmed(text.substr(0, arrow)));
      if (!forward || *forward == 0)
        return {};
      if (arrow == std::string::npos)
        return ParticleStageSection::Instant{*forward, {}};
      const auto back = number_in(trimmed(text.substr(arrow + 1)));
      if (!back || std::abs(*back) > std::abs(*forward))
        return {};
      return ParticleStageSection::Instant{*forward, *back};
    }

    /** A saved state is there at once. */
    class SavedCase : public ParticleCase
    {
    public:
      SavedCase(const std::string &file, const std::size_t number)
      {
        result.name     = file;
        result.severity = static_cast<double>(number + 1);
        result.state    = postprocess::read_discrete_state(file);
      }
      const dem::Specimen *body() const override { return nullptr; }
      StaticStart          settle() override { return {}; }
      bool                 finished() const override { return true; }
      void                 advance() override {}
      double               done() const override { return 1; }
      ParticleOutcome      outcome() const override { return result; }
      void                 visit_state(dem::StateVisitor &) override {}

    private:
      ParticleOutcome result;
    };

    /** What every computed case notes of its run: static start, wall clock and the worst energy balance. */
    class RunNotes
    {
    public:
      explicit RunNotes(const GravitySection &asked)
        : gravity(asked)
      {
      }

      StaticStart settle(dem::Specimen &specimen) { return equilibrium = start_statically(specimen, gravity); }

      /** Do some work on the specimen, and note what it took. */
      template <typename Work>
      void watch(dem::Specimen &specimen, const Work &work)
      {
        const Stopwatch clock;
        if (specimen.steps() == 0 && !equilibrium)
          settle(specimen);
        work();
        worst_balance = std::max(worst_balance, specimen.energy().balance_error());
        seconds += clock.seconds();
      }

      void put_into(ParticleOutcome &result) const
      {
        result.seconds       = seconds;
        result.balance_error = worst_balance;
        result.start         = equilibrium;
      }

      void visit_state(dem::StateVisitor &visitor)
      {
        apps::visit_state(visitor, equilibrium);
        visitor.scalar("seconds", seconds);
        visitor.scalar("worst_balance", worst_balance);
      }

    private:
      GravitySection gravity;
      StaticStart    equilibrium;
      double         seconds = 0, worst_balance = 0;
    };

    class UniaxialCase : public ParticleCase
    {
    public:
      UniaxialCase(const ParticleStageSection          &stage,
                   const dem::Packing                  &packing,
                   const ParticleStageSection::Instant &when)
        : instant(when)
        , specimen(packing, stage.specimen_parameters(), stage.material.materials())
        , test(specimen, uniaxial_parameters(stage, when.forward))
        , back_rate(-std::copysign(stage.back_rate > 0 ? stage.back_rate : 0.5 * stage.strain_rate, when.forward))
        , steps_forward(steps_for(when.forward, stage.strain_rate))
        , steps_back(when.back ? steps_for(when.forward - *when.back, back_rate) : 0)
        , notes(stage.gravity)
      {
        // One step more on each leg: the last sample then shows the forces of the strain asked for.
      }

      const dem::Specimen *body() const override { return &specimen; }
      StaticStart          settle() override { return notes.settle(specimen); }
      bool                 finished() const override { return specimen.steps() >= steps_forward + steps_back + 1; }
      double               done() const override
      {
        return std::min(1.0,
                        static_cast<double>(specimen.steps()) / static_cast<double>(steps_forward + steps_back + 1));
      }

      void advance() override
      {
        const std::int64_t end = specimen.steps() < steps_forward ? steps_forward : steps_forward + steps_back + 1;
        const std::int64_t leg = std::max<std::int64_t>(1, (steps_forward + steps_back) / samples_per_run);
        if (steps_back > 0 && specimen.steps() == steps_forward)
          test.set_strain_rate(back_rate);
        notes.watch(specimen, [&] { test.advance(std::min(leg, end - specimen.steps())); });
      }

      ParticleOutcome outcome() const override
      {
        ParticleOutcome result;
        result.name     = instant.back ? fmt::format("{:.3g} > {:.3g}", instant.forward, *instant.back) :
                                         fmt::format("{:.3g}", instant.forward);
        result.severity = instant.forward;
        notes.put_into(result);
        for (const dem::UniaxialSample &sample : test.curve())
          {
            result.curve_strain.push_back(sample.strain);
            result.curve_stress.push_back(sample.stress);
          }
        result.stress = result.curve_stress.empty() ? 0 : result.curve_stress.back();
        result.state  = dem::discrete_state(specimen);
        return result;
      }

      void visit_state(dem::StateVisitor &visitor) override
      {
        specimen.visit_state(visitor);
        test.visit_state(visitor);
        notes.visit_state(visitor);
      }

    private:
      std::int64_t steps_for(const double strain, const double rate) const
      {
        return std::max<std::int64_t>(1, std::llround(std::abs(strain / rate) / specimen.time_step()));
      }

      ParticleStageSection::Instant instant;
      dem::Specimen                 specimen;
      dem::UniaxialTest             test;
      double                        back_rate;
      std::int64_t                  steps_forward, steps_back;
      RunNotes                      notes;
    };

    class ImpactCase : public ParticleCase
    {
    public:
      ImpactCase(const ParticleStageSection &stage, const dem::Packing &packing, const double velocity)
        : parameters(with_velocity(stage.impact, velocity))
        , specimen(dem::with_striker(packing, parameters, stage.physics.dimension),
                   stage.specimen_parameters(),
                   stage.material.materials())
        , test(specimen, parameters)
        , notes(stage.gravity)
      {
      }

      const dem::Specimen *body() const override { return &specimen; }
      StaticStart          settle() override { return notes.settle(specimen); }
      bool                 finished() const override { return test.finished(); }
      double               done() const override { return std::min(1.0, specimen.time() / parameters.longest); }

      void advance() override
      {
        const auto steps = static_cast<std::int64_t>(parameters.longest / specimen.time_step()) / samples_per_run;
        notes.watch(specimen, [&] { test.advance(std::max<std::int64_t>(1, steps)); });
      }

      ParticleOutcome outcome() const override
      {
        ParticleOutcome result;
        result.name     = fmt::format("{:.3g} m/s", parameters.striker_velocity);
        result.severity = test.striker_energy();
        result.absorbed = test.absorbed();
        notes.put_into(result);
        result.state = dem::discrete_state(specimen);
        return result;
      }

      void visit_state(dem::StateVisitor &visitor) override
      {
        specimen.visit_state(visitor);
        test.visit_state(visitor);
        notes.visit_state(visitor);
      }

    private:
      static dem::ImpactParameters with_velocity(dem::ImpactParameters p, const double velocity)
      {
        p.striker_velocity = velocity;
        return p;
      }

      dem::ImpactParameters parameters;
      dem::Specimen         specimen;
      dem::ImpactTest       test;
      RunNotes              notes;
    };
  } // namespace

  dem::UniaxialParameters uniaxial_parameters(const ParticleStageSection &stage, const double furthest)
  {
    dem::UniaxialParameters p;
    p.axis            = stage.axis;
    p.strain_rate     = std::copysign(stage.strain_rate, furthest);
    p.grips           = stage.grips.parameters();
    p.lateral_blocked = stage.lateral_blocked;
    p.spin_blocked    = stage.spin_blocked;
    p.stop_strain     = std::numeric_limits<double>::infinity(); // the case counts its steps itself
    return p;
  }

  void ParticleStageSection::declare(Section &root)
  {
    const auto computed = [this] { return source != Source::file; };
    const auto strained = [this] { return source == Source::uniaxial; };
    const auto gripped  = [this, strained] { return strained() || (strained_too && strained_too()); };
    const auto hit      = [this] { return source == Source::impact; };
    Section   &s = root.section("Particles", "The event that is simulated with particles, and when it is handed over");
    s.choice("Source", source, {{"file", Source::file}, {"uniaxial", Source::uniaxial}, {"impact", Source::impact}},
             Need::required)
      .means("file: discrete states saved before; uniaxial: a specimen between grips; impact: a beam hit by a sphere");
    s.text("Files", files, Need::required)
      .means("Saved discrete states (HDF5), separated by commas")
      .only_if([this] { return source == Source::file; }, "Particles/Source = file")
      .type = "list of files";
    specimen.declare(s, physics.dimension);
    material.declare(s);
    declare_physics(s, physics);
    time.declare(s);
    gravity.declare(s);
    for (const char *name : {"Specimen", "Physics", "Time", "Gravity"})
      s.find_section(name)->only_if(computed, "Particles/Source is not file");
    s.find_section("Material")
      ->only_if([this] { return source != Source::file && material.named.empty(); },
                "Particles/Source is not file, and there is no section Particles/Materials");

    Section &u = s.section("Uniaxial", "Between two gripped layers");
    u.only_if(gripped, "Particles/Source = uniaxial, or Transfer/Mapping law/Law = identify");
    u.choice("Axis", axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional).means("Direction of loading");
    u.number("Strain rate", strain_rate, "1/s", Range::positive(), Need::required)
      .means("Magnitude, on the way forward");
    u.number("Back rate", back_rate, "1/s", Range::at_least(0), Need::optional).means("On the way back; 0: half of it");
    grips.declare(u);
    u.flag("Grip lateral motion blocked", lateral_blocked).means("Grips hold their particles sideways too");
    u.flag("Grip rotation blocked", spin_blocked).means("Grips keep their particles from spinning");
    u.text("Instants", instants, Need::required)
      .means(
        "Strains at which the state is handed over, separated by commas, all of one sign; \"a > b\": strained to a and "
        "then led back to b")
      .only_if(strained, "Particles/Source = uniaxial");
    u.number("End strain", end_strain, "-", Range(), Need::optional)
      .means("To which an all-particle run goes on, to compare with; 0: none")
      .only_if(strained, "Particles/Source = uniaxial");

    Section &i = s.section(
      "Impact", "A beam along x on two supports, hit at mid-span from above by a sphere of its own (first) material");
    i.only_if(hit, "Particles/Source = impact");
    i.number("Span", impact.span, "m", Range::positive(), Need::required).means("Distance of the supports");
    i.number("Support width", impact.support_width, "m", Range::positive(), Need::required)
      .means("Bottom particles within half of it of a support cannot move up or down");
    i.number("Striker radius", impact.striker_radius, "m", Range::positive(), Need::required).means("Of the sphere");
    i.text("Striker velocities", velocities, Need::required)
      .means("One run each, numbers above 0 [m/s], separated by commas");
    i.number("Rest damping", impact.rest_damping, "-", Range::between(1e-3, 0.99), Need::optional)
      .means("Local damping once the striker has left");
    i.number("Rest ratio", impact.rest_ratio, "-", Range::between(1e-12, 1), Need::optional)
      .means("At rest when the kinetic energy is below this part of the striker's");
    i.number("Longest time", impact.longest, "s", Range::positive(), Need::required)
      .means("After which the run ends in any case");
  }

  void ParticleStageSection::validate(const Section &root) const
  {
    const Section &s = *root.find_section("Particles");
    if (source == Source::file)
      {
        if (files_asked().empty())
          s.refuse("Files", "expected file names, separated by commas.");
        return;
      }
    specimen.validate(s, physics.dimension);
    material.validate(s, physics.dimension);
    gravity.validate(s, physics.dimension);
    if (source == Source::impact)
      {
        if (velocities_asked().empty())
          s.find_section("Impact")->refuse("Striker velocities", "expected numbers above 0, separated by commas.");
        return;
      }
    const Section &u    = *s.find_section("Uniaxial");
    const auto     when = instants_asked();
    if (when.empty())
      u.refuse("Instants", "expected strains, or \"strain > strain after unloading\", separated by commas, e.g. "
                           "-1e-3, -2e-3 > -1e-3.");
    for (const Instant &i : when)
      if (std::signbit(i.forward) != std::signbit(when.front().forward))
        u.refuse("Instants", "the strains must have one sign: all tension or all compression.");
    if (end_strain != 0 && std::signbit(end_strain) != std::signbit(when.front().forward))
      u.refuse("End strain", "must have the sign of the instants.");
    grips.validate(u);
    if (physics.dimension == 2 && axis == 2)
      u.refuse("Axis", "in two dimensions the specimen lies in the plane z = 0. Load it along x or y.");
  }

  std::vector<ParticleStageSection::Instant> ParticleStageSection::instants_asked() const
  {
    std::vector<Instant> all;
    for (const std::string &part : comma_separated(instants))
      {
        const auto instant = instant_in(part);
        if (!instant)
          return {};
        all.push_back(*instant);
      }
    return all;
  }

  std::vector<double> ParticleStageSection::velocities_asked() const
  {
    std::vector<double> all;
    for (const std::string &part : comma_separated(velocities))
      {
        const auto number = number_in(part);
        if (!number || *number <= 0)
          return {};
        all.push_back(*number);
      }
    return all;
  }

  std::vector<std::string> ParticleStageSection::files_asked() const { return comma_separated(files); }

  dem::SpecimenParameters ParticleStageSection::specimen_parameters() const
  {
    dem::SpecimenParameters p;
    p.physics           = physics;
    p.density           = specimen.density;
    p.interaction_ratio = specimen.interaction_ratio;
    p.thickness         = specimen.thickness;
    p.step_factor       = time.step_factor;
    p.damping           = time.damping;
    p.gravity           = gravity.vector();
    p.loose             = source == Source::impact ? 1 : 0;
    return p;
  }

  std::size_t ParticleStageSection::cases() const
  {
    switch (source)
      {
      case Source::file:
        return files_asked().size();
      case Source::impact:
        return velocities_asked().size();
      default:
        return instants_asked().size();
      }
  }

  dem::Packing stage_packing(const ParticleStageSection &stage)
  {
    return stage.source == ParticleStageSection::Source::file ?
             dem::Packing() :
             make_packing(stage.specimen, stage.material, stage.physics.dimension);
  }

  std::unique_ptr<ParticleCase>
  make_particle_case(const ParticleStageSection &stage, const dem::Packing &packing, const std::size_t number)
  {
    using Source = ParticleStageSection::Source;
    if (stage.source == Source::file)
      return std::make_unique<SavedCase>(stage.files_asked().at(number), number);
    if (stage.source == Source::impact)
      return std::make_unique<ImpactCase>(stage, packing, stage.velocities_asked().at(number));
    return std::make_unique<UniaxialCase>(stage, packing, stage.instants_asked().at(number));
  }

  double expected_seconds(ParticleCase &particles, const double part)
  {
    constexpr double enough = 0.25;
    const Stopwatch  watch;
    while (!particles.finished() && watch.seconds() < enough)
      particles.advance();
    return particles.finished() ? watch.seconds() : watch.seconds() * part / particles.done();
  }

  std::unique_ptr<ParticleCase> make_reference_case(const ParticleStageSection &stage, const dem::Packing &packing)
  {
    if (stage.source != ParticleStageSection::Source::uniaxial || stage.end_strain == 0)
      return nullptr;
    return std::make_unique<UniaxialCase>(stage, packing, ParticleStageSection::Instant{stage.end_strain, {}});
  }
} // namespace apps
