#include "apps/shell/command_words.h"

namespace apps
{
  namespace
  {
    std::string joined(const std::vector<std::string> &words, const std::string &between)
    {
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : between) + word;
      return text;
    }

    std::string names_of_commands(const std::vector<CommandWords> &commands)
    {
      std::vector<std::string> names;
      for (const CommandWords &command : commands)
        names.push_back(command.name);
      return joined(names, " ");
    }

    std::string names_of_options(const CommandWords &command)
    {
      std::vector<std::string> names;
      for (const OptionWords &option : command.options)
        if (!option.positional)
          names.insert(names.end(), option.names.begin(), option.names.end());
      names.emplace_back("--help");
      return joined(names, " ");
    }

    /** Between single quotes of a shell, where brackets and colons mean something to zsh. */
    std::string for_zsh(const std::string &text)
    {
      std::string safe;
      for (const char c : text)
        if (c == '\'')
          safe += "'\\''";
        else if (c == '[' || c == ']' || c == ':' || c == '\\')
          safe += std::string("\\") + c;
        else
          safe += c == '\n' ? ' ' : c;
      return safe;
    }

    std::string action_for_zsh(const OptionWords &option)
    {
      const std::vector<std::string> choices = option.choices();
      return !choices.empty() ? "(" + joined(choices, " ") + ")" : option.takes_file() ? "_files" : " ";
    }

    std::string argument_for_zsh(const OptionWords &option)
    {
      const std::string message = for_zsh(option.type.empty() ? option.names.front() : option.type);
      if (option.positional)
        return "'*:" + message + ":" + action_for_zsh(option) + "'";
      std::string text;
      for (const std::string &name : option.names)
        text += (text.empty() ? "" : " ") + std::string("'*") + name + "[" + for_zsh(option.description) + "]" +
                (option.type.empty() ? "" : ":" + message + ":" + action_for_zsh(option)) + "'";
      return text;
    }
  } // namespace

  std::string bash_completion(const std::vector<CommandWords> &commands)
  {
    std::string text = "# Completion of breccia for bash: source <(breccia shell bash)\n"
                       "_breccia()\n{\n"
                       "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
                       "  local command=${COMP_WORDS[1]} options\n"
                       "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
                       "    mapfile -t COMPREPLY < <(compgen -W \"" +
                       names_of_commands(commands) +
                       " --help --version\" -- \"$word\")\n    return\n  fi\n"
                       "  case $command in\n";
    for (const CommandWords &command : commands)
      text += "    " + command.name + ") options=\"" + names_of_options(command) + "\" ;;\n";
    text += "    help) mapfile -t COMPREPLY < <(compgen -W \"" + names_of_commands(commands) +
            "\" -- \"$word\"); return ;;\n  esac\n"
            "  case $command:$before in\n";
    for (const CommandWords &command : commands)
      for (const OptionWords &option : command.options)
        if (const auto choices = option.choices(); !choices.empty())
          for (const std::string &name : option.positional ? std::vector<std::string>{command.name} : option.names)
            text += "    " + command.name + ":" + name + ") mapfile -t COMPREPLY < <(compgen -W \"" +
                    joined(choices, " ") + "\" -- \"$word\"); return ;;\n";
    return text + "  esac\n"
                  "  case $word in\n"
                  "    -*) mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\") ;;\n"
                  "    *) mapfile -t COMPREPLY < <(compgen -f -- \"$word\") ;;\n"
                  "  esac\n}\n"
                  "complete -o filenames -F _breccia breccia\n";
  }

  std::string zsh_completion(const std::vector<CommandWords> &commands)
  {
    std::string text = "#compdef breccia\n"
                       "# Completion of breccia for zsh: breccia shell zsh > ~/.zsh/_breccia, a folder of $fpath\n"
                       "_breccia()\n{\n  local -a commands\n  commands=(\n";
    for (const CommandWords &command : commands)
      text += "    '" + command.name + ":" + for_zsh(command.description) + "'\n";
    text += "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
            "  local chosen=${words[2]}\n  shift words\n  (( CURRENT-- ))\n  case $chosen in\n";
    for (const CommandWords &command : commands)
      {
        text += "    " + command.name + ")\n      _arguments '--help[help]'";
        for (const OptionWords &option : command.options)
          text += " \\\n        " + argument_for_zsh(option);
        text += " ;;\n";
      }
    return text + "  esac\n}\n_breccia \"$@\"\n";
  }
} // namespace apps
