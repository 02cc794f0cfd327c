#include "apps/scene/peridynamics/model.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/entries/material_region.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/output.h"
#include "apps/scene/entries/region.h"
#include "apps/scene/number_list.h"
#include "apps/scene/peridynamics/loads.h"
#include "apps/scene/peridynamics/materials.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    void declare_body(Section &root, PeridynamicsModel &model)
    {
      Section &body = root.section("Body", "A rod, plate or block, centred at the origin");
      declare_numbers(body, "Size", model.size, "m", "one to three lengths > 0", Need::required)
        .means("Lengths along x, y and z between commas: one of a rod, two of a plate, three of a block");
      body.number("Thickness", model.thickness, "m", Range::at_least(0), Need::optional)
        .means("Of a plate; of a rod its width and height; 0: the spacing of nodes");
      body
        .choice("Plane", model.plane, {{"stress", pd::Space::plane_stress}, {"strain", pd::Space::plane_strain}},
                Need::optional)
        .means("Of a plate: free to change its thickness, or not");
      Section &mix = declare_geometry(body, model.materials.mix, "nodes that lie in an aggregate");
      declare_factors(
        mix, "Aggregates",
        "Of bonds within an aggregate, where section Material is that of the mortar: the critical stretch "
        "is that of the mortar times strength over stiffness factor",
        model.materials.mix.aggregates, false);
      declare_factors(mix, "Interface", "Likewise of bonds with one end in an aggregate, or both in different ones",
                      model.materials.mix.interface, false);
      Section &grid = root.section("Grid", "Nodes");
      grid.number("Spacing", model.spacing, "m", Range::positive(), Need::required)
        .means("Between nodes; divides every length of the body");
      grid
        .choice("Layout", model.layout,
                {{"cell-centred", pd::Layout::cell_centred}, {"boundary nodes", pd::Layout::boundary_nodes}},
                Need::optional)
        .means("Nodes in the middle of cells, or on the boundary too with a half of a cell there");
      Section &reach = root.section("Horizon", "How far bonds reach");
      reach.number("Ratio", model.horizon.ratio, "-", Range::between(1, 100), Need::optional)
        .means("Of the horizon to the spacing");
      reach
        .choice("Volumes", model.horizon.volumes, {{"full", pd::Volumes::full}, {"partial", pd::Volumes::partial}},
                Need::optional)
        .means("Of nodes at the edge of the horizon: counted whole, or in part");
      reach.flag("Surface correction", model.horizon.surface_correction)
        .means("Bonds of nodes whose family the surface cuts are made stiffer by the volume that it lacks");
    }

    void declare_defects(Section &root, PeridynamicsModel &model)
    {
      root.section("Holes", "One sub-section per round hole")
        .named_list("HOLE", model.holes, &PeridynamicHole::name, [](Section &opened, PeridynamicHole &added) {
          declare_numbers(opened, "Centre", added.centre, "m", "coordinates", Need::required)
            .means("Of the circle; in space of the cylinder along z");
          opened.number("Radius", added.radius, "m", Range::positive(), Need::required).means("Of the hole");
        });
      root.section("Cracks", "One sub-section per crack: bonds that cross it are broken from the start")
        .named_list("CRACK", model.cracks, &PeridynamicCrack::name, [](Section &opened, PeridynamicCrack &added) {
          declare_numbers(opened, "From", added.from, "m", "coordinates", Need::required)
            .means("One end of the segment; in space a corner of a parallelogram");
          declare_numbers(opened, "To", added.to, "m", "coordinates", Need::required)
            .means("The other end; in space of one edge");
          declare_numbers(opened, "Depth", added.depth, "m", "coordinates", Need::optional)
            .means("In space: the other edge, as a vector");
        });
      root.section("No-fail zones", "One sub-section per region whose nodes have bonds that never break")
        .named_list("ZONE", model.safe, &NoFailZone::name,
                    [](Section &opened, NoFailZone &added) { declare(opened, added.region); });
    }

    void declare_kinematics(Section &s, PeridynamicAnalysisSection &analysis)
    {
      s.choice("Kinematics", analysis.kinematics,
               {{"linear", pd::Kinematics::linear}, {"nonlinear", pd::Kinematics::nonlinear}}, Need::optional)
        .means("nonlinear: stretch and direction of the deformed bonds, and tractions that turn with the body's nodes");
    }

    void declare_steps(Section &s, PeridynamicAnalysisSection &analysis)
    {
      s.number("Step factor", analysis.step_factor, "-", Range::between(1e-6, 1), Need::optional)
        .means("Of the stable step of the undamaged body, which Gershgorin's bound gives");
      s.number("Repulsion", analysis.repulsion, "-", Range::at_least(0), Need::optional)
        .means("Of nodes that no bond joins any more and that come nearer than a spacing, in bond constants; 15 is "
               "usual, and shortens the stable step; 0: fragments pass through each other");
    }
  } // namespace

  void declare(Section &root, PeridynamicAnalysisSection &analysis)
  {
    using Method   = PeridynamicAnalysisSection::Method;
    using Breakage = PeridynamicAnalysisSection::Breakage;
    Section &s     = root.section("Analysis", "How the body is brought to rest, or moves");
    s.choice("Method", analysis.method,
             {{"relaxation", Method::relaxation}, {"static", Method::statics}, {"motion", Method::motion}},
             Need::optional)
      .means(
        "static: equilibria by sparse factors; relaxation: by adaptive dynamic relaxation; motion: explicit, in time");
    declare_kinematics(s, analysis);
    s.choice("Solver", analysis.solver, {{"direct", pd::Solver::direct}, {"iterative", pd::Solver::iterative}},
             Need::optional)
      .means("Of static: a sparse Cholesky factor, or conjugate gradients alone, which need less memory");
    s.integer("Load increments", analysis.increments, "", Range::between(1, 1e6), Need::optional)
      .means("Steps in which the load factor grows to 1 where bonds may break");
    s.choice("Breakage", analysis.breakage,
             {{"between equilibria", Breakage::between}, {"every step", Breakage::steps}}, Need::optional)
      .means(
        "When bonds break that are stretched to their limit: at rest, or in every step of the relaxation as published");
    s.number("Break from", analysis.at_once, "-", Range::between(0, 1), Need::optional)
      .means("Of bonds beyond their limit, at rest, those break together whose stretch is at least this part of the "
             "largest; 0: all");
    s.choice("Fictitious density", analysis.density,
             {{"gershgorin", pd::FictitiousDensity::gershgorin}, {"constant", pd::FictitiousDensity::constant}},
             Need::optional)
      .means("Of the relaxation: the least that is stable, node by node, or that of the published example programs");
    s.number("Tolerance", analysis.tolerance, "-", Range::between(1e-13, 1e-2), Need::optional)
      .means("Forces out of balance over loads or reactions, at rest");
    s.integer("Step limit", analysis.step_limit, "", Range::between(1, 1e9), Need::optional)
      .means("Steps of the relaxation at most from one state at rest to the next");
    s.integer("Steps per row", analysis.row_interval, "", Range::between(1, 1e9), Need::optional)
      .means("Steps of the relaxation from one row of series.csv to the next");
    const Condition moves{[&analysis] { return !analysis.quiet(); }, "Method is motion"};
    s.number("End time", analysis.end_time, "s", Range::positive(), Need::required)
      .only_if(moves)
      .means("Of the motion");
    declare_steps(s, analysis);
    s.find_entry("Repulsion")->only_if(moves);
  }

  void declare(Section &root, PeridynamicsModel &model)
  {
    declare_body(root, model);
    declare(root, model.materials);
    declare_defects(root, model);
    declare(root, model.loads);
    Section &start = root.section("Initial velocity", "Of the motion, by place");
    declare_components(start, "", model.velocity, "m/s", "Empty: at rest");
    by_place_alone(start, "");
    declare(root, model.analysis);
    declare(root, model.output);
  }

  void declare_as_part(Section &root, PeridynamicAnalysisSection &analysis)
  {
    analysis.method = PeridynamicAnalysisSection::Method::motion;
    Section &s      = root.section("Analysis", "How the body moves");
    declare_kinematics(s, analysis);
    declare_steps(s, analysis);
  }

  void declare_as_part(Section &root, PeridynamicsModel &model)
  {
    declare_body(root, model);
    declare(root, model.materials);
    declare_defects(root, model);
    declare(root, model.loads);
    declare_as_part(root, model.analysis);
  }
} // namespace apps
