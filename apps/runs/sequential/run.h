#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/sequential/groundwork.h"
#include "apps/runs/sequential/particles.h"
#include "apps/runs/sequential/study_folder.h"
#include "postprocess/files/scratch_folder.h"

#include <memory>

namespace apps
{
  /** One run of a sequential scene: its law, its particles, their transfers and continuations, and all that is written. */
  class SequentialRun
  {
  public:
    /** Opens the result folder, and says what is doubtful. @throws as StudyFolder */
    SequentialRun(const SequentialModel &model, SequentialGroundwork ground, const RunRequest &request);

    // Each is Scene::run().
    RunResult carry_on();      ///< the whole study
    RunResult transfer_only(); ///< without going on
    RunResult identify_only(); ///< only the mapping law

  private:
    class TransferRecord;

    bool find_law();
    /** One case to its end, unless that was reached before an interrupt. */
    RunResult      continue_case(std::size_t number, TransferRecord &record) const;
    nlohmann::json summary() const;
    std::string    not_in_balance() const; ///< see left_out_of_balance()
    RunResult      interrupted() const;
    RunResult      finish(nlohmann::json json, std::string words);
    RunResult      ended(RunResult result) const;

    const SequentialModel                      &model;
    SequentialGroundwork                        ground;
    std::filesystem::path                       results; ///< requested folder; "": none
    std::unique_ptr<postprocess::ScratchFolder> scratch; ///< then
    RunRequest                                  request;
    StudyFolder                                 folder;
    std::filesystem::path                       running;
    std::optional<IdentifiedLaw>                law;
    coupling::TransferOptions                   options; ///< with the law that was found
    ParticleCases                               particles;
  };

  // Work of a checked model. They throw as Scene::run().
  /** The whole study. */
  RunResult run(const SequentialModel &model, const RunRequest &request);
  /** The particles and the transfer alone: what `breccia transfer` does. */
  RunResult transfer_only(const SequentialModel &model, const RunRequest &request);
  /** Find the mapping law alone, see LawIdentification. */
  RunResult identify(const SequentialModel &model, const RunRequest &request);
} // namespace apps
