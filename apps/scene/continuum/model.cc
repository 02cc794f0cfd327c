#include "apps/scene/continuum/model.h"

#include "apps/runs/continuum/upright.h"
#include "apps/scene/continuum/contact_section.h"
#include "apps/scene/continuum/loads.h"
#include "apps/scene/continuum/materials.h"
#include "apps/scene/continuum/mesh.h"
#include "apps/scene/entries/components.h"
#include "apps/scene/entries/contact_figures.h"
#include "apps/scene/entries/gravity.h"
#include "apps/scene/entries/precice.h"
#include "apps/scene/number_list.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, SolidSection &solid)
  {
    using Analysis   = SolidSection::Analysis;
    Section   &s     = root.section("Model", "What kind of solid is computed, and how");
    const auto plane = [&solid] { return solid.dimension == 2; };
    s.choice("Dimension", solid.dimension, {{"2", 2}, {"3", 3}}, Need::required).means("Of the model");
    s.choice("Analysis", solid.analysis, {{"static", Analysis::statics}, {"explicit", Analysis::dynamics}},
             Need::optional)
      .means("static: equilibrium step by step; explicit: motion by central differences");
    s.choice("Plane", solid.plane_stress, {{"strain", false}, {"stress", true}}, Need::optional)
      .means("Which state a plane model stands for")
      .only_if(plane, "Model/Dimension = 2");
    s.number("Thickness", solid.thickness, "m", Range::positive(), Need::optional)
      .means("Of a plane model")
      .only_if(plane, "Model/Dimension = 2");
    s.integer("Element order", solid.degree, "", Range::between(1, 2), Need::optional)
      .means("1: linear, 2: quadratic displacements");
    s.flag("Large displacement", solid.large_displacement)
      .means("Total Lagrangian, St. Venant-Kirchhoff; elastic materials only");
    s.flag("Mean dilatation", solid.mean_dilatation)
      .means("Volume change averaged over each element: no locking near Poisson ratio 0.5");
    s.flag("Remove rigid motion", solid.remove_rigid_motion)
      .means("Hold 3 (plane) or 6 displacements of corner nodes at zero, where loads balance by themselves");
  }

  void declare(Section &root, ControlSection &control, std::function<bool()> is_static)
  {
    using LinearSolver   = ControlSection::LinearSolver;
    using Follow         = ControlSection::Follow;
    const auto  indirect = [&control] { return control.follow == Follow::indirect; };
    const char *when     = "Control/Follow = indirect";
    Section    &s        = root.section("Control", "How a static analysis goes on");
    s.only_if(std::move(is_static), "Model/Analysis = static");
    s.choice("Follow", control.follow,
             {{"time", Follow::time}, {"indirect", Follow::indirect}, {"arc length", Follow::arc_length}},
             Need::optional)
      .means("time: loads and displacements follow their formulas (load and displacement control); indirect: the load "
             "factor t is found so that the opening between two points grows; arc length: so that the displacement "
             "vector does");
    s.number("End", control.end, "s or m", Range::positive(), Need::optional)
      .means("Time, with indirect the opening, with arc length the sum of lengths, at which the analysis ends");
    s.number("First step", control.first_step, "s or m", Range::at_least(0), Need::optional)
      .means("0: all of End where the solid is linear and its loads and displacements grow in proportion to time (or "
             "steadily from what they are at its start), End / 20 elsewhere");
    s.number("Largest step", control.largest_step, "s or m", Range::at_least(0), Need::optional)
      .means("0: the first step");
    s.number("Smallest step", control.smallest_step, "s or m", Range::at_least(0), Need::optional)
      .means("Where cutting ends; 0: 1e-6 of the first step");
    s.number("Growth", control.growth, "-", Range::at_least(1), Need::optional).means("Of the step after an easy one");
    s.integer("Easy iterations", control.easy_iterations, "", Range::between(1, 1000), Need::optional)
      .means("Up to which a step was easy");
    s.integer("Steps at most", control.most_steps, "", Range::between(1, 1e9), Need::optional).means("Accepted ones");
    s.number("Stop fraction", control.stop_fraction, "-", Range::from_up_to(0, 1), Need::optional)
      .means("The analysis ends when the vertical column of the curve has fallen to this part of its peak; 0: never");
    s.text("Opening from", control.opening_from, Need::required)
      .means("Name in section Points")
      .only_if(indirect, when);
    s.text("Opening to", control.opening_to, Need::required).means("Name in section Points").only_if(indirect, when);
    s.vector("Direction", control.direction, "-", {}, Need::optional)
      .means("In which the opening is measured; 0, 0, 0: from the first point to the second")
      .only_if(indirect, when);
    s.number("Tolerance", control.tolerance, "-", Range::between(1e-14, 1e-2), Need::optional)
      .means("Unbalanced force over the largest of load, internal force and reaction");
    s.integer("Iterations", control.iterations, "", Range::between(1, 1000), Need::optional)
      .means("Of Newton, per step");
    s.flag("Line search", control.line_search).means("Shorter Newton corrections where the full one makes it worse");
    s.flag("Relax", control.relax)
      .means("Where no equilibrium lies near, let the solid go like an overdamped body until it finds one; "
             "energy_damped in series.csv is what that dissipates. Off: the analysis ends there")
      .only_if([&control] { return control.follow == Follow::time; }, "Control/Follow = time");
    s.choice("Linear solver", control.linear_solver,
             {{"automatic", LinearSolver::automatic},
              {"direct", LinearSolver::direct},
              {"iterative", LinearSolver::iterative}},
             Need::optional)
      .means("automatic: direct (UMFPACK) for small models, algebraic multigrid for large ones");
    s.number("Linear tolerance", control.linear_tolerance, "-", Range::between(1e-15, 1e-3), Need::optional)
      .means("Of the iterative solver");
  }

  void declare(Section &root, MotionSection &motion, std::function<bool()> is_explicit)
  {
    Section &s = root.section("Motion", "How an explicit analysis goes on");
    s.only_if(std::move(is_explicit), "Model/Analysis = explicit");
    if (motion.ends_itself)
      s.number("End time", motion.end_time, "s", Range::positive(), Need::required).means("Of the motion");
    s.number("Damping", motion.damping, "1/s", Range::at_least(0), Need::optional)
      .means("alpha of the damping force alpha M v, which halves vibrations in 1.4/alpha");
    s.number("Safety", motion.safety, "-", {std::numeric_limits<double>::min(), 1.0, false}, Need::optional)
      .means("Time step over the critical step of the elements");
    declare_names(s, "Rigid bodies", motion.rigid, Need::optional)
      .means("Materials of bodies that move without deforming, separated by commas; of the material only the density "
             "counts, "
             "and its stiffness for the time step: take a soft one");
    declare_components(s, "Initial velocity", motion.initial_velocity, "m/s", "At the start; empty: at rest");
    by_place_alone(s, "Initial velocity");
  }

  void declare(Section &root, ContinuumOutputSection &continuum_output, std::function<bool()> is_explicit)
  {
    Section &s = root.section("Output", "What is written, and how often");
    s.integer("Samples", continuum_output.samples, "", Range::between(1, 1e9), Need::optional)
      .means("Rows of series.csv; a static analysis writes one per step")
      .only_if(std::move(is_explicit), "Model/Analysis = explicit")
      .housekeeping();
    s.integer("Snapshots", continuum_output.snapshots, "", Range::between(0, 1e6), Need::optional)
      .means("ParaView files on the way to the end, besides the first and the last state; 0: none at all")
      .housekeeping();
    s.number("Checkpoint interval", continuum_output.checkpoint_interval, "s", Range::positive(), Need::optional)
      .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
      .housekeeping();
    s.text("Curve horizontal", continuum_output.horizontal, Need::optional)
      .means("Column of series.csv for curve.png; empty: the opening, or the time")
      .housekeeping();
    s.text("Curve vertical", continuum_output.vertical, Need::optional)
      .means("Column of series.csv for curve.png; empty: the first reaction, or the energy")
      .housekeeping();
    s.flag("Fracture zone", continuum_output.fracture_zone)
      .means("Figure fracture_zone_width: how wide the zone is in which energy is dissipated after the vertical column "
             "has fallen to "
             "0.8 of its peak; takes as long as another evaluation of all points for each row");
  }

  void declare(Section &root, ContinuumModel &model)
  {
    declare_alone(root, model);
    declare(root, model.precice, "Boundary", "Whose nodes are the vertices of the mesh");
  }

  void declare_alone(Section &root, ContinuumModel &model)
  {
    const auto statics  = [&model] { return model.is_static(); };
    const auto dynamics = [&model] { return !model.is_static(); };
    declare(root, model.solid);
    declare(root, model.mesh, model.solid.dimension);
    declare(root, model.materials, dynamics);
    declare(root, model.loads);
    declare(root, model.control, statics);
    declare(root, model.motion, dynamics);
    declare(root, model.contacts, dynamics);
    declare(root, model.references);
    root.find_section("References")->only_if([&model] { return !model.contacts.empty(); }, "section Contacts is there");
    declare(root, model.output, dynamics);
  }

  void declare_as_part(Section &root, ContinuumModel &model)
  {
    model.solid.analysis     = SolidSection::Analysis::dynamics;
    model.motion.ends_itself = false;
    declare(root, model.solid);
    declare(root, model.mesh, model.solid.dimension);
    declare(
      root, model.materials, [] { return true; }, true);
    declare(root, model.loads);
    declare(root, model.motion, [] { return true; });
    declare(root, model.contacts, [] { return true; });
  }

  void declare_as_static_part(Section &root, ContinuumModel &model, std::function<bool()> weighs)
  {
    declare(root, model.solid);
    declare(root, model.mesh, model.solid.dimension);
    declare(root, model.materials, std::move(weighs), true);
    declare(root, model.loads);
  }
} // namespace apps
