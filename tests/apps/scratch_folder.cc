#include "tests/apps/scratch_folder.h"

#include <stdlib.h>

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace apps_tests
{
  ScratchFolder::ScratchFolder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "breccia-apps-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("no folder for the test: " + pattern);
    folder = pattern;
  }

  ScratchFolder::~ScratchFolder() { std::filesystem::remove_all(folder); }

  std::string ScratchFolder::file(const std::string &name, const std::string &content) const
  {
    std::ofstream(folder / name, std::ios::binary) << content;
    return (folder / name).string();
  }

  std::string content_of(const std::filesystem::path &file)
  {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  std::string listing_of(const std::filesystem::path &folder)
  {
    std::map<std::string, std::string> files;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
      files[entry.path().lexically_relative(folder).string()] = entry.is_regular_file() ? content_of(entry.path()) : "";
    std::string all;
    for (const auto &[name, content] : files)
      all += name + "\n" + content + "\n";
    return all;
  }
} // namespace apps_tests
