#include "apps/runs/sequential/particle_case.h"

#include "apps/forecasts/duration.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr std::int64_t samples_per_run = 200;

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
      void                 visit_state(base::StateVisitor &) override {}

    private:
      ParticleOutcome result;
    };

    /** What every computed case notes of its run: static start, wall clock and the worst energy balance. */
    class RunNotes
    {
    public:
      explicit RunNotes(const GravitySection &requested)
        : gravity(requested)
      {
      }

      StaticStart settle(dem::Specimen &specimen) { return equilibrium = start_statically(specimen, gravity); }

      /** Do some work on the specimen, and note what it took. */
      template <typename Work>
      void watch(dem::Specimen &specimen, const Work &work)
      {
        const base::Stopwatch clock;
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

      void visit_state(base::StateVisitor &visitor)
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

    /** A specimen in a test. */
    template <typename Test>
    class ComputedCase : public ParticleCase
    {
    public:
      const dem::Specimen *body() const override { return &specimen; }
      StaticStart          settle() override { return notes.settle(specimen); }

      void visit_state(base::StateVisitor &visitor) override
      {
        specimen.visit_state(visitor);
        test.visit_state(visitor);
        notes.visit_state(visitor);
      }

    protected:
      template <typename Parameters>
      ComputedCase(const ParticleEventSection     &event,
                   const dem::Packing             &packing,
                   const std::vector<std::string> &materials,
                   const Parameters               &of_test)
        : specimen(packing, event.specimen_parameters(), event.mixed().materials(materials))
        , test(specimen, of_test)
        , notes(event.gravity)
      {
      }

      dem::Specimen specimen;
      Test          test;
      RunNotes      notes;
    };

    class UniaxialCase : public ComputedCase<dem::UniaxialTest>
    {
    public:
      UniaxialCase(const ParticleEventSection          &event,
                   const dem::Packing                  &packing,
                   const ParticleEventSection::Instant &when)
        : ComputedCase(event, packing, packing.material_names, uniaxial_parameters(event, when.forward))
        , instant(when)
        , back_rate(-std::copysign(event.back_rate > 0 ? event.back_rate : 0.5 * event.strain_rate, when.forward))
        , steps_forward(steps_for(when.forward, event.strain_rate))
        , steps_back(when.back ? steps_for(when.forward - *when.back, back_rate) : 0)
      {
        // One step more on each leg: the last sample then shows the forces of the prescribed strain.
      }

      bool   finished() const override { return specimen.steps() >= steps_forward + steps_back + 1; }
      double done() const override
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

    private:
      std::int64_t steps_for(const double strain, const double rate) const
      {
        return std::max<std::int64_t>(1, std::llround(std::abs(strain / rate) / specimen.time_step()));
      }

      ParticleEventSection::Instant instant;
      double                        back_rate;
      std::int64_t                  steps_forward, steps_back;
    };

    class ImpactCase : public ComputedCase<dem::ImpactTest>
    {
    public:
      ImpactCase(const ParticleEventSection &event, const dem::Packing &packing, const double velocity)
        : ImpactCase(event, packing, with_velocity(event.impact, velocity))
      {
      }

      bool   finished() const override { return test.finished(); }
      double done() const override { return std::min(1.0, specimen.time() / parameters.longest); }

      void advance() override
      {
        const auto steps = static_cast<std::int64_t>(parameters.longest / specimen.time_step()) / samples_per_run;
        notes.watch(specimen, [&] { test.advance(std::max<std::int64_t>(1, steps)); });
      }

      ParticleOutcome outcome() const override
      {
        ParticleOutcome result;
        result.name     = fmt::format("{:.3g} m/s", parameters.impactor_velocity);
        result.severity = test.impactor_energy();
        result.absorbed = test.absorbed();
        notes.put_into(result);
        result.state = dem::discrete_state(specimen);
        return result;
      }

    private:
      ImpactCase(const ParticleEventSection &event, const dem::Packing &packing, const dem::ImpactParameters &impact)
        : ComputedCase(
            event, dem::with_impactor(packing, impact, event.physics.dimension), packing.material_names, impact)
        , parameters(impact)
      {
      }

      static dem::ImpactParameters with_velocity(dem::ImpactParameters p, const double velocity)
      {
        p.impactor_velocity = velocity;
        return p;
      }

      dem::ImpactParameters parameters;
    };
  } // namespace

  std::unique_ptr<ParticleCase>
  make_particle_case(const ParticleEventSection &event, const dem::Packing &packing, const std::size_t number)
  {
    using Source = ParticleEventSection::Source;
    if (event.source == Source::file)
      return std::make_unique<SavedCase>(event.files.at(number), number);
    if (event.source == Source::impact)
      return std::make_unique<ImpactCase>(event, packing, event.velocities.at(number));
    return std::make_unique<UniaxialCase>(event, packing, event.instants.at(number));
  }

  double expected_seconds(ParticleCase &particles, const double part)
  {
    constexpr double      enough = 0.25;
    const base::Stopwatch watch;
    while (!particles.finished() && watch.seconds() < enough)
      particles.advance();
    return particles.finished() ? watch.seconds() : watch.seconds() * part / particles.done();
  }

  std::unique_ptr<ParticleCase> make_reference_case(const ParticleEventSection &event, const dem::Packing &packing)
  {
    if (event.source != ParticleEventSection::Source::uniaxial || event.end_strain == 0)
      return nullptr;
    return std::make_unique<UniaxialCase>(event, packing, ParticleEventSection::Instant{event.end_strain, {}});
  }
} // namespace apps
