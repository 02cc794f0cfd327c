#include "apps/scene/structure/model.h"

#include "apps/scene/continuum/model.h"
#include "apps/scene/coupled/handshakes.h"
#include "apps/scene/entries/gravity.h"
#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/path_steps.h"
#include "apps/scene/entries/physics.h"
#include "apps/scene/entries/region.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"
#include "apps/scene/structure/probes.h"
#include "apps/scene/structure/supports.h"

namespace apps
{
  namespace
  {
    void declare_output(Section &root, StructureModel &model)
    {
      Section &output = root.section("Output", "How often results are written");
      output.integer("Points per snapshot", model.snapshot_interval, "", Range::between(0, 1e6), Need::optional)
        .means("Points of the path from one set of ParaView files to the next; 0: none at all")
        .housekeeping();
      output.number("Checkpoint interval", model.checkpoint_interval, "s", Range::positive(), Need::optional)
        .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
        .housekeeping();
      output.text("Curve horizontal", model.horizontal, Need::optional)
        .means("Column of series.csv for curve.png; empty: the first probe, or the load factor")
        .housekeeping();
      output.text("Curve vertical", model.vertical, Need::optional)
        .means("Column of series.csv for curve.png; empty: the first reaction, or the force of the load factor")
        .housekeeping();
    }
  } // namespace

  void declare(Section &root, PathSection &path)
  {
    Section &s = root.section("Path", "How the load factor t follows the equilibria, along which it may fall");
    s.number("End", path.end, "-", Range::positive(), Need::required)
      .means("Load factor at which the path ends at the latest");
    s.number("Step", path.step, "-", Range::positive(), Need::required)
      .means("Largest step of the load factor; halve it to see what it decides (and to lower the error of the energy "
             "balance)");
    s.number("Stop fraction", path.stop_fraction, "-", Range::from_up_to(0, 1), Need::optional)
      .means("The path ends when the force of the load factor has fallen to this part of its peak; 0: never");
    s.text("Opening", path.leading, Need::optional)
      .means("Name of a probe that grows from point to point in equal steps while load and load factor follow, up or "
             "down, as the opening of a notch does in a test that it controls; empty: the load factor, and where "
             "damage is fast "
             "the largest growth of a link");
    const Condition led{[&path] { return !path.leading.empty(); }, "there is an Opening"};
    s.number("Opening step", path.opening_step, "m", Range::positive(), Need::required)
      .only_if(led)
      .means("From one point to the next; where no equilibrium is found so far, there are points between");
    s.number("End opening", path.end_opening, "m", Range::positive(), Need::required)
      .only_if(led)
      .means("At which the path ends at the latest; as the steps, from where the weight is on");
    declare_path_steps(s, path.growth_step, path.tolerance, path.damping, "forces of links and solid");
    declare_path_solver(s, path.solver);
  }

  void declare(Section &root, BendingTestSection &test, const Condition &heavy)
  {
    Section &s = root.section(
      "Bending test",
      "Dimensions of a notched beam on two supports, loaded at mid-span, by which its load and its work become "
      "figures of the material; the load is Output/Curve vertical");
    const Condition evaluated{[&test] { return test.evaluate(); }, "Span > 0"};
    s.number("Span", test.span, "m", Range::at_least(0), Need::optional)
      .means("Between the supports; 0: nothing of this is evaluated");
    s.number("Depth", test.depth, "m", Range::positive(), Need::required)
      .only_if(evaluated)
      .means("Of the beam, along the load");
    s.number("Width", test.width, "m", Range::positive(), Need::required)
      .only_if(evaluated)
      .means("Of the beam, across the plane of bending");
    s.number("Notch depth", test.notch, "m", Range::at_least(0), Need::optional)
      .only_if(evaluated)
      .means("What it takes from Depth; figures are nominal strength 3 F S / (2 b (d - a)^2), and work over ligament b "
             "(d - a)");
    s.number("Length", test.length, "m", Range::positive(), Need::required)
      .only_if([&test, heavy] { return test.evaluate() && heavy.holds(); }, "Span > 0 and " + heavy.words)
      .means(
        "Of the whole beam: of its weight, Span over Length is between the supports, m g, and works beside the load "
        "along the deflection d_0 to the end; the work over the ligament is then (W_0 + m g d_0)/(b (d - a)) (RILEM TC "
        "50-FMC)");
  }

  void declare(Section &root, WedgeSplittingSection &test)
  {
    Section &s = root.section(
      "Wedge splitting",
      "Dimensions of a notched specimen whose groove a wedge drives apart, by which the splitting force and its "
      "work become figures of the material; the splitting force, of one side, is Output/Curve vertical");
    const Condition evaluated{[&test] { return test.evaluate(); }, "Ligament depth > 0"};
    s.number("Ligament depth", test.ligament_depth, "m", Range::at_least(0), Need::optional)
      .means("From the tip of the notch to the face beyond; 0: nothing of this is evaluated");
    s.number("Width", test.width, "m", Range::positive(), Need::required)
      .only_if(evaluated)
      .means("Of the specimen, across the plane of splitting");
    s.number("Arm", test.arm, "m", Range::at_least(0), Need::optional)
      .only_if(evaluated)
      .means(
        "From the line of the splitting force to the tip of the notch, c in the nominal strength F/(b h) (4 + 6 c/h)");
    s.number("Wedge angle", test.angle, "degrees", Range::between(1, 120), Need::optional)
      .only_if(evaluated)
      .means("Between the faces of the wedge: the machine's force is 2 F (tan(a/2) + mu)/(1 - mu tan(a/2))");
    s.number("Friction coefficient", test.friction, "-", Range::at_least(0), Need::optional)
      .only_if(evaluated)
      .means("mu, of the wedge on its rollers");
  }

  void declare(Section &root, StructureModel &model)
  {
    SpecimenSection::Use use;
    use.inertia = false;
    use.genesis = true;
    declare(root, model.source, model.dimension, use);
    declare(*root.find_section("Specimen"), model.mix);
    const Condition heavy{[&model] { return model.gravity.acts(); }, "Gravity/Acceleration is not 0"};
    root.find_section("Specimen")
      ->number("Density", model.source.density, "kg/m^3", Range::positive(), Need::required)
      .only_if(heavy)
      .means("Of the particles, not of the bulk: bulk density over packing fraction");
    declare(root, model.material, true);
    declare_static_physics(root, model.dimension, model.rotations);
    root
      .section("Voids", "One sub-section per place without particles, as a notch is: particles whose centre lies in it "
                        "are left out, and links whose line between centres crosses it")
      .named_list("VOID", model.voids, &VoidSection::name,
                  [](Section &opened, VoidSection &added) { declare(opened, added.region); });
    declare(root, model.groups);
    declare(root, model.supports);
    Section &solid = root.section(
      "Continuum", "The solid around the particles, linear elastic; sections of a scene of kind continuum, "
                   "its loads and displacements in proportion to t");
    solid.only_if([&model] { return model.has_solid(); }, "section Handshakes is there");
    declare_as_static_part(solid, model.continuum, [&model] { return model.gravity.acts(); });
    declare(root, model.handshakes, model.continuum, false);
    declare_dead_weight(root, model.gravity,
                        "Weight of everything, particles and solid; it is put on before anything is driven, and stays");
    declare(root, model.path);
    declare(root, model.bending_test, heavy);
    declare(root, model.wedge_splitting);
    declare(root, model.probes);
    declare_output(root, model);
  }
} // namespace apps
