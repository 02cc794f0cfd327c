#pragma once

#include "apps/drivers/continuum_model.h"
#include "apps/drivers/particle_stage.h"
#include "apps/drivers/transfer_section.h"
#include "apps/scene/scene.h"

namespace apps
{
  /** Everything that a sequential study computes from. */
  struct SequentialModel
  {
    /** Section "Study": how the continuations are read and compared. */
    struct Study
    {
      double      length = 1, area = 1; ///< strain = displacement/length [m], stress = force/area [m^2]
      std::string horizontal, vertical; ///< columns of the continuation's series
      double      sign = 1;             ///< with which they are taken
    };

    ParticleStageSection particles;
    TransferSection      transfer;
    ContinuumModel       continuum;
    Study                study;
  };

  /**
   * Scene kind "sequential": an event simulated with particles, handed over once or at several instants, and carried on by a
   * continuum of damage-plastic concrete.
   */
  class SequentialScene : public Scene
  {
  public:
    void        declare(Section &root) override;
    void        validate(const Section &root) const override;
    std::string forecast() const override;
    int         run(const RunRequest &request) const override;

    /** The particle stage and the transfer alone: what `breccia transfer` does. @return exit status as run(). */
    int transfer_only(const RunRequest &request) const;
    /** Fit the mapping law to the particle run and to one continuum element. @return exit status. */
    int identify(const RunRequest &request) const;

    const SequentialModel &parameters() const { return model; }

  private:
    SequentialModel model;
  };
} // namespace apps
