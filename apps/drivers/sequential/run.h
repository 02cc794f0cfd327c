#pragma once

#include "apps/drivers/sequential/particles.h"
#include "apps/drivers/sequential/scene.h"
#include "apps/drivers/sequential/study_folder.h"

#include <nlohmann/json.hpp>

namespace apps
{
  /** One run of a sequential scene: its law, its particles, their transfers and continuations, and all that is written. */
  class SequentialRun
  {
  public:
    /** Opens the result folder, and says what is doubtful. @throws as StudyFolder */
    SequentialRun(const SequentialModel &model, SequentialGroundwork ground, const RunRequest &request);

    // Each returns the exit status of Scene::run().
    int carry_on();      ///< the whole study
    int transfer_only(); ///< without going on
    int identify_only(); ///< only the mapping law

  private:
    class TransferRecord;

    bool           find_law();
    bool           continue_case(std::size_t number, const TransferRecord &record) const;
    nlohmann::json summary() const;
    std::string    not_in_balance() const; ///< see left_out_of_balance()
    void           finish(const nlohmann::json &json);

    const SequentialModel       &model;
    SequentialGroundwork         ground;
    RunRequest                   request;
    StudyFolder                  folder;
    std::filesystem::path        running;
    std::optional<IdentifiedLaw> law;
    coupling::TransferOptions    options; ///< with the law that was found
    ParticleCases                particles;
  };
} // namespace apps
