#pragma once

#include "apps/commands/command.h"
#include "apps/commands/part_option.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /**
   * One bench on the command line: its options, in the order in which help lists them, and the function that takes them.
   *
   * @tparam Bench what that function takes, with its defaults; its `folder` becomes output/bench_NAME
   */
  template <typename Bench>
  class BenchCommand
  {
  public:
    BenchCommand(CLI::App &bench, std::string name, const std::string &meaning)
      : command(*bench.add_subcommand(name, meaning))
    {
      std::replace(name.begin(), name.end(), '-', '_');
      request->bench.folder = "output/bench_" + name;
    }

    /** A scene without which the default of the bench is taken. @param what "Scene of kind uniaxial" */
    void scene(const std::string &name, std::string Bench::*scene, const std::string &what)
    {
      std::string &file = request->bench.*scene;
      command.add_option(name, file, what + "; default: " + file)->type_name("SCENE");
    }

    /** @param scenes of which entries are set */
    void overrides(const std::string &scenes = "the scene")
    {
      add_overrides(command, request->bench.overrides, "Set an entry of " + scenes + "; repeatable");
    }

    void threads(const int by_default)
    {
      request->threads      = by_default;
      request->sets_threads = true;
      add_threads(command, request->threads);
    }

    void no_cache() { add_no_cache(command); }

    void folder(const std::string &holds = "the table and the figure")
    {
      add_bench_folder(command, request->bench.folder, holds);
    }

    void flag(const std::string &name, bool Bench::*value, const std::string &meaning)
    {
      command.add_flag(name, request->bench.*value, meaning);
    }

    template <typename Value>
    CLI::Option &
    option(const std::string &name, Value Bench::*value, const std::string &type, const std::string &meaning)
    {
      return *command.add_option(name, request->bench.*value, meaning)->type_name(type);
    }

    /** Values between commas. */
    template <typename Value>
    CLI::Option &list(const std::string &name,
                      std::vector<Value> Bench::*values,
                      const std::string         &type,
                      const std::string         &meaning)
    {
      return *option(name, values, type, meaning).delimiter(',');
    }

    /** Processes that share the folder. */
    void part(int Bench::*part, int Bench::*parts, const std::string &meaning)
    {
      add_part(command, request->bench.*part, request->bench.*parts, meaning);
    }

    void footer(const std::string &text) { command.footer(text); }

    /** To be called once. @param run returns the exit status */
    void runs(Action &chosen, int (*run)(const Bench &))
    {
      command.callback([request = request, run, &chosen] {
        chosen = [request, run] {
          if (request->sets_threads)
            use_threads(request->threads);
          return run(request->bench);
        };
      });
    }

  private:
    struct Request
    {
      Bench bench;
      int   threads      = 0; ///< see use_threads()
      bool  sets_threads = false;
    };

    CLI::App                      &command;
    const std::shared_ptr<Request> request = std::make_shared<Request>();
  };
} // namespace apps
