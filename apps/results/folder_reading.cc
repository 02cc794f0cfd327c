#include "apps/results/folder_reading.h"

#include "base/errors.h"
#include "postprocess/files/numeric_text.h"

#include <fstream>

namespace apps
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Columns of a series whose first row is no number: names of tests. */
    std::vector<std::string> word_columns(const fs::path &file)
    {
      std::ifstream stream(file);
      std::string   head, row;
      std::getline(stream, head);
      std::getline(stream, row);
      const auto                    names = postprocess::numeric_text::column_names(head);
      std::vector<std::string_view> fields;
      postprocess::numeric_text::split(row, fields);
      std::vector<std::string> words;
      for (std::size_t k = 0; k < names.size() && k < fields.size(); ++k)
        if (!postprocess::numeric_text::number(fields[k]))
          words.push_back(names[k].name);
      return words;
    }
  } // namespace

  bool holds_a_run(const fs::path &folder)
  {
    return fs::is_regular_file(folder / "scene.prm") && fs::is_regular_file(folder / "summary.json");
  }

  RunResult read_result(const fs::path &folder)
  {
    if (!fs::is_directory(folder))
      throw base::InputError(folder.string() + ": there is no such folder.");
    if (!holds_a_run(folder))
      throw base::InputError(
        folder.string() + ": no results of a complete run (scene.prm and summary.json)" +
        (fs::is_directory(folder / "running") ? "; the run in its sub-folder running is not complete." : "."));
    RunResult result;
    result.folder       = folder;
    const fs::path file = folder / "summary.json";
    result.summary      = nlohmann::json::parse(postprocess::numeric_text::read_whole(file), nullptr, false);
    if (!result.summary.is_object())
      throw base::InputError(file.string() + ": not a summary of a run.");
    if (result.summary.contains("asked")) // of earlier versions
      {
        result.summary["requested"] = result.summary["asked"];
        result.summary.erase("asked");
      }
    const fs::path series = folder / "series.csv";
    if (fs::is_regular_file(series))
      result.series = postprocess::read_csv_table(series, true, word_columns(series));
    return result;
  }
} // namespace apps
