#pragma once

#include "tests/environment.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

/** Keeps what gnuplot is told for the length of a scope: the labels of pictures, as text. */
class GnuplotScripts
{
public:
  /** @param folder without a folder "gnuplot", which is made in it */
  explicit GnuplotScripts(const std::filesystem::path &folder)
    : place(make(folder / "gnuplot"))
    , path("PATH", place.string() + ":" + std::getenv("PATH"))
  {
  }

  /** All so far, one after the other. */
  std::string text() const
  {
    std::ostringstream all;
    all << std::ifstream(place / "scripts").rdbuf();
    return all.str();
  }

private:
  /** A gnuplot that is found before the real one, and calls that. */
  static std::filesystem::path make(const std::filesystem::path &folder)
  {
    std::filesystem::create_directory(folder);
    std::ofstream(folder / "gnuplot") << "#!/bin/sh\ncat script >> '" << (folder / "scripts").string()
                                      << "'\nPATH=\"${PATH#*:}\" exec gnuplot \"$@\"\n";
    std::filesystem::permissions(folder / "gnuplot", std::filesystem::perms::owner_all);
    return folder;
  }

  std::filesystem::path place;
  Environment           path;
};
