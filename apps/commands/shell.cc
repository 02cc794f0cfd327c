#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/process/version.h"
#include "apps/shell/command_words.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <memory>

namespace apps
{
  namespace
  {
    /** "0.1.0" of "0.1.0 (75ee2813ab)" */
    std::string release() { return version().substr(0, version().find(' ')); }
  } // namespace

  void add_shell(CLI::App &program, Action &chosen)
  {
    const auto wanted  = std::make_shared<std::string>();
    CLI::App  &command = *program.add_subcommand("shell", "Completion for bash or zsh, or the page for man");
    command.footer("bash: source <(breccia shell bash)   zsh: breccia shell zsh > _breccia, in a folder of $fpath\n"
                   "man: breccia shell man > ~/.local/share/man/man1/breccia.1");
    command.add_option("what", *wanted, "Which of them")
      ->required()
      ->type_name("bash|zsh|man")
      ->check(CLI::IsMember(std::vector<std::string>{"bash", "zsh", "man"}).description(""));
    command.callback([wanted, &program, &chosen] {
      chosen = [wanted, &program]() -> int {
        const std::vector<CommandWords> commands = words_of_commands(program);
        fmt::print("{}", *wanted == "bash" ? bash_completion(commands) :
                         *wanted == "zsh"  ? zsh_completion(commands) :
                                             man_page(commands, release()));
        return exit_success;
      };
    });
  }
} // namespace apps
