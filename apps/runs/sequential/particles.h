#pragma once

#include "apps/results/run_request.h"
#include "apps/runs/sequential/particle_case.h"

#include <filesystem>

namespace apps
{
  /**
   * Run particles to their end. When interrupted, they are left in FOLDER/under_way.h5, from where the next call goes on.
   * @param name of what is run, for the progress and the checkpoint @param deciding_text see RunRequest
   * @return false when interrupted
   */
  bool run_particles(ParticleCase                &particles,
                     const std::string           &name,
                     const std::filesystem::path &folder,
                     const std::string           &deciding_text);

  /**
   * Runs the particle cases of a study one after the other. Finished ones are kept in FOLDER/states (the discrete state and the curve),
   * the one under way is checkpointed when interrupted.
   */
  class ParticleCases
  {
  public:
    /** @param deciding_text see RunRequest; a checkpoint belongs to it. */
    ParticleCases(const ParticleEventSection &event, std::filesystem::path folder, std::string deciding_text);

    /** @param packing see event_packing() @return false when interrupted, with a checkpoint left. */
    bool complete(const dem::Packing &packing);

    const std::vector<ParticleOutcome> &outcomes() const { return finished; }
    const ParticleOutcome              *reference() const { return all_particles ? &*all_particles : nullptr; }

  private:
    void load_or_run(std::size_t number, const dem::Packing &packing, bool &goes_on);

    const ParticleEventSection    &event;
    std::filesystem::path          folder;
    std::string                    deciding_text;
    std::vector<ParticleOutcome>   finished;
    std::optional<ParticleOutcome> all_particles;
  };
} // namespace apps
