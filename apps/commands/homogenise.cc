#include "apps/commands/command.h"
#include "apps/commands/length_unit_option.h"
#include "apps/commands/number_option.h"
#include "apps/commands/scene_options.h"
#include "apps/models/material.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "apps/process/version.h"
#include "apps/results/result_folder.h"
#include "apps/runs/homogenisation/report.h"
#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/link_law_named.h"
#include "apps/scene/overrides.h"
#include "apps/scene/parameter_file.h"
#include "apps/scene/reader.h"
#include "apps/specimens/mixed_specimen.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "dem/packing/compaction.h"
#include "dem/ranks/ranks.h"
#include "postprocess/files/summary.h"
#include "postprocess/packings/packing_io.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

namespace apps
{
  namespace
  {
    struct HomogeniseOptions
    {
      std::string                     packing, folder, law, materials;
      std::vector<std::string>        constants;
      std::optional<base::LengthUnit> length_unit; ///< of the packing
      HomogenisationQuestion          question;
      int                             seeds = 1, threads = 0;
    };

    /** The friction a packing was compacted with, where its file says so. */
    double friction_of(const HomogeniseOptions &options)
    {
      const postprocess::Metadata metadata = postprocess::read_packing_metadata(options.packing, options.length_unit);
      const auto                  found    = metadata.find("friction");
      return found == metadata.end() ? dem::CompactionParameters().friction :
                                       number_in(found->second).value_or(dem::CompactionParameters().friction);
    }

    /** Whether an assignment is to an entry that was declared, or to one of the mix, of all that a scene's specimen says. */
    bool is_of_materials(const Assignment &each, Section &root)
    {
      return !each.sections.empty() && root.find_section(each.sections.front()) != nullptr &&
             (each.sections.front() != "Specimen" || (each.sections.size() > 1 && each.sections[1] == "Mix"));
    }

    /** Materials, or the mix, as a scene has them, in the packing's numbers; whatever else the scene says is left aside. */
    dem::LinkMaterials materials_of_scene(const std::string              &scene,
                                          const std::vector<std::string> &changes,
                                          dem::Packing                   &packing,
                                          const dem::NetworkParameters   &links)
    {
      MaterialSection materials;
      MixSection      mix;
      SpecimenSection cell;
      Section         root;
      declare(root, materials);
      declare(root.section("Specimen", "The particles"), mix);
      std::vector<Assignment>       said    = read_parameter_file(scene);
      const std::vector<Assignment> changed = read_overrides(changes);
      said.insert(said.end(), changed.begin(), changed.end());
      said.erase(
        std::remove_if(said.begin(), said.end(), [&](const Assignment &each) { return !is_of_materials(each, root); }),
        said.end());
      assign(root, said, scene);
      cell.body              = SpecimenSection::Body::cell;
      cell.interaction_ratio = links.interaction_ratio;
      const MixedSpecimen mixed{cell, mix, materials, links.dimension};
      with_places(root, [&] {
        materials.check({}, links.dimension);
        mixed.check({});
      });
      mixed.number(packing, scene);
      return mixed.materials(packing.material_names);
    }

    /** What the links obey: moduli, or a law, or the materials of a scene. */
    void choose_links(HomogeniseOptions &options, dem::Packing &packing)
    {
      auto      &links  = options.question.links;
      const bool moduli = links.normal_modulus > 0 || links.shear_ratio > 0;
      if ((moduli ? 1 : 0) + (options.law.empty() ? 0 : 1) + (options.materials.empty() ? 0 : 1) != 1)
        throw base::InputError("command line: give one of --normal-modulus with --shear-ratio, --law and --materials.");
      if (!options.constants.empty() && moduli)
        throw base::InputError("command line: -s changes constants of --law, or entries of --materials.");
      if (!options.law.empty())
        {
          const dem::LinkLawKind &law = link_law_named(options.law);
          options.question.materials  = law.materials({{"", constants_of(law, options.constants).get(), 0}});
        }
      if (!options.materials.empty())
        options.question.materials = materials_of_scene(options.materials, options.constants, packing, links);
    }

    std::vector<HomogenisationAnswer> answers_of(HomogeniseOptions &options)
    {
      dem::Packing packing = postprocess::read_packing(options.packing, options.length_unit);
      choose_links(options, packing);
      std::vector<HomogenisationAnswer> answers = {homogenise(packing, options.question, options.packing)};
      if (options.seeds > 1 && options.question.materials && options.question.materials->several())
        throw base::InputError(
          "command line: --seeds makes packings of one material; homogenise those of several one by one.");
      if (options.seeds > 1 && options.question.links.dimension == 2)
        throw base::InputError(
          "command line: --seeds makes packings of spheres; homogenise packings of discs one by one.");
      for (int seed = 2; seed <= options.seeds; ++seed)
        answers.push_back(homogenise(
          packing_like(packing, friction_of(options), static_cast<std::uint64_t>(1000 + seed), options.packing),
          options.question, fmt::format("packing of seed {}", 1000 + seed)));
      return answers;
    }

    int homogenise_packing(HomogeniseOptions &options)
    {
      use_threads(options.threads);
      options.question.links.dimension = options.question.links.thickness > 0 ? 2 : 3;
      catch_interrupts();
      start_mpi_for_ranks();
      const std::shared_ptr<dem::Ranks> team          = launched_team();
      options.question.solver.ranks                   = team.get();
      const std::vector<HomogenisationAnswer> answers = answers_of(options);
      if (!is_first_rank())
        return exit_success;
      fmt::print("{}{}", table_of(answers.front(), options.question), scatter_table(answers));
      if (options.folder.empty())
        return exit_success;
      nlohmann::json json = json_of(answers.front());
      json["made_by"]     = "breccia " + version();
      json["packing"]     = options.packing;
      json["requested"]   = {{"interaction_ratio", options.question.links.interaction_ratio},
                             {"installation_gap", options.question.links.installation_gap},
                             {"tolerance", options.question.solver.tolerance}};
      if (options.question.materials)
        json["requested"].update({{"law", options.question.materials->bonds(dem::Physics())->name()},
                                  {"materials", options.materials},
                                  {"changes", options.constants}});
      else
        json["requested"].update({{"normal_modulus", options.question.links.normal_modulus},
                                  {"shear_ratio", options.question.links.shear_ratio}});
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
    command.footer(
      "Under mpirun the processes share the iterations; a factor (--solver direct) is made by each alone.");
    command.add_option("packing", options->packing, "Periodic packing, text or HDF5")->required()->type_name("PACKING");
    add_length_unit(command, options->length_unit);
    command
      .add_option("--interaction-ratio", links.interaction_ratio,
                  "Links up to this times the sum of radii, from 1 to 10")
      ->required()
      ->type_name("IOTA");
    add_number_option(command, {"--installation-gap", "gap", "m", Range::between(0, 1e3)}, links.installation_gap,
                      "That much further still [m]; default: 0")
      ->type_name("GAP");
    auto *modulus = add_number_option(command, {"--normal-modulus", "modulus", "Pa", {}}, links.normal_modulus,
                                      "Of the link material along the link [Pa]")
                      ->type_name("E");
    auto *ratio =
      command.add_option("--shear-ratio", links.shear_ratio, "Shear over normal modulus of the link material")
        ->type_name("G/E");
    modulus->needs(ratio);
    ratio->needs(modulus);
    command
      .add_option("--law", options->law,
                  "In place of moduli: a law of links by its name, with its constants by -s; moments count")
      ->type_name("NAME");
    command
      .add_option("--materials", options->materials,
                  "Or a scene: sections Material or Materials, Interfaces, Regions and Specimen/Mix of it are what the "
                  "links obey")
      ->type_name("SCENE");
    add_overrides(command, options->constants,
                  "Constant of --law, e.g. -s \"Effective modulus=10e9\", or entry of --materials; repeatable");
    add_number_option(command, {"--thickness", "thickness", "m", Range::positive()}, links.thickness,
                      "The packing is of discs this thick [m]: stiffness in the plane")
      ->type_name("T");
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
    add_no_cache(command);
    command.callback([options, &chosen] { chosen = [options] { return homogenise_packing(*options); }; });
  }
} // namespace apps
