#include "apps/studies/calibration_file.h"

#include "apps/scene/overrides.h"
#include "apps/scene/parameter_file.h"
#include "apps/scene/reader.h"
#include "apps/text/same_name.h"
#include "apps/text/value_text.h"
#include "base/errors.h"

#include <algorithm>
#include <filesystem>

namespace apps
{
  namespace
  {
    void declare_least_squares(CalibrationFile &calibration, Section &section)
    {
      section
        .choice(
          "Method", calibration.method,
          {{"least squares", SearchMethod::least_squares}, {"without derivatives", SearchMethod::without_derivatives}},
          Need::optional)
        .means("least squares: by derivatives; without derivatives: more runs, for models whose noise is large");
      section.number("Step", calibration.step, "-", Range::between(1e-8, 0.5), Need::optional)
        .means("Of differences, over the range of a constant: beyond the noise of the model");
      section.flag("Central differences", calibration.central_differences)
        .means("Twice the runs for a derivative, for smooth models");
      section.flag("Updated derivatives", calibration.updated_jacobian)
        .means("Derivatives are updated from step to step as long as that succeeds, which saves runs");
      section
        .choice("Model noise", calibration.model_noise,
                {{"automatic", optimisation::NoiseSearch::where_it_matters},
                 {"true", optimisation::NoiseSearch::always},
                 {"false", optimisation::NoiseSearch::never}},
                Need::optional)
        .means("Runs scatter where links break: four runs on a line through the answer show whether that matters "
               "(automatic). Where it "
               "does, or with true, wide central differences and more such lines put the answer and its bands right");
      section.integer("Most evaluations", calibration.most_runs, "", Range::between(2, 1000000), Need::optional)
        .means("Sets of constants that are run before it gives up");
      section.number("Smallest sum", calibration.smallest_relative_sum, "-", Range::between(0, 1), Need::optional)
        .means("Of squared deviations over squared targets: then it ends. 0: where a smaller one would move no "
               "constant by a tenth of its "
               "standard error (standard deviations given), or 1e-6 (as many targets as constants)");
      section.number("Smallest decrease", calibration.smallest_decrease, "-", Range::between(0, 1), Need::optional)
        .means("Of the sum of squares in a step that succeeds, over the sum: then it ends");
    }

    void declare_replicates(CalibrationFile &calibration, Section &section)
    {
      section.text("Entry", calibration.seed_entry, Need::optional)
        .means("Seed of the scenes, \"Specimen/Generator/Seed\": each set of constants is run with each of them");
      section.text("Seeds", calibration.seeds_text, Need::optional)
        .means("Between commas; the same ones for every set of constants, the mean is compared");
    }

    void declare_cheap_model(CalibrationFile &calibration, Section &section)
    {
      section.file("Base scene", calibration.cheap.base_scene, Need::optional)
        .means("In place of the base scene: an answer without inertia, a coarser packing");
      section.text("Changes", calibration.cheap.changes, Need::optional)
        .means("To its scenes, \"Specimen/Generator/Particle radius=3e-3; Loading/Compression/Strain rate=10\"");
    }

    void declare_posterior(CalibrationFile &calibration, Section &section)
    {
      section.integer("Runs", calibration.posterior.runs, "", Range::between(0, 300), Need::optional)
        .means("Sets of constants around the answer, which an emulator stands for afterwards; 0: no posterior");
      section.integer("Draws", calibration.posterior.draws, "", Range::between(100, 100000), Need::optional)
        .means("Of each walker of the sampler");
      section.integer("Seed", calibration.posterior.seed, "", Range::between(0, 1e15), Need::optional)
        .means("Of the sets and of the sampler");
    }

    void declare_sought_constants(CalibrationFile &calibration, Section &constants)
    {
      constants.named_sections("CONSTANT", [&calibration](Section &opened) {
        SoughtConstant &constant = calibration.constants.emplace_back();
        constant.name            = opened.name();
        opened.text("Targets", constant.targets, Need::optional)
          .means("Names, between commas, of those whose scenes it is an entry of; empty: of all");
        const Range any;
        opened.text("Entry", constant.entries, Need::required)
          .means("Of the scenes, \"Material/CPM/Cohesion\"; several between commas get the same value");
        opened.number("Start", constant.start, "", any, Need::required).means("In the unit of the entry");
        opened.number("Lower", constant.lower, "", any, Need::required).means("Bound");
        opened.number("Upper", constant.upper, "", any, Need::required).means("Bound");
      });
    }

    void declare_reference(CalibrationTarget &target, Section &section)
    {
      const auto        has_one = [&target] { return !target.reference.empty(); };
      const std::string where   = "there is a reference scene";
      section.file("Reference scene", target.reference, Need::optional)
        .means("Its run, once, is what was measured: particles, for the law of a continuum");
      section.text("Reference figure", target.reference_figure, Need::optional)
        .means("Name of the figure in its run, where it has another there")
        .only_if([&target] { return !target.reference.empty() && !target.is_curve(); },
                 "there are a figure and a reference scene");
      section.text("Reference abscissa", target.reference_abscissa, Need::optional)
        .means("Column of its series.csv")
        .only_if(has_one, where);
      section.text("Reference ordinate", target.reference_ordinate, Need::optional)
        .means("Likewise")
        .only_if(has_one, where);
      section.text("Reference test", target.reference_test, Need::optional)
        .means("Rows by their column \"test\"")
        .only_if(has_one, where);
      section.number("Abscissa factor", target.abscissa_factor, "", Range(), Need::optional)
        .means(
          "Of the run's column, into what was measured: one over the gauge length, from a displacement to a strain");
      section.number("Ordinate factor", target.ordinate_factor, "", Range(), Need::optional)
        .means("Likewise: one over the section, from a force to a stress");
    }

    void declare_targets(CalibrationFile &calibration, Section &targets)
    {
      targets.named_sections("TARGET", [&calibration](Section &opened) {
        CalibrationTarget &target = calibration.targets.emplace_back();
        target.name               = opened.name();
        opened.file("Scene", target.scene, Need::optional).means("The test, where it is not the base scene");
        opened.file("Cheap scene", target.cheap_scene, Need::optional)
          .means("The same test by the cheap model, where changes do not make it cheap")
          .only_if([&calibration] { return calibration.cheap.exists(); }, "there is a cheap model");
        opened.text("Figure", target.figure, Need::optional)
          .means("Name among the figures of summary.json, \"compressive_strength\"");
        opened.number("Value", target.value, "", Range(), Need::optional)
          .means("What was measured, in SI units; not wanted with a reference scene");
        opened.file("Curve", target.curve)
          .means("Table of a measured curve, in place of a figure")
          .only_if([&target] { return target.figure.empty() && target.reference.empty(); },
                   "there is neither a figure nor a reference scene");
        opened.text("Abscissa", target.abscissa, Need::optional)
          .means("Column of the curve, and of the run's series.csv");
        opened.text("Ordinate", target.ordinate, Need::optional).means("Likewise");
        opened.text("Test", target.test, Need::optional)
          .means("Rows of series.csv by their column \"test\", \"compression\"");
        declare_reference(target, opened);
        opened.number("Standard deviation", target.deviation, "", Range::at_least(0), Need::optional)
          .means("Of what was measured; 0: not known");
        opened.number("Weight", target.weight, "-", Range::between(1e-6, 1e6), Need::optional)
          .means("Of its squares, where standard deviations are not known");
      });
    }

    void declare(CalibrationFile &calibration)
    {
      Section &root = *calibration.root;
      root.text("Kind", calibration.kind, Need::required).means("calibration");
      root.file("Base scene", calibration.base_scene).means("The test whose constants are sought");
      root.text("Output folder", calibration.output_folder, Need::optional)
        .means("Where results go (option -o)")
        .housekeeping();
      root.integer("Threads per run", calibration.threads_per_run, "", Range::between(1, 1024), Need::optional)
        .means("As many runs go on at a time as there are processors for; where fewer are left that last ten seconds "
               "or more, they share these")
        .housekeeping();
      declare_least_squares(calibration, root.section("Search", "Least squares"));
      declare_replicates(calibration, root.section("Replicates", "Several packings"));
      declare_cheap_model(
        calibration,
        root.section("Cheap model", "Run first; its answer and derivatives are where the costly one begins"));
      declare_posterior(calibration,
                        root.section("Posterior", "How probable constants are beyond the linearised bands"));
      declare_sought_constants(calibration, root.section("Constants", "What is sought"));
      declare_targets(calibration, root.section("Targets", "What was measured"));
    }

    void validate_target(CalibrationFile &calibration, CalibrationTarget &target)
    {
      const Section &section = *calibration.root->find_section("Targets")->find_section(target.name);
      if (target.scene.empty())
        target.scene = calibration.base_scene;
      if (target.cheap_scene.empty() && target.scene == calibration.base_scene)
        target.cheap_scene = calibration.cheap.base_scene;
      if (target.reference_figure.empty())
        target.reference_figure = target.figure;
      if (target.abscissa_factor == 0 || target.ordinate_factor == 0)
        section.refuse(target.abscissa_factor == 0 ? "Abscissa factor" : "Ordinate factor", "must not be zero.");
      if (!target.is_curve() && target.value == 0 && target.reference.empty())
        section.refuse("Value", "deviations are relative to it; it must not be zero.");
      bool known = false;
      for (const CalibrationTarget &other : calibration.targets)
        known = known || other.deviation > 0;
      if (known && target.deviation == 0)
        section.refuse("Standard deviation", "others have one: all or none.");
    }

    void validate_calibration(CalibrationFile &calibration)
    {
      if (!same_name(calibration.kind, "calibration"))
        calibration.root->refuse("Kind", "a calibration is wanted.");
      if (calibration.constants.empty() || calibration.targets.empty())
        throw base::InputError(calibration.file + ": a constant (a sub-section of Constants) and a target (one of "
                                                  "Targets) are wanted.");
      for (const SoughtConstant &constant : calibration.constants)
        {
          const Section &section = *calibration.root->find_section("Constants")->find_section(constant.name);
          if (!(constant.lower < constant.upper))
            section.refuse("Upper", "must be above Lower.");
          if (!(constant.lower <= constant.start && constant.start <= constant.upper))
            section.refuse("Start", "must lie between Lower and Upper.");
          if (comma_separated(constant.entries).empty())
            section.refuse("Entry", "an entry of the scenes is wanted.");
          for (const std::string &target : comma_separated(constant.targets))
            if (std::none_of(calibration.targets.begin(), calibration.targets.end(),
                             [&target](const CalibrationTarget &known) { return known.name == target; }))
              section.refuse("Targets", "there is no target " + target + ".");
        }
      for (CalibrationTarget &target : calibration.targets)
        validate_target(calibration, target);
      if (calibration.seed_entry.empty() != calibration.seeds_text.empty())
        calibration.root->find_section("Replicates")->refuse("Seeds", "wanted with Entry, and only with it.");
    }
  } // namespace

  std::unique_ptr<CalibrationFile> declare_calibration()
  {
    auto calibration  = std::make_unique<CalibrationFile>();
    calibration->root = std::make_unique<Section>();
    declare(*calibration);
    return calibration;
  }

  std::unique_ptr<CalibrationFile> read_calibration(const std::string &file, const std::vector<std::string> &overrides)
  {
    std::unique_ptr<CalibrationFile> calibration = declare_calibration();
    calibration->file                            = file;
    calibration->output_folder                   = "output/" + std::filesystem::path(file).stem().string();
    std::vector<Assignment> assignments          = read_parameter_file(file);
    for (Assignment &assignment : read_overrides(overrides))
      assignments.push_back(std::move(assignment));
    assign(*calibration->root, assignments, file);
    validate_calibration(*calibration);
    return calibration;
  }
} // namespace apps
