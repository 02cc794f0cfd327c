#include "apps/studies/study_journal.h"

#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/files/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace apps
{
  namespace fs = std::filesystem;

  namespace
  {
    void make_folder(const fs::path &folder)
    {
      std::error_code error;
      fs::create_directories(folder, error);
      if (error)
        throw postprocess::OutputError(folder.string() + ": the folder cannot be made: " + error.message() + ".");
    }

    /**
     * What earlier runs of a part left, or of all parts: records, folders and logs are named by their run. Locks stay: a process that waits for one
     * waits for this file.
     */
    void remove_runs(const fs::path &place, const long part, const long parts)
    {
      std::vector<fs::path> old;
      for (const char *name : {"journal", "runs"})
        for (const fs::directory_entry &entry : fs::directory_iterator(place / name))
          if (const long run = std::atol(entry.path().stem().c_str()); run > 0 && (run - part) % parts == 0)
            old.push_back(entry.path());
      std::error_code error;
      for (const fs::path &entry : old)
        fs::remove_all(entry, error);
    }
  } // namespace

  StudyJournal::StudyJournal(
    fs::path study_folder, const StudyPlan &plan, const int part, const int parts, const bool afresh)
    : place(std::move(study_folder))
  {
    make_folder(place / "journal");
    make_folder(place / "runs");
    const FolderLock alone = lock_of_all_parts(); // others may begin at the same moment
    const fs::path   text  = place / "journal" / "plan.txt";
    const bool       begun = fs::exists(text);
    const bool       other = begun && postprocess::numeric_text::read_whole(text) != plan.text;
    if (other && !afresh)
      throw base::InputError(place.string() +
                             ": holds the runs of another study: its scene, factors, design or responses were others. "
                             "Choose another folder with -o, or throw them away with --restart.");
    hold_part(part, parts, other);
    if (other)
      remove_runs(place, 1, 1);
    else if (afresh)
      remove_runs(place, part, parts); // what other parts have done or begun is theirs
    if (!begun || other)
      postprocess::write_text(text, plan.text);
  }

  void StudyJournal::hold_part(const int part, const int parts, const bool alone)
  {
    const std::string split = fmt::format("-of-{}", parts);
    const fs::path    own   = place / "journal" / fmt::format("part-{}{}.lock", part, split);
    for (const fs::directory_entry &entry : fs::directory_iterator(place / "journal"))
      {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".lock" || name.rfind("part-", 0) != 0 || entry.path() == own)
          continue;
        const bool shares_runs = name.substr(name.find("-of-")) != split;
        if (alone || shares_runs)
          const FolderLock free(entry.path()); // or another works on it
      }
    part_lock.emplace(own);
  }

  FolderLock StudyJournal::lock_of_all_parts() const { return FolderLock(place / "journal" / "all-parts.lock"); }

  fs::path StudyJournal::record_of(const Eigen::Index run) const
  {
    return place / "journal" / fmt::format("{:06}.json", run + 1);
  }

  std::optional<RunRecord> StudyJournal::find(const Eigen::Index run) const
  {
    const fs::path file = record_of(run);
    if (!fs::exists(file))
      return std::nullopt;
    const auto json = nlohmann::json::parse(postprocess::numeric_text::read_whole(file), nullptr, false);
    if (!json.is_object() || !json.contains("responses") || !json["responses"].is_array())
      throw base::InputError(file.string() + ": is damaged. Remove it: its run will be repeated.");
    RunRecord record;
    record.message = json.value("message", "");
    record.seconds = json.value("seconds", 0.0);
    for (const auto &response : json["responses"])
      {
        record.units.push_back(response.value("unit", ""));
        record.reasons.push_back(response.value("not_determined", ""));
        record.responses.push_back(response.contains("value") && response["value"].is_number() ?
                                     std::optional<double>(response["value"].get<double>()) :
                                     std::nullopt);
      }
    return record;
  }

  void StudyJournal::keep(const Eigen::Index run, const RunRecord &record) const
  {
    nlohmann::json json = {{"run", run + 1},
                           {"message", record.message},
                           {"seconds", record.seconds},
                           {"responses", nlohmann::json::array()}};
    for (std::size_t k = 0; k < record.responses.size(); ++k)
      {
        nlohmann::json response = {{"unit", record.units[k]}};
        if (!record.reasons[k].empty())
          response["not_determined"] = record.reasons[k];
        if (record.responses[k])
          response["value"] = *record.responses[k];
        json["responses"].push_back(response);
      }
    postprocess::write_json(record_of(run), json);
  }
} // namespace apps
