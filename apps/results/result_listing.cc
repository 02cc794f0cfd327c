#include "apps/results/result_listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace apps
{
  namespace
  {
    /** An earlier run may have left files of other names: those are older than the scene that this run wrote first. */
    bool is_of_this_run(const std::filesystem::path &file, const std::filesystem::path &folder)
    {
      std::error_code error;
      const auto      begun = std::filesystem::last_write_time(folder / "scene.prm", error);
      return error || std::filesystem::last_write_time(file) >= begun;
    }

    std::string names_with(const std::filesystem::path &folder, const std::vector<std::string> &extensions)
    {
      std::string text;
      for (const std::string &extension : extensions)
        {
          std::vector<std::string> names;
          for (const auto &entry : std::filesystem::directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().extension() == extension &&
                is_of_this_run(entry.path(), folder))
              names.push_back(entry.path().filename().string());
          std::sort(names.begin(), names.end());
          for (const std::string &name : names)
            text += (text.empty() ? "" : ", ") + name;
        }
      return text;
    }
  } // namespace

  std::string result_listing(const std::filesystem::path &folder)
  {
    const std::string collections = names_with(folder, {".pvd"});
    std::string       text =
      fmt::format("results      {}: {}\n", folder.string(), names_with(folder, {".html", ".json", ".csv", ".png"}));
    if (!collections.empty())
      text += fmt::format("in ParaView  {}; all of it by the macro postprocess/paraview/view_run.py\n", collections);
    return text;
  }
} // namespace apps
