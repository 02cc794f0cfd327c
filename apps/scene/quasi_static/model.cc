#include "apps/scene/quasi_static/model.h"

#include "apps/scene/entries/grips.h"
#include "apps/scene/entries/joints.h"
#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/path_steps.h"
#include "apps/scene/entries/physics.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/section.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    void declare_test(Section &loading, QuasiStaticModel &model, const UniaxialLoad load)
    {
      const bool              pulls   = load == UniaxialLoad::tension;
      QuasiStaticModel::Test &test    = pulls ? model.tension : model.compression;
      Section                &section = loading.section(pulls ? "Tension" : "Compression",
                                         pulls ? "The specimen is stretched" : "The specimen is shortened");
      section.only_if(
        [&model, load] { return std::find(model.tests.begin(), model.tests.end(), load) != model.tests.end(); },
        std::string("Loading/Tests has ") + name_of(load));
      section
        .number("Strain step", test.strain_step, "-", {std::numeric_limits<double>::min(), 1.0, true}, Need::optional)
        .means(
          "Largest step of the strain; halve it to see what it decides (and to lower the error of the energy balance)");
      section.number("Stop fraction", test.stop_fraction, "-", Range::from_up_to(0, 1), Need::optional)
        .means("The test ends when the stress has fallen to this part of its peak");
      section
        .number("Stop strain", test.stop_strain, "-", {std::numeric_limits<double>::min(), 1.0, true}, Need::optional)
        .means("The test ends at this strain at the latest");
    }

    void declare_loading(Section &root, QuasiStaticModel &model)
    {
      const auto gripped = [&model] { return !model.is_cell(); };
      Section   &section =
        root.section("Loading", "Uniaxial loading without inertia, each test from the undamaged state");
      section
        .choices("Tests", model.tests, {{"tension", UniaxialLoad::tension}, {"compression", UniaxialLoad::compression}},
                 Need::optional)
        .means("Tests to make, in this order");
      section.choice("Axis", model.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional).means("Direction of loading");
      declare(section, model.grips, gripped, "Specimen/Body = box");
      section.flag("Lateral motion blocked", model.lateral_blocked)
        .means("A specimen's grips hold their particles sideways, as rough platens do; of a cell all other strains are "
               "zero");
      section.flag("Grip rotation blocked", model.spin_blocked)
        .means("Grips keep their particles from spinning")
        .only_if(gripped, "Specimen/Body = box");
      section.flag("Grips turn", model.grips_turn)
        .means("Each grip turns about its middle, as a platen on a spherical seat; otherwise both stay parallel. Their "
               "particles are held sideways then")
        .only_if(gripped, "Specimen/Body = box");
      declare_test(section, model, UniaxialLoad::tension);
      declare_test(section, model, UniaxialLoad::compression);
    }
  } // namespace

  void declare(Section &root, QuasiStaticModel &model)
  {
    SpecimenSection::Use use;
    use.inertia    = false;
    use.cell       = true;
    use.genesis    = true;
    use.laboratory = true;
    declare(root, model.source, model.dimension, use);
    declare(*root.find_section("Specimen"), model.mix);
    declare(root, model.joints);
    declare(root, model.material, use.inertia);

    declare_static_physics(root, model.dimension, model.rotations);

    declare_loading(root, model);

    Section &solver = root.section("Solver", "How the equilibrium path is followed");
    declare_path_steps(solver, model.growth_step, model.tolerance, model.damping, "link forces");
    declare_path_solver(solver, model.linear_solver);

    Section &output = root.section("Output", "How often results are written");
    output.integer("Points per snapshot", model.snapshot_interval, "", Range::between(0, 1e6), Need::optional)
      .means("Points of the path from one pair of ParaView files to the next; 0: none at all")
      .housekeeping();
    output.number("Checkpoint interval", model.checkpoint_interval, "s", Range::positive(), Need::optional)
      .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
      .housekeeping();
  }
} // namespace apps
