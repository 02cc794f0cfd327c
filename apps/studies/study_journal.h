#pragma once

#include "apps/studies/folder_lock.h"
#include "apps/studies/study_plan.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** What became of one run. */
  struct RunRecord
  {
    std::vector<std::optional<double>> responses;      ///< nothing: not determined
    std::vector<std::string>           units, reasons; ///< of each response; why it is not determined
    std::string                        message;        ///< why there is no result; "": there is one
    double                             seconds = 0;    ///< wall clock

    bool failed() const { return !message.empty(); }
  };

  /**
   * What is known of the runs of a study: a file for each that has ended, which appears complete or not at all. So whoever is killed
   * loses the runs in progress alone, and processes on several machines can share a folder.
   */
  class StudyJournal
  {
  public:
    /**
     * Open the journal of a study in its folder, or begin it, and hold this part of it as long as this lives.
     * @param part, parts which runs are this process's: every parts-th @param afresh throw away the runs of this part, or everything where
     * the folder holds another study
     * @throws base::InputError where the folder holds that of another study; postprocess::OutputError where another process works on this
     * part, on parts that share runs with it, or on the other study
     */
    StudyJournal(std::filesystem::path study_folder, const StudyPlan &plan, int part, int parts, bool afresh);

    std::optional<RunRecord> find(Eigen::Index run) const;
    void                     keep(Eigen::Index run, const RunRecord &record) const;

    /** Held while what all parts share is written, the table for instance. @throws postprocess::OutputError after five seconds */
    FolderLock lock_of_all_parts() const;

    const std::filesystem::path &folder() const { return place; }

  private:
    std::filesystem::path record_of(Eigen::Index run) const;
    void                  hold_part(int part, int parts, bool alone);

    std::filesystem::path     place;
    std::optional<FolderLock> part_lock;
  };
} // namespace apps
