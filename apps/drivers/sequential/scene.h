#pragma once

#include "apps/drivers/continuum/model.h"
#include "apps/drivers/sequential/law_identification.h"
#include "apps/drivers/sequential/particle_event.h"
#include "apps/drivers/sequential/transfer_section.h"
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
      double      sign        = 1;      ///< with which they are taken
      double      least_force = 0.05;   ///< see ContinuumRun::end_where_little_is_left()
    };

    ParticleEventSection  particles;
    TransferSection       transfer;
    IdentificationSection identification;
    ContinuumModel        continuum;
    Study                 study;

    /** Groups of elements that states are transferred to. */
    std::vector<const MaterialOfGroup *> receivers() const;

    /** Of the weakest of them [Pa]. */
    double tensile_strength() const;
  };

  /** See SequentialScene::groundwork(). */
  struct SequentialGroundwork
  {
    dem::Packing             packing;
    double                   element_size = 0; ///< mean of the mesh [m]
    std::size_t              elements = 0, unknowns = 0;
    std::string              horizontal_unit, vertical_unit; ///< of what the study compares
    LawOrigin                origin;
    std::vector<std::string> doubts; ///< warnings
  };

  /**
   * Scene kind "sequential": an event simulated with particles, handed over once or at several instants, and carried on by a
   * continuum that can be damaged.
   */
  class SequentialScene : public Scene
  {
  public:
    void        declare(Section &root) override;
    void        check() const override;
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    /** The particles and the transfer alone: what `breccia transfer` does. @return exit status as run(). */
    RunResult transfer_only(const RunRequest &request) const;
    /** Find the mapping law alone, see LawIdentification. @return exit status. */
    RunResult identify(const RunRequest &request) const;

    const SequentialModel &parameters() const { return model; }

    /**
     * What is known before anything runs: particles and solid fit each other and the study, and what there is to be doubted.
     * @throws base::InputError where they do not fit
     */
    SequentialGroundwork groundwork() const;

  private:
    SequentialModel model;
    const Section  *root = nullptr; ///< of the scene, which outlives it
  };
} // namespace apps
