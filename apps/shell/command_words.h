#pragma once

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** An option or a word of a command, as its declaration has it. */
  struct OptionWords
  {
    std::vector<std::string> names;             ///< "-o", "--output"; "scene" of a word that stands by its place
    std::string              type, description; ///< "DIR"; "" of a switch
    bool                     positional = false;

    /** Whether a shell should offer files: by what its type is called. */
    bool takes_file() const;
    /** The values that it takes, where its type lists them: "bash|zsh". */
    std::vector<std::string> choices() const;
  };

  struct CommandWords
  {
    std::string              name, description, footer;
    std::vector<OptionWords> options; ///< without --help
  };

  /** Every command of a program, from the declarations that also make its help and read what is typed. */
  std::vector<CommandWords> words_of_commands(const CLI::App &program);

  /** Completion as a script to be sourced. */
  std::string bash_completion(const std::vector<CommandWords> &commands);
  /** As a file _breccia in a folder of $fpath. */
  std::string zsh_completion(const std::vector<CommandWords> &commands);
  /** A page for man, of section 1. @param version without a commit, so that the page changes with the program alone */
  std::string man_page(const std::vector<CommandWords> &commands, const std::string &version);
} // namespace apps
