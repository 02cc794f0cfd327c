#include "apps/drivers/quasi_static/scene.h"

#include "apps/drivers/quasi_static/report.h"
#include "apps/figures/lab_run.h"
#include "apps/forecasts/duration.h"
#include "apps/forecasts/path_forecast.h"
#include "apps/scene/tension_beyond_apex.h"
#include "apps/specimens/packing_extents.h"
#include "apps/specimens/specimen_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  dem::Packing QuasiStaticModel::packing() const { return make_packing(source, material, dimension); }

  dem::QuasiStaticParameters QuasiStaticModel::steps(const UniaxialLoad load) const
  {
    const Test                &test = load == UniaxialLoad::tension ? tension : compression;
    dem::QuasiStaticParameters p;
    p.sign               = load == UniaxialLoad::tension ? 1 : -1;
    p.strain_step        = test.strain_step;
    p.end_strain         = test.stop_strain;
    p.end_stress         = test.stop_fraction;
    p.growth_step        = growth_step;
    p.tolerance          = tolerance;
    p.relaxation.damping = damping;
    return p;
  }

  dem::GripLayers QuasiStaticModel::grip_layers(const dem::Packing &packing) const
  {
    dem::check_packing(packing, "packing");
    return dem::find_grip_layers({packing.centre, packing.radius, dimension, source.thickness}, axis,
                                 grips.parameters());
  }

  dem::LoadedNetwork QuasiStaticModel::load(const dem::Packing &packing) const
  {
    dem::NetworkParameters links;
    links.dimension         = dimension;
    links.rotations         = rotations;
    links.interaction_ratio = source.interaction_ratio;
    links.installation_gap  = source.installation_gap;
    links.thickness         = source.thickness;
    if (is_cell())
      return dem::load_cell(dem::make_network(packing, links, material.materials()), axis, !lateral_blocked);
    dem::GripPair pair;
    pair.axis            = axis;
    pair.lateral_blocked = lateral_blocked;
    pair.spin_blocked    = spin_blocked;
    pair.layers          = grip_layers(packing);
    dem::Packing free    = packing;
    free.periodic_cell.reset();
    return dem::load_grips(dem::make_network(free, links, material.materials()), pair);
  }

  void QuasiStaticScene::declare(Section &root)
  {
    SpecimenSection::Use use;
    use.inertia = false;
    use.cell    = true;
    asked.source.declare(root, asked.dimension, use);
    asked.material.declare(root, use.inertia);

    Section &physics = root.section("Physics", "What is modelled");
    physics.choice("Dimension", asked.dimension, {{"2", 2}, {"3", 3}}, Need::optional)
      .means("3: spheres in space; 2: discs in the plane z = 0");
    physics.flag("Rotations", asked.rotations).means("Particles spin; off: they only translate");

    declare_loading(root);

    Section &solver = root.section("Solver", "How the equilibrium path is followed");
    solver.number("Growth step", asked.growth_step, "-", Range::between(1e-4, 1), Need::optional)
      .means("Largest growth of any link's damaging strain in a step, over itself; it controls the steps where damage "
             "is fast");
    solver.number("Tolerance", asked.tolerance, "-", Range::between(1e-13, 1e-2), Need::optional)
      .means("Unbalanced force over link forces, both as root of the sum of squares");
    solver.number("Damping", asked.damping, "-", Range::from_up_to(0.01, 1), Need::optional)
      .means("Local (Cundall) damping where cracks run away and dynamics looks for the next equilibrium");

    Section &output = root.section("Output", "How often results are written");
    output.integer("Points per snapshot", asked.snapshot_interval, "", Range::between(0, 1e6), Need::optional)
      .means("Points of the path from one pair of ParaView files to the next; 0: none at all")
      .housekeeping();
    output.number("Checkpoint interval", asked.checkpoint_interval, "s", Range::positive(), Need::optional)
      .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
      .housekeeping();
  }

  void QuasiStaticScene::declare_loading(Section &root)
  {
    const auto gripped = [this] { return !asked.is_cell(); };
    Section &section = root.section("Loading", "Uniaxial loading without inertia, each test from the undamaged state");
    section
      .choices("Tests", asked.tests, {{"tension", UniaxialLoad::tension}, {"compression", UniaxialLoad::compression}},
               Need::optional)
      .means("Tests to make, in this order");
    section.choice("Axis", asked.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional).means("Direction of loading");
    asked.grips.declare(section, gripped, "Specimen/Body = box");
    section.flag("Lateral motion blocked", asked.lateral_blocked)
      .means(
        "A specimen's grips hold their particles sideways, as rough platens do; of a cell all other strains are zero");
    section.flag("Grip rotation blocked", asked.spin_blocked)
      .means("Grips keep their particles from spinning")
      .only_if(gripped, "Specimen/Body = box");
    declare_test(section, UniaxialLoad::tension);
    declare_test(section, UniaxialLoad::compression);
  }

  void QuasiStaticScene::declare_test(Section &loading, const UniaxialLoad load)
  {
    const bool              pulls   = load == UniaxialLoad::tension;
    QuasiStaticModel::Test &test    = pulls ? asked.tension : asked.compression;
    Section                &section = loading.section(pulls ? "Tension" : "Compression",
                                       pulls ? "The specimen is stretched" : "The specimen is shortened");
    section.only_if(
      [this, load] { return std::find(asked.tests.begin(), asked.tests.end(), load) != asked.tests.end(); },
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

  void QuasiStaticScene::check() const
  {
    const base::EntryPath root;
    asked.source.check(root, asked.dimension);
    asked.material.check(root, asked.dimension);
    const base::EntryPath loading = root.at("Loading");
    if (asked.dimension == 2 && asked.axis == 2)
      loading.refuse("Axis", "in two dimensions the specimen lies in the plane z = 0. Load it along x or y.");
    if (!asked.is_cell())
      asked.grips.check(loading);
    for (const UniaxialLoad load : asked.tests)
      if (const auto steps = asked.steps(load); steps.end_strain < steps.strain_step)
        loading.at(load == UniaxialLoad::tension ? "Tension" : "Compression")
          .refuse("Stop strain", "must not be below the strain step.");
  }

  std::string QuasiStaticScene::forecast() const
  {
    const base::Stopwatch   set_up;
    const QuasiStaticModel &model          = asked;
    const dem::Packing      packing        = model.packing();
    const auto              loaded         = model.load(packing);
    const double            set_up_seconds = set_up.seconds();
    std::string             text;
    text += fmt::format("  particles    {}\n", loaded.network.particles());
    text += fmt::format("  links        {}\n", loaded.network.links.size());
    text += extent_lines(packing, loaded.network.dimension);
    text += lines_of_tension_beyond_apex(model.material);
    text += materials_in(loaded.network, packing.material_names).text();
    if (!model.is_cell())
      text += fmt::format("  basis        {}\n", text_of(model.grip_layers(packing), model.grips.parameters()));
    double seconds = 0;
    for (const UniaxialLoad load : model.tests)
      {
        text += fmt::format("  {:<12} at least {:.0f} points to its stop strain\n", name_of(load),
                            model.steps(load).end_strain / model.steps(load).strain_step);
        seconds += set_up_seconds + expected_path_seconds(loaded, model.material.materials(), model.steps(load));
      }
    return text + duration_line(seconds);
  }

  RunResult QuasiStaticScene::run(const RunRequest &request) const
  {
    return LabRun<QuasiStaticLabTest>(request, asked).execute();
  }
} // namespace apps
