#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace postprocess_tests
{
  /** An empty folder for one test, removed with all it holds at the end of the scope. */
  class ScratchFolder
  {
  public:
    ScratchFolder()
    {
      std::string pattern = (std::filesystem::temp_directory_path() / "breccia-test-XXXXXX").string();
      if (::mkdtemp(pattern.data()) == nullptr)
        throw std::runtime_error("no folder for the test: " + pattern);
      path = pattern;
    }
    ~ScratchFolder() { std::filesystem::remove_all(path); }
    ScratchFolder(const ScratchFolder &)            = delete;
    ScratchFolder &operator=(const ScratchFolder &) = delete;

    std::filesystem::path operator/(const std::string &name) const { return path / name; }

    /** Make a file with this content. */
    std::filesystem::path file(const std::string &name, const std::string &content) const
    {
      std::ofstream(path / name, std::ios::binary) << content;
      return path / name;
    }

    std::filesystem::path path;
  };

  inline std::string content_of(const std::filesystem::path &path)
  {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  inline std::size_t files_in(const std::filesystem::path &folder)
  {
    return std::distance(std::filesystem::directory_iterator(folder), {});
  }
} // namespace postprocess_tests
