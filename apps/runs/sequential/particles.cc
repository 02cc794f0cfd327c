#include "apps/runs/sequential/particles.h"

#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"
#include "postprocess/hdf5/checkpoint.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    constexpr double checkpoint_interval = 600; ///< the longest [s]

    /** The numbers of an outcome beside its state, in the order in which a checkpoint stores them. */
    void visit_figures(base::StateVisitor &visitor, ParticleOutcome &outcome)
    {
      visitor.scalar("severity", outcome.severity);
      visitor.scalar("absorbed", outcome.absorbed);
      visitor.scalar("stress", outcome.stress);
      visitor.scalar("seconds", outcome.seconds);
      visitor.scalar("balance_error", outcome.balance_error);
      apps::visit_state(visitor, outcome.start);
      base::Column strain(outcome.curve_strain.begin(), outcome.curve_strain.end()),
        stress(outcome.curve_stress.begin(), outcome.curve_stress.end());
      visitor.column("curve_strain", strain);
      visitor.column("curve_stress", stress);
      outcome.curve_strain.assign(strain.begin(), strain.end());
      outcome.curve_stress.assign(stress.begin(), stress.end());
    }

    void write_curve(const ParticleOutcome &outcome, const std::filesystem::path &file)
    {
      if (outcome.curve_strain.empty())
        return;
      std::string text = "strain,stress [Pa]\n";
      for (std::size_t i = 0; i < outcome.curve_strain.size(); ++i)
        text += fmt::format("{},{}\n", outcome.curve_strain[i], outcome.curve_stress[i]);
      postprocess::write_text(file, text);
    }
  } // namespace

  bool run_particles(ParticleCase                &particles,
                     const std::string           &name,
                     const std::filesystem::path &folder,
                     const std::string           &deciding_text)
  {
    const auto        under_way = folder / "under_way.h5";
    const std::string belongs   = deciding_text + "\n# " + name;
    if (std::filesystem::exists(under_way))
      {
        postprocess::CheckpointReader reader(under_way, belongs);
        reader.group("particles");
        particles.visit_state(reader);
        reader.finish();
      }
    const auto write = [&] {
      postprocess::CheckpointWriter writer(under_way, belongs);
      writer.group("particles");
      particles.visit_state(writer);
      writer.commit();
    };
    CheckpointClock clock(checkpoint_interval);
    Progress        progress(name);
    while (!particles.finished())
      {
        particles.advance();
        progress.update(particles.done(), "");
        if (interrupted())
          {
            const AnsweringInterrupt answering;
            write();
            return false;
          }
        if (clock.is_due())
          clock.save(write);
      }
    std::filesystem::remove(under_way);
    return true;
  }

  ParticleCases::ParticleCases(const ParticleEventSection &what, std::filesystem::path where, std::string text)
    : event(what)
    , folder(std::move(where) / "states")
    , deciding_text(std::move(text))
  {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw postprocess::OutputError(folder.string() + ": the folder cannot be made: " + error.message() + ".");
  }

  bool ParticleCases::complete(const dem::Packing &packing)
  {
    bool goes_on = true;
    for (std::size_t number = 0; number < event.cases() && goes_on; ++number)
      load_or_run(number, packing, goes_on);
    if (!goes_on)
      return false;
    if (const auto reference = make_reference_case(event, packing))
      {
        if (!run_particles(*reference, "all particles", folder, deciding_text))
          return false;
        all_particles = reference->outcome();
        write_curve(*all_particles, folder / "all_particles.csv");
      }
    return true;
  }

  void ParticleCases::load_or_run(const std::size_t number, const dem::Packing &packing, bool &goes_on)
  {
    const std::string name  = fmt::format("state_{:03}", number);
    const auto        state = folder / (name + ".h5"), figures = folder / (name + "_figures.h5");
    const auto        particles = make_particle_case(event, packing, number);
    if (std::filesystem::exists(figures)) // written last: the state is there too
      {
        ParticleOutcome               outcome = particles->outcome(); // its name
        postprocess::CheckpointReader reader(figures, deciding_text);
        reader.group("figures");
        visit_figures(reader, outcome);
        reader.finish();
        outcome.state = postprocess::read_discrete_state(state);
        finished.push_back(std::move(outcome));
        return;
      }
    goes_on =
      run_particles(*particles, fmt::format("particles {} of {}", number + 1, event.cases()), folder, deciding_text);
    if (!goes_on)
      return;
    ParticleOutcome outcome = particles->outcome();
    postprocess::write_discrete_state(outcome.state, state);
    write_curve(outcome, folder / (name + ".csv"));
    postprocess::CheckpointWriter writer(figures, deciding_text);
    writer.group("figures");
    visit_figures(writer, outcome);
    writer.commit();
    finished.push_back(std::move(outcome));
  }
} // namespace apps
