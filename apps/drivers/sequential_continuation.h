#pragma once

#include "apps/drivers/continuum_model.h"
#include "apps/scene/scene.h"
#include "coupling/sequential/particle_field.h"
#include "coupling/sequential/transfer_report.h"

#include <filesystem>

namespace apps
{
  /** What the continuum made of a particle state. */
  struct Continuation
  {
    int                      status = 0; ///< exit status of the run; 130 when interrupted
    coupling::TransferReport report;
    coupling::Equilibration  settled;
    std::string              mesh_file; ///< the initial state of the mesh for ParaView, absolute
  };

  /**
   * Transfer a particle field to the solid of a model, bring it into equilibrium, and write the mesh as it then is to a folder.
   * @throws dem::InputError past the limits of the transfer; dem::NumericalError without equilibrium
   */
  Continuation initialise_only(const ContinuumModel            &model,
                               const coupling::ParticleField   &field,
                               const coupling::TransferOptions &options,
                               const std::filesystem::path     &mesh_folder);

  /** The same, and load it on to the end of the model's analysis; results of a continuum run in the request's folder. */
  Continuation continue_from(const RunRequest                &request,
                             const ContinuumModel            &model,
                             const coupling::ParticleField   &field,
                             const coupling::TransferOptions &options);
} // namespace apps
