#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/continuum/model.h"
#include "coupling/sequential/particle_field.h"
#include "coupling/sequential/transfer_report.h"

#include <filesystem>
#include <functional>
#include <string>

namespace apps
{
  /** A particle state as the start of a continuum: what was mapped, and how it came into equilibrium. */
  struct TransferredState
  {
    coupling::TransferReport report;
    coupling::Equilibration  settled;
    std::string mesh_file; ///< the initial state of the mesh for ParaView, absolute; "" unless it was written
  };

  /**
   * Transfer a particle field to the solid of a model, bring it into equilibrium, and write the mesh as it then is to a folder.
   * @throws base::InputError past the limits of the transfer; base::NumericalError without equilibrium
   */
  TransferredState initialise_only(const ContinuumModel            &model,
                                   const coupling::ParticleField   &field,
                                   const coupling::TransferOptions &options,
                                   const std::filesystem::path     &mesh_folder);

  /** Called with the state once it is in equilibrium, or when there is none near it. */
  using TransferObserver = std::function<void(const TransferredState &)>;

  /**
   * The same, and load it on to the end of the model's analysis, or to where there is no equilibrium any more or little is left
   * (ContinuumRun::end_where_little_is_left()). A run that is resumed has been observed before.
   * @return the result of a run of kind "continuum"
   */
  RunResult continue_from(const RunRequest                &request,
                          const ContinuumModel            &model,
                          const coupling::ParticleField   &field,
                          const coupling::TransferOptions &options,
                          double                           least_force,
                          const TransferObserver          &observe);
} // namespace apps
