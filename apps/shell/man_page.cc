#include "apps/shell/command_words.h"

namespace apps
{
  namespace
  {
    /** As roff takes it literally: hyphens that can be copied, no line that begins with a request. */
    std::string in_roff(const std::string &text)
    {
      std::string safe;
      for (const char c : text)
        {
          if ((safe.empty() || safe.back() == '\n') && (c == '.' || c == '\''))
            safe += "\\&";
          safe += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
        }
      return safe;
    }

    std::string head_of(const OptionWords &option)
    {
      std::string text;
      for (const std::string &name : option.names)
        text += (text.empty() ? "" : ", ") + std::string("\\fB") + in_roff(name) + "\\fR";
      return option.type.empty() ? text : text + " \\fI" + in_roff(option.type) + "\\fR";
    }
  } // namespace

  std::string man_page(const std::vector<CommandWords> &commands, const std::string &version)
  {
    std::string text =
      ".TH BRECCIA 1 \"\" \"breccia " + in_roff(version) +
      "\" \"User commands\"\n.SH NAME\nbreccia \\- discrete and finite elements for concrete, mortar and "
      "rock\n.SH SYNOPSIS\n.B breccia\n.I COMMAND\n[\\fIOPTION\\fR ...]\n.SH COMMANDS\n";
    for (const CommandWords &command : commands)
      {
        text += ".SS " + in_roff(command.name) + "\n" + in_roff(command.description) + ".\n";
        for (const OptionWords &option : command.options)
          text += ".TP\n" + head_of(option) + "\n" + in_roff(option.description) + "\n";
        if (!command.footer.empty())
          text += ".PP\n" + in_roff(command.footer) + "\n";
      }
    return text +
           ".SH EXIT STATUS\n0 done, 1 the computation failed, 2 something given is wrong or cannot be written, 130 "
           "interrupted.\n.SH SEE ALSO\nEvery entry of a scene: \\fBbreccia describe\\fR.\n";
  }
} // namespace apps
