#include "apps/shell/command_words.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    OptionWords words_of_option(const CLI::Option &option)
    {
      OptionWords words;
      words.positional = option.get_positional();
      if (words.positional)
        words.names = {option.get_name()};
      for (const std::string &name : option.get_snames())
        words.names.push_back("-" + name);
      for (const std::string &name : option.get_lnames())
        words.names.push_back("--" + name);
      words.type        = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
      words.description = option.get_description();
      if (const auto checks = words.type.find(':'); checks != std::string::npos) // what validators add
        words.type.erase(checks);
      return words;
    }
  } // namespace

  bool OptionWords::takes_file() const
  {
    for (const char *kind : {"DIR", "SCENE", "FILE", "PACKING", "STUDY", ".csv", ".html", ".h5", ".md", ".png", "PATH"})
      if (type.find(kind) != std::string::npos)
        return true;
    return false;
  }

  std::vector<std::string> OptionWords::choices() const
  {
    std::vector<std::string> words;
    if (type.find('|') == std::string::npos || type.find_first_of(" [](),.") != std::string::npos)
      return words;
    for (std::size_t from = 0; from <= type.size();)
      {
        const std::size_t to = std::min(type.find('|', from), type.size());
        words.push_back(type.substr(from, to - from));
        from = to + 1;
      }
    return words;
  }

  std::vector<CommandWords> words_of_commands(const CLI::App &program)
  {
    std::vector<CommandWords> commands;
    for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; }))
      {
        CommandWords words{command->get_name(), command->get_description(), command->get_footer(), {}};
        for (const CLI::Option *option : command->get_options())
          if (option != command->get_help_ptr())
            words.options.push_back(words_of_option(*option));
        commands.push_back(std::move(words));
      }
    return commands;
  }
} // namespace apps
