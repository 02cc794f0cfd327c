#include "apps/drivers/continuum/model.h"

#include "apps/drivers/continuum/cells.h"
#include "apps/drivers/continuum/upright.h"
#include "apps/scene/nearest_name.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    void refuse_moving_cells(const base::EntryPath &root, const MaterialsSection &materials)
    {
      for (const auto &group : materials.groups)
        if (const CellsConstants *cells = group->cells())
          cells->refuse_motion(root.at("Materials").at(group->group).at(group->law->name()));
    }
  } // namespace

  void SolidSection::declare(Section &root)
  {
    Section   &s     = root.section("Model", "What kind of solid is computed, and how");
    const auto plane = [this] { return dimension == 2; };
    s.choice("Dimension", dimension, {{"2", 2}, {"3", 3}}, Need::required).means("Of the model");
    s.choice("Analysis", analysis, {{"static", Analysis::statics}, {"explicit", Analysis::dynamics}}, Need::optional)
      .means("static: equilibrium step by step; explicit: motion by central differences");
    s.choice("Plane", plane_stress, {{"strain", false}, {"stress", true}}, Need::optional)
      .means("Which state a plane model stands for")
      .only_if(plane, "Model/Dimension = 2");
    s.number("Thickness", thickness, "m", Range::positive(), Need::optional)
      .means("Of a plane model")
      .only_if(plane, "Model/Dimension = 2");
    s.integer("Element order", degree, "", Range::between(1, 2), Need::optional)
      .means("1: linear, 2: quadratic displacements");
    s.flag("Large displacement", large_displacement)
      .means("Total Lagrangian, St. Venant-Kirchhoff; elastic materials only");
    s.flag("Mean dilatation", mean_dilatation)
      .means("Volume change averaged over each element: no locking near Poisson ratio 0.5");
    s.flag("Remove rigid motion", remove_rigid_motion)
      .means("Hold 3 (plane) or 6 displacements of corner nodes at zero, where loads balance by themselves");
  }

  void ControlSection::declare(Section &root, std::function<bool()> is_static)
  {
    const auto  indirect = [this] { return follow == Follow::indirect; };
    const char *when     = "Control/Follow = indirect";
    Section    &s        = root.section("Control", "How a static analysis goes on");
    s.only_if(std::move(is_static), "Model/Analysis = static");
    s.choice("Follow", follow,
             {{"time", Follow::time}, {"indirect", Follow::indirect}, {"arc length", Follow::arc_length}},
             Need::optional)
      .means("time: loads and displacements follow their formulas (load and displacement control); indirect: the load "
             "factor t is found so that the opening between two points grows; arc length: so that the displacement "
             "vector does");
    s.number("End", end, "s or m", Range::positive(), Need::optional)
      .means("Time, with indirect the opening, with arc length the sum of lengths, at which the analysis ends");
    s.number("First step", first_step, "s or m", Range::at_least(0), Need::optional)
      .means("0: all of End where the solid is linear and its loads and displacements grow in proportion to time (or "
             "steadily from what they are at its start), End / 20 elsewhere");
    s.number("Largest step", largest_step, "s or m", Range::at_least(0), Need::optional).means("0: the first step");
    s.number("Smallest step", smallest_step, "s or m", Range::at_least(0), Need::optional)
      .means("Where cutting ends; 0: 1e-6 of the first step");
    s.number("Growth", growth, "-", Range::at_least(1), Need::optional).means("Of the step after an easy one");
    s.integer("Easy iterations", easy_iterations, "", Range::between(1, 1000), Need::optional)
      .means("Up to which a step was easy");
    s.integer("Steps at most", most_steps, "", Range::between(1, 1e9), Need::optional).means("Accepted ones");
    s.number("Stop fraction", stop_fraction, "-", Range::from_up_to(0, 1), Need::optional)
      .means("The analysis ends when the vertical column of the curve has fallen to this part of its peak; 0: never");
    s.text("Opening from", opening_from, Need::required).means("Name in section Points").only_if(indirect, when);
    s.text("Opening to", opening_to, Need::required).means("Name in section Points").only_if(indirect, when);
    s.vector("Direction", direction, "-", {}, Need::optional)
      .means("In which the opening is measured; 0, 0, 0: from the first point to the second")
      .only_if(indirect, when);
    s.number("Tolerance", tolerance, "-", Range::between(1e-14, 1e-2), Need::optional)
      .means("Unbalanced force over the largest of load, internal force and reaction");
    s.integer("Iterations", iterations, "", Range::between(1, 1000), Need::optional).means("Of Newton, per step");
    s.flag("Line search", line_search).means("Shorter Newton corrections where the full one makes it worse");
    s.flag("Relax", relax)
      .means("Where no equilibrium lies near, let the solid go like an overdamped body until it finds one; "
             "energy_damped in series.csv is what that dissipates. Off: the analysis ends there")
      .only_if([this] { return follow == Follow::time; }, "Control/Follow = time");
    s.choice("Linear solver", linear_solver,
             {{"automatic", LinearSolver::automatic},
              {"direct", LinearSolver::direct},
              {"iterative", LinearSolver::iterative}},
             Need::optional)
      .means("automatic: direct (UMFPACK) for small models, algebraic multigrid for large ones");
    s.number("Linear tolerance", linear_tolerance, "-", Range::between(1e-15, 1e-3), Need::optional)
      .means("Of the iterative solver");
  }

  void ControlSection::check(const base::EntryPath &root, const std::vector<std::string> &points) const
  {
    const base::EntryPath s = root.at("Control");
    if (smallest() > first() || first() > largest() * (1 + 1e-12))
      s.refuse("First step", "it must lie between the smallest and the largest step.");
    if (relax && follow != Follow::time)
      s.refuse("Relax", "goes with Control/Follow = time: path control follows the load down by itself.");
    if (follow != Follow::indirect)
      return;
    for (const char *entry : {"Opening from", "Opening to"})
      {
        const std::string &name = entry == std::string("Opening from") ? opening_from : opening_to;
        if (std::find(points.begin(), points.end(), name) == points.end())
          s.refuse(entry,
                   "there is no such point. " +
                     (points.empty() ? "Give its place: subsection Points/" + name + "." : did_you_mean(name, points)));
      }
    if (opening_from == opening_to)
      s.refuse("Opening to", "is the same point as Opening from.");
  }

  void MotionSection::declare(Section &root, std::function<bool()> is_explicit)
  {
    Section &s = root.section("Motion", "How an explicit analysis goes on");
    s.only_if(std::move(is_explicit), "Model/Analysis = explicit");
    if (ends_itself)
      s.number("End time", end_time, "s", Range::positive(), Need::required).means("Of the motion");
    s.number("Damping", damping, "1/s", Range::at_least(0), Need::optional)
      .means("alpha of the damping force alpha M v, which halves vibrations in 1.4/alpha");
    s.number("Safety", safety, "-", {std::numeric_limits<double>::min(), 1.0, false}, Need::optional)
      .means("Time step over the critical step of the elements");
    s.text("Rigid bodies", rigid, Need::optional)
      .means("Materials of bodies that move without deforming, separated by commas; of the material only the density "
             "counts, "
             "and its stiffness for the time step: take a soft one");
    for (int i = 0; i < 3; ++i)
      s.expression(std::string("Initial velocity ") + "xyz"[i], initial_velocity[static_cast<std::size_t>(i)], "m/s")
        .means("At the start; empty: at rest");
  }

  void ContinuumOutputSection::declare(Section &root, std::function<bool()> is_explicit)
  {
    Section &s = root.section("Output", "What is written, and how often");
    s.integer("Samples", samples, "", Range::between(1, 1e9), Need::optional)
      .means("Rows of series.csv; a static analysis writes one per step")
      .only_if(std::move(is_explicit), "Model/Analysis = explicit")
      .housekeeping();
    s.integer("Snapshots", snapshots, "", Range::between(0, 1e6), Need::optional)
      .means("ParaView files on the way to the end, besides the first and the last state; 0: none at all")
      .housekeeping();
    s.number("Checkpoint interval", checkpoint_interval, "s", Range::positive(), Need::optional)
      .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
      .housekeeping();
    s.text("Curve horizontal", horizontal, Need::optional)
      .means("Column of series.csv for curve.png; empty: the opening, or the time")
      .housekeeping();
    s.text("Curve vertical", vertical, Need::optional)
      .means("Column of series.csv for curve.png; empty: the first reaction, or the energy")
      .housekeeping();
  }

  void ContinuumModel::declare(Section &root)
  {
    const auto statics  = [this] { return is_static(); };
    const auto dynamics = [this] { return !is_static(); };
    solid.declare(root);
    mesh.declare(root, solid.dimension);
    materials.declare(root, dynamics);
    loads.declare(root);
    control.declare(root, statics);
    motion.declare(root, dynamics);
    contacts.declare(root, dynamics);
    references.declare(root);
    root.find_section("References")->only_if([this] { return !contacts.empty(); }, "section Contacts is there");
    output.declare(root, dynamics);
  }

  void ContinuumModel::declare_as_part(Section &root)
  {
    solid.analysis     = SolidSection::Analysis::dynamics;
    motion.ends_itself = false;
    solid.declare(root);
    mesh.declare(root, solid.dimension);
    materials.declare(
      root, [] { return true; }, true);
    loads.declare(root);
    motion.declare(root, [] { return true; });
    contacts.declare(root, [] { return true; });
  }

  void ContinuumModel::declare_as_static_part(Section &root)
  {
    solid.declare(root);
    mesh.declare(root, solid.dimension);
    materials.declare(
      root, [] { return false; }, true);
    loads.declare(root);
  }

  void ContinuumModel::check(const base::EntryPath &root) const
  {
    check_as_part(root);
    std::vector<std::string> points;
    for (const auto &point : loads.points)
      points.push_back(point->name);
    if (is_static())
      control.check(root, points);
  }

  void ContinuumModel::check_as_part(const base::EntryPath &root) const
  {
    const base::EntryPath s = root.at("Model");
    if (solid.large_displacement && solid.mean_dilatation)
      s.refuse("Mean dilatation", "is a small-strain form. Switch it off with large displacements.");
    if (!motion.rigid.empty() && !solid.large_displacement)
      root.at("Motion").refuse("Rigid bodies", "they turn: Model/Large displacement = true goes with them.");
    mesh.check(root, solid.dimension);
    materials.check(root, solid.large_displacement);
    if (is_static())
      refuse_moving_cells(root, materials);
    loads.check(root, solid.dimension);
    require_upright_names(*this, body_force_at_once(*this));
    contacts.check(root, !is_static());
  }

  void ContinuumModel::check_as_static_part(const base::EntryPath &root) const
  {
    const base::EntryPath s = root.at("Model");
    if (!is_static())
      s.refuse("Analysis", "nothing moves in time here: static.");
    if (solid.large_displacement)
      s.refuse("Large displacement", "the solid around particles in equilibrium is linear. Switch it off.");
    mesh.check(root, solid.dimension);
    materials.check(root, solid.large_displacement);
    refuse_moving_cells(root, materials);
    loads.check(root, solid.dimension);
    require_upright_names(*this, body_force_at_once(*this));
  }

  MPI_Comm ContinuumModel::ranks_of_mesh() const
  {
    return std::any_of(materials.groups.begin(), materials.groups.end(),
                       [](const auto &group) { return group->cells() != nullptr; }) ?
             MPI_COMM_SELF :
             MPI_COMM_WORLD;
  }
} // namespace apps
