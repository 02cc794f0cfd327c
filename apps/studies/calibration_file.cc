#include "apps/studies/calibration_file.h"

#include "apps/scene/overrides.h"
#include "apps/scene/parameter_file.h"
#include "apps/scene/reader.h"
#include "apps/text/same_name.h"
#include "apps/text/value_text.h"
#include "base/errors.h"

#include <filesystem>

namespace apps
{
  namespace
  {
    void declare_least_squares(CalibrationFile &calibration, Section &section)
    {
      section.number("Step", calibration.step, "-", Range::between(1e-8, 0.5), Need::optional)
        .means("Of differences, over the range of a constant: beyond the noise of the model");
      section.flag("Central differences", calibration.central_differences)
        .means("Twice the runs for a derivative, for smooth models");
      section.flag("Updated derivatives", calibration.updated_jacobian)
        .means("Derivatives are updated from step to step as long as that succeeds, which saves runs");
      section.integer("Most evaluations", calibration.most_runs, "", Range::between(2, 1000000), Need::optional)
        .means("Sets of constants that are run before it gives up");
      section.number("Smallest sum", calibration.smallest_relative_sum, "-", Range::between(0, 1), Need::optional)
        .means("Of squared deviations over squared targets: then it ends");
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

    void declare_sought_constants(CalibrationFile &calibration, Section &constants)
    {
      constants.named_sections("CONSTANT", [&calibration](Section &opened) {
        SoughtConstant &constant = calibration.constants.emplace_back();
        constant.name            = opened.name();
        const Range any;
        opened.text("Entry", constant.entries, Need::required)
          .means("Of the scenes, \"Material/CPM/Cohesion\"; several between commas get the same value");
        opened.number("Start", constant.start, "", any, Need::required).means("In the unit of the entry");
        opened.number("Lower", constant.lower, "", any, Need::required).means("Bound");
        opened.number("Upper", constant.upper, "", any, Need::required).means("Bound");
      });
    }

    void declare_targets(CalibrationFile &calibration, Section &targets)
    {
      targets.named_sections("TARGET", [&calibration](Section &opened) {
        CalibrationTarget &target = calibration.targets.emplace_back();
        target.name               = opened.name();
        opened.text("Scene", target.scene, Need::optional)
          .means("The test, where it is not the base scene; from the folder of this file");
        opened.text("Figure", target.figure, Need::optional)
          .means("Name among the figures of summary.json, \"compressive_strength\"");
        opened.number("Value", target.value, "", Range(), Need::optional).means("What was measured, in SI units");
        opened.file("Curve", target.curve)
          .means("Table of a measured curve, in place of a figure")
          .only_if([&target] { return target.figure.empty(); }, "there is no figure");
        opened.text("Abscissa", target.abscissa, Need::optional)
          .means("Column of the curve, and of the run's series.csv");
        opened.text("Ordinate", target.ordinate, Need::optional).means("Likewise");
        opened.text("Test", target.test, Need::optional)
          .means("Rows of series.csv by their column \"test\", \"compression\"");
        opened.number("Standard deviation", target.deviation, "", Range::at_least(0), Need::optional)
          .means("Of what was measured; 0: not known");
        opened.number("Weight", target.weight, "-", Range::between(1e-6, 1e6), Need::optional)
          .means("Of its squares, where standard deviations are not known");
      });
    }

    void declare_calibration(CalibrationFile &calibration)
    {
      Section &root = *calibration.root;
      root.text("Kind", calibration.kind, Need::required).means("calibration");
      root.file("Base scene", calibration.base_scene).means("The test whose constants are sought");
      root.text("Output folder", calibration.output_folder, Need::optional)
        .means("Where results go (option -o)")
        .housekeeping();
      root.integer("Threads per run", calibration.threads_per_run, "", Range::between(1, 1024), Need::optional)
        .means("As many runs go on at a time as there are processors for")
        .housekeeping();
      declare_least_squares(calibration, root.section("Search", "Least squares"));
      declare_replicates(calibration, root.section("Replicates", "Several packings"));
      declare_sought_constants(calibration, root.section("Constants", "What is sought"));
      declare_targets(calibration, root.section("Targets", "What was measured"));
    }

    void validate_target(CalibrationFile &calibration, CalibrationTarget &target)
    {
      const Section &section = *calibration.root->find_section("Targets")->find_section(target.name);
      target.scene           = target.scene.empty() ?
                                 calibration.base_scene :
                                 (std::filesystem::path(calibration.file).parent_path() / target.scene).string();
      if (!target.is_curve() && target.value == 0)
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
        }
      for (CalibrationTarget &target : calibration.targets)
        validate_target(calibration, target);
      if (calibration.seed_entry.empty() != calibration.seeds_text.empty())
        calibration.root->find_section("Replicates")->refuse("Seeds", "wanted with Entry, and only with it.");
    }
  } // namespace

  std::unique_ptr<CalibrationFile> read_calibration(const std::string &file, const std::vector<std::string> &overrides)
  {
    auto calibration           = std::make_unique<CalibrationFile>();
    calibration->file          = file;
    calibration->output_folder = "output/" + std::filesystem::path(file).stem().string();
    calibration->root          = std::make_unique<Section>();
    declare_calibration(*calibration);
    std::vector<Assignment> assignments = read_parameter_file(file);
    for (Assignment &assignment : read_overrides(overrides))
      assignments.push_back(std::move(assignment));
    assign(*calibration->root, assignments, file);
    validate_calibration(*calibration);
    return calibration;
  }
} // namespace apps
