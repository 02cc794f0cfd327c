#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/drivers/homogenisation/report.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/version.h"
#include "apps/results/result_folder.h"
#include "apps/scene/value_text.h"
#include "base/errors.h"
#include "dem/packing/compaction.h"
#include "postprocess/packing_io.h"
#include "postprocess/summary.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>

namespace apps
{
  namespace
  {
    struct HomogeniseOptions
    {
      std::string            packing, folder;
      HomogenisationQuestion question;
      int                    seeds = 1, threads = 0;
    };

    /** The friction a packing was compacted with, where its file says so. */
    double friction_of(const std::string &file)
    {
      const postprocess::Metadata metadata = postprocess::read_packing_metadata(file);
      const auto                  found    = metadata.find("friction");
      return found == metadata.end() ? dem::CompactionParameters().friction :
                                       number_in(found->second).value_or(dem::CompactionParameters().friction);
    }

    std::vector<HomogenisationAnswer> answers_of(const HomogeniseOptions &options)
    {
      const dem::Packing                packing = postprocess::read_packing(options.packing);
      std::vector<HomogenisationAnswer> answers = {homogenise(packing, options.question, options.packing)};
      if (options.seeds > 1 && options.question.links.dimension == 2)
        throw base::InputError(
          "command line: --seeds makes packings of spheres; homogenise packings of discs one by one.");
      for (int seed = 2; seed <= options.seeds; ++seed)
        answers.push_back(homogenise(
          packing_like(packing, friction_of(options.packing), static_cast<std::uint64_t>(1000 + seed), options.packing),
          options.question, fmt::format("packing of seed {}", 1000 + seed)));
      return answers;
    }

    int homogenise_packing(HomogeniseOptions &options)
    {
      use_threads(options.threads);
      options.question.links.dimension = options.question.links.thickness > 0 ? 2 : 3;
      catch_interrupts();
      const std::vector<HomogenisationAnswer> answers = answers_of(options);
      fmt::print("{}{}", table_of(answers.front(), options.question), scatter_table(answers));
      if (options.folder.empty())
        return exit_success;
      nlohmann::json json = json_of(answers.front());
      json["made_by"]     = "breccia " + version();
      json["packing"]     = options.packing;
      json["asked"]       = {{"interaction_ratio", options.question.links.interaction_ratio},
                             {"normal_modulus", options.question.links.normal_modulus},
                             {"shear_ratio", options.question.links.shear_ratio},
                             {"tolerance", options.question.solver.tolerance}};
      if (answers.size() > 1)
        json["scatter"] = scatter_json(answers);
      ResultFolder folder(options.folder, ResultFolder::Start::afresh);
      postprocess::write_json(folder.running() / "homogenised.json", json);
      folder.publish();
      fmt::print("\nwritten to {}/homogenised.json\n", options.folder);
      return exit_success;
    }
  } // namespace

  void add_homogenise(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<HomogeniseOptions>();
    auto      &links   = options->question.links;
    auto      &solver  = options->question.solver;
    CLI::App  &command = *program.add_subcommand(
       "homogenise", "Macroscopic stiffness of a periodic packing: from link statistics, affine bound, and relaxed");
    command.add_option("packing", options->packing, "Periodic packing, text or HDF5")->required()->type_name("PACKING");
    command
      .add_option("--interaction-ratio", links.interaction_ratio,
                  "Links up to this times the sum of radii, from 1 to 10")
      ->required()
      ->type_name("IOTA");
    command.add_option("--normal-modulus", links.normal_modulus, "Of the link material along the link [Pa]")
      ->required()
      ->type_name("E");
    command.add_option("--shear-ratio", links.shear_ratio, "Shear over normal modulus of the link material")
      ->required()
      ->type_name("G/E");
    command
      .add_option("--thickness", links.thickness, "The packing is of discs this thick [m]: stiffness in the plane")
      ->type_name("T")
      ->check(CLI::PositiveNumber);
    command
      .add_option("--seeds", options->seeds, "Packings in all: the others are compacted like the one given; default: 1")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
    command.add_option("--tolerance", solver.tolerance, "Unbalanced force over link forces; default: 1e-10")
      ->type_name("TOL")
      ->check(CLI::Range(1e-13, 1e-2));
    command.add_option("--solver", solver.method, "automatic, iterative or direct; default: automatic")
      ->type_name("METHOD")
      ->transform(
        CLI::CheckedTransformer(std::map<std::string, dem::SolverMethod>{{"automatic", dem::SolverMethod::automatic},
                                                                         {"iterative", dem::SolverMethod::iterative},
                                                                         {"direct", dem::SolverMethod::direct}}));
    command.add_option("-o,--output", options->folder, "Folder for homogenised.json")->type_name("DIR");
    add_threads(command, options->threads);
    command.callback([options, &chosen] { chosen = [options] { return homogenise_packing(*options); }; });
  }
} // namespace apps
