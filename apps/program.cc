#include "apps/program.h"

#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/process/version.h"
#include "apps/scene/absent.h"
#include "apps/text/nearest_name.h"
#include "base/errors.h"
#include "dem/core/floating_point_traps.h"
#include "dem/core/kernel_vectors.h"
#include "dem/packing/compaction.h"
#include "postprocess/files/errors.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <system_error>

namespace apps
{
  namespace
  {
    std::vector<std::string> command_names(const CLI::App &program)
    {
      std::vector<std::string> names;
      for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; }))
        names.push_back(command->get_name());
      return names;
    }

    bool is_command(const CLI::App &program, const std::string &word)
    {
      const auto names = command_names(program);
      return std::find(names.begin(), names.end(), word) != names.end();
    }

    int refuse_command_line(const std::string &command, const std::string &message)
    {
      fmt::print(stderr, "breccia{}: {}\nRun \"breccia{} --help\" for what is possible.\n", command, message, command);
      return exit_bad_input;
    }

    int refuse_command(const CLI::App &program, const std::string &word)
    {
      const std::string answer = absent(word);
      const std::string words  = answer.empty() ? did_you_mean(word, command_names(program)) : answer;
      return refuse_command_line("",
                                 fmt::format("\"{}\" is not a command.{}{}", word, words.empty() ? "" : " ", words));
    }

    std::vector<std::string> option_names(const CLI::App &command)
    {
      std::vector<std::string> names;
      for (const CLI::Option *option : command.get_options())
        for (const std::string &name : option->get_lnames())
          names.push_back("--" + name);
      return names;
    }

    bool is_long_option(const std::string &word) { return word.rfind("--", 0) == 0; }

    /** What of a command line is no option of its command, with the one that was meant; "" where it is all known. */
    std::string unknown_option(const CLI::App &command, const std::vector<std::string> &left)
    {
      const auto known = option_names(command);
      for (const std::string &word : left)
        {
          const std::string name = word.substr(0, word.find('='));
          if (!is_long_option(word) || std::find(known.begin(), known.end(), name) != known.end())
            continue;
          const std::string meant = did_you_mean(name, known);
          return fmt::format("\"{}\" is not an option.{}{}", name, meant.empty() ? "" : " ", meant);
        }
      return {};
    }

    /** A wrong command line in one message, with the nearest command or option where one was meant. */
    int refuse_words(const CLI::App &program, const CLI::ParseError &error, const std::string &first_word)
    {
      const CLI::App *command = &program;
      std::string     path;
      for (auto typed = program.get_subcommands(); !typed.empty(); typed = command->get_subcommands())
        {
          command = typed.front();
          path += " " + command->get_name();
        }
      if (path.empty() && !first_word.empty() && first_word[0] != '-')
        return refuse_command(program, first_word);
      const std::string unknown =
        unknown_option(*command, path.empty() ? std::vector<std::string>{first_word} : command->remaining());
      return refuse_command_line(path, unknown.empty() ? error.what() : unknown);
    }

    /** "help" and "help run" are "--help" and "run --help". */
    std::vector<std::string> words_of(const int argc, char *argv[])
    {
      std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
      if (!words.empty() && words.front() == "help")
        {
          words.erase(words.begin());
          words.emplace_back("--help");
        }
      return words;
    }

    int complain(const std::string &message, const int status)
    {
      return end_of_failed_rank(status, [&] { fmt::print(stderr, "breccia: {}\n", message); });
    }

    int perform(const Action &action, const std::string &command)
    {
      try
        {
          const Progress working(command, Progress::Shown::in_logs); // speaks where no part of the work does
          return action();
        }
      catch (const base::InputError &error)
        {
          return complain(error.what(), exit_bad_input);
        }
      catch (const postprocess::OutputError &error)
        {
          return complain(error.what(), exit_bad_input);
        }
      catch (const base::NumericalError &error)
        {
          return complain(fmt::format("the computation broke down: {}", error.what()), exit_failure);
        }
      catch (const dem::CompactionCancelled &)
        {
          return complain("interrupted while the packing was made; nothing was written.", exit_interrupted);
        }
      catch (const dem::CompactionFailed &error)
        {
          return complain(error.what(), exit_failure);
        }
      catch (const std::bad_alloc &)
        {
          return complain("not enough memory for this model. \"breccia check SCENE\" says how much it takes.",
                          exit_failure);
        }
      catch (const std::exception &error)
        {
          const auto *system = dynamic_cast<const std::system_error *>(&error);
          if (system && system->code() == std::errc::broken_pipe) // the reader, head for example, has enough
            return exit_failure;
          return complain(fmt::format("internal error: {}", error.what()), exit_failure);
        }
    }
  } // namespace

  int run_program(const int argc, char *argv[])
  {
    std::signal(SIGXFSZ, SIG_IGN); // a file size limit then shows as a write error, which is reported like a full disk
    std::signal(SIGPIPE, SIG_IGN); // and so does a reader that went away
    dem::enable_floating_point_traps();
    CLI::App program("Breccia: discrete and finite elements for concrete, mortar and rock", "breccia");
    program.set_version_flag("--version", "breccia " + version() + ", kernels of " +
                                            std::to_string(8 * dem::bytes_of_kernel_vectors()) + " bits");
    program.require_subcommand(1);
    Action chosen;
    for (const AddCommand add : all_commands())
      add(program, chosen);
    const std::vector<std::string> words      = words_of(argc, argv);
    const std::string              first_word = words.empty() ? "" : words.front();
    if (words.size() == 2 && words.back() == "--help" && !is_command(program, first_word) && first_word[0] != '-')
      return refuse_command(program, first_word);
    try
      {
        program.parse(std::vector<std::string>(words.rbegin(), words.rend())); // CLI takes them from the back
      }
    catch (const CLI::ParseError &error)
      {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) // --help, --version
          return program.exit(error);
        return refuse_words(program, error, first_word);
      }
    const int status = perform(chosen, program.get_subcommands().front()->get_name());
    finish_mpi();
    return status;
  }
} // namespace apps
