#include "apps/commands/command.h"
#include "apps/commands/length_unit_option.h"
#include "apps/commands/number_option.h"
#include "apps/commands/scene_options.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/version.h"
#include "apps/results/warning.h"
#include "apps/scene/usual_sizes.h"
#include "apps/specimens/packing_density.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "dem/packing/box_cell.h"
#include "dem/packing/moulded_box.h"
#include "postprocess/packings/packing_io.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>

namespace apps
{
  namespace
  {
    struct PackOptions
    {
      dem::CompactionParameters       generator;
      std::string                     from, box, output;
      std::optional<base::LengthUnit> length_unit; ///< of `from`
      bool                            periodic = false;
      bool                            counted  = false; ///< the user says how many spheres the cell has
      bool                            moulded  = false; ///< a box between plates
      int                             threads  = 0;
    };

    Eigen::Vector3d box_edges(const std::string &text)
    {
      const std::vector<std::string> parts = comma_separated(list_without_units(text, "m"));
      Eigen::Vector3d                edges = Eigen::Vector3d::Zero();
      bool                           valid = parts.size() == 3;
      for (std::size_t i = 0; valid && i < 3; ++i)
        {
          const auto edge                     = number_in(parts[i]);
          valid                               = edge && *edge >= 1e-12 && *edge <= 1e9;
          edges[static_cast<Eigen::Index>(i)] = edge.value_or(0);
        }
      if (!valid)
        throw base::InputError("command line: --box " + text +
                               ": expected three edges \"lx,ly,lz\", each from 1e-12 to 1e9 m.");
      if (const std::string question = question_about_list("size", "m", text); !question.empty())
        throw base::InputError("command line: --box " + text + ": " + question + ".");
      return edges;
    }

    /** Solid volume over that of the cell or of the box; overlaps counted twice. */
    double packing_fraction(const dem::Packing &packing, const Eigen::Vector3d &box)
    {
      return dem::solid_volume(packing) / (packing.periodic_cell ? packing.periodic_cell->prod() : box.prod());
    }

    postprocess::Metadata metadata_of(const dem::CompactionParameters &generator, const dem::CompactionResult &result)
    {
      return {{"made by",
               "breccia " + version() +
                 (generator.moulded ? ", isotropic compaction between plates" : ", periodic isotropic compaction")},
              {"seed", fmt::format("{}", generator.seed)},
              {"friction", fmt::format("{}", generator.friction)},
              {"damping", fmt::format("{}", generator.damping)},
              {"pressure", fmt::format("{}", generator.low_pressure)},
              {generator.moulded ? "packing fraction of the mould" : "packing fraction of the cell",
               fmt::format("{}", result.packing_fraction)}};
    }

    void print_result(const char *what, const dem::CompactionResult &result)
    {
      const Eigen::Vector3d edges = result.edges;
      const std::string     size  = edges.minCoeff() == edges.maxCoeff() ?
                                      fmt::format("edge {:.6g} m", edges.x()) :
                                      fmt::format("edges {:.6g}, {:.6g}, {:.6g} m", edges.x(), edges.y(), edges.z());
      fmt::print("{}: {} spheres, {}, packing fraction {:.4f}\n", what, result.packing.size(), size,
                 result.packing_fraction);
      fmt::print("      {:.2f} contacts per sphere, mean overlap {:.2e} of a diameter, {} steps\n", result.coordination,
                 result.mean_overlap, result.steps);
    }

    dem::Packing
    moulded_packing(const PackOptions &options, const Eigen::Vector3d &box, postprocess::Metadata &metadata)
    {
      if (options.box.empty() || !options.from.empty() || options.counted)
        throw base::InputError("command line: --moulded goes with --radius and --box, and decides --count itself.");
      return dem::moulded_box(options.generator, box, [&](const dem::CompactionParameters &generator) {
        dem::CompactionResult made = compact_with_progress(generator);
        metadata                   = metadata_of(generator, made);
        print_result("mould", made);
        return made;
      });
    }

    /** A new packing, or the one of --from, as it is before cropping. */
    dem::Packing source_packing(const PackOptions &options, const Eigen::Vector3d &box, postprocess::Metadata &metadata)
    {
      if (!options.from.empty())
        {
          metadata = postprocess::read_packing_metadata(options.from, options.length_unit);
          return postprocess::read_packing(options.from, options.length_unit);
        }
      const bool            cut_out = !options.box.empty() && !options.counted;
      dem::CompactionResult result =
        compact_with_progress(cut_out ? dem::cell_for_box(options.generator, box) : options.generator);
      metadata = metadata_of(options.generator, result);
      print_result("cell", result);
      return std::move(result.packing);
    }

    int pack(const PackOptions &options)
    {
      use_threads(options.threads);
      if (options.from.empty() && !(options.generator.radius > 0))
        throw base::InputError(
          "command line: give --radius (> 0, in m) for a new packing, or --from FILE for an existing one.");
      Eigen::Vector3d box = Eigen::Vector3d::Zero();
      if (!options.box.empty())
        box = box_edges(options.box);
      catch_interrupts();

      postprocess::Metadata metadata;
      dem::Packing          packing =
        options.moulded ? moulded_packing(options, box, metadata) : source_packing(options, box, metadata);
      if (!options.box.empty())
        {
          if (!options.moulded)
            packing = cropped(packing, box);
          fmt::print("box:  {} spheres, packing fraction {:.4f}\n", packing.size(), packing_fraction(packing, box));
          if (const PackingDensity density = density_in(packing, box, 3); density.has_sparse_faces())
            give_note(fmt::format("the faces of the box are cut and sparse: packing fraction {:.3f} inside. A bonded "
                                  "specimen of it is softer and weaker than its inside; --moulded gives flat faces.",
                                  density.inside));
        }
      postprocess::write_packing(packing, options.output, metadata);
      fmt::print("written to {}\n", options.output);
      return exit_success;
    }
  } // namespace

  void add_pack(CLI::App &program, Action &chosen)
  {
    const auto                 options = std::make_shared<PackOptions>();
    dem::CompactionParameters &make    = options->generator;
    CLI::App                  &command =
      *program.add_subcommand("pack", "Make a random packing of equal spheres by compaction, or crop an existing one");
    const auto with_default = [](const std::string &meaning, const auto value) {
      return fmt::format("{}; default: {}", meaning, value);
    };
    add_number_option(command, {"--radius", "particle radius", "m", {}}, make.radius, "Of every sphere [m]")
      ->type_name("R");
    CLI::Option *count =
      command
        .add_option("--count", make.count,
                    fmt::format("Spheres in the periodic cell; default: {}, for a box up to {} so that nothing repeats",
                                make.count, dem::most_in_one_cell))
        ->type_name("N")
        ->check(CLI::Range(1.0, 1e8));
    command.add_option("--seed", make.seed, with_default("Another seed, another packing", make.seed))
      ->type_name("N")
      ->check(CLI::Range(0.0, 9007199254740992.0)); // as in a scene
    command
      .add_option("--friction", make.friction,
                  with_default("During compaction; 0 gives a packing fraction of 0.65, 1 0.55", make.friction))
      ->type_name("MU");
    command
      .add_option("--damping", make.damping, with_default("Local damping during compaction, in [0, 1)", make.damping))
      ->type_name("D");
    command
      .add_option("--pressure", make.low_pressure,
                  with_default("Of the contacts in which the packing is left, p 2r/k_n, below 0.1", make.low_pressure))
      ->type_name("P");
    command.add_option("--from", options->from, "Take this packing instead of making one")->type_name("FILE");
    add_length_unit(command, options->length_unit);
    CLI::Option *box =
      command.add_option("--box", options->box, "Repeat the cell to fill this box, and crop to it [m]")
        ->type_name("LX,LY,LZ");
    command.add_flag(
      "--moulded", options->moulded,
      "Compact the box between six smooth plates, so that its faces are flat, instead of cutting it out");
    command.add_flag("--periodic", options->periodic, "Keep the periodic cell (as without --box)")->excludes(box);
    command
      .add_option("-o,--output", options->output, "Packing: HDF5 for a name in .h5, otherwise text \"x y z radius\"")
      ->required()
      ->type_name("FILE");
    add_threads(command, options->threads);
    add_no_cache(command);
    command.callback([options, count, &chosen] {
      options->counted = count->count() > 0;
      chosen           = [options] { return pack(*options); };
    });
  }
} // namespace apps
