#include "apps/drivers/peridynamics/model.h"

#include "apps/scene/number_list.h"
#include "apps/scene/value_text.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    /** Numbers between commas; empty where some are none. */
    std::vector<double> numbers_between_commas(const std::string &text)
    {
      std::vector<double> found;
      for (const std::string &part : comma_separated(text))
        {
          const auto number = number_in(part);
          if (!number || !std::isfinite(*number))
            return {};
          found.push_back(*number);
        }
      return found;
    }
  } // namespace

  Eigen::Vector3d PlaceEntry::value() const
  {
    const std::vector<double> numbers = numbers_between_commas(text);
    Eigen::Vector3d           place   = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < std::min<std::size_t>(3, numbers.size()); ++i)
      place[static_cast<Eigen::Index>(i)] = numbers[i];
    return place;
  }

  void PeridynamicAnalysisSection::declare(Section &root)
  {
    Section &s = root.section("Analysis", "How the body is brought to rest, or moves");
    s.choice("Method", method,
             {{"relaxation", Method::relaxation}, {"static", Method::statics}, {"motion", Method::motion}},
             Need::optional)
      .means(
        "static: equilibria by sparse factors; relaxation: by adaptive dynamic relaxation; motion: explicit, in time");
    declare_kinematics(s);
    s.choice("Solver", solver, {{"direct", pd::Solver::direct}, {"iterative", pd::Solver::iterative}}, Need::optional)
      .means("Of static: a sparse Cholesky factor, or conjugate gradients alone, which need less memory");
    s.integer("Load increments", increments, "", Range::between(1, 1e6), Need::optional)
      .means("Steps in which the load factor grows to 1 where bonds may break");
    s.choice("Breakage", breakage, {{"between equilibria", Breakage::between}, {"every step", Breakage::steps}},
             Need::optional)
      .means(
        "When bonds break that are stretched to their limit: at rest, or in every step of the relaxation as published");
    s.number("Break from", at_once, "-", Range::between(0, 1), Need::optional)
      .means("Of bonds beyond their limit, at rest, those break together whose stretch is at least this part of the "
             "largest; 0: all");
    s.choice("Fictitious density", density,
             {{"gershgorin", pd::FictitiousDensity::gershgorin}, {"constant", pd::FictitiousDensity::constant}},
             Need::optional)
      .means("Of the relaxation: the least that is stable, node by node, or that of the published example programs");
    s.number("Tolerance", tolerance, "-", Range::between(1e-13, 1e-2), Need::optional)
      .means("Forces out of balance over loads or reactions, at rest");
    s.integer("Step limit", step_limit, "", Range::between(1, 1e9), Need::optional)
      .means("Steps of the relaxation at most from one state at rest to the next");
    s.integer("Steps per row", row_interval, "", Range::between(1, 1e9), Need::optional)
      .means("Steps of the relaxation from one row of series.csv to the next");
    s.number("End time", end_time, "s", Range::positive(), Need::required)
      .only_if([this] { return !quiet(); }, "Method is motion")
      .means("Of the motion");
    declare_steps(s);
    s.find_entry("Repulsion")->only_if([this] { return !quiet(); }, "Method is motion");
  }

  void PeridynamicAnalysisSection::declare_kinematics(Section &s)
  {
    s.choice("Kinematics", kinematics, {{"linear", pd::Kinematics::linear}, {"nonlinear", pd::Kinematics::nonlinear}},
             Need::optional)
      .means("nonlinear: stretch and direction of the deformed bonds, and tractions that turn with the body's nodes");
  }

  void PeridynamicAnalysisSection::declare_steps(Section &s)
  {
    s.number("Step factor", step_factor, "-", Range::between(1e-6, 1), Need::optional)
      .means("Of the stable step of the undamaged body, which Gershgorin's bound gives");
    s.number("Repulsion", repulsion, "-", Range::at_least(0), Need::optional)
      .means("Of nodes that no bond joins any more and that come nearer than a spacing, in bond constants; 15 is "
             "usual, and shortens the stable step; 0: fragments pass through each other");
  }

  void PeridynamicAnalysisSection::declare_as_part(Section &root)
  {
    method     = Method::motion;
    Section &s = root.section("Analysis", "How the body moves");
    declare_kinematics(s);
    declare_steps(s);
  }

  void PeridynamicsModel::declare_body(Section &root)
  {
    Section &body = root.section("Body", "A rod, plate or block, centred at the origin");
    declare_list(body, "Size", size, "m", Need::required)
      .means("Lengths along x, y and z between commas: one of a rod, two of a plate, three of a block");
    body.number("Thickness", thickness, "m", Range::at_least(0), Need::optional)
      .means("Of a plate; of a rod its width and height; 0: the spacing of nodes");
    body
      .choice("Plane", plane, {{"stress", pd::Space::plane_stress}, {"strain", pd::Space::plane_strain}},
              Need::optional)
      .means("Of a plate: free to change its thickness, or not");
    Section &grid = root.section("Grid", "Nodes");
    grid.number("Spacing", spacing, "m", Range::positive(), Need::required)
      .means("Between nodes; divides every length of the body");
    grid
      .choice("Layout", layout,
              {{"cell-centred", pd::Layout::cell_centred}, {"boundary nodes", pd::Layout::boundary_nodes}},
              Need::optional)
      .means("Nodes in the middle of cells, or on the boundary too with a half of a cell there");
    Section &reach = root.section("Horizon", "How far bonds reach");
    reach.number("Ratio", horizon.ratio, "-", Range::between(1, 100), Need::optional)
      .means("Of the horizon to the spacing");
    reach
      .choice("Volumes", horizon.volumes, {{"full", pd::Volumes::full}, {"partial", pd::Volumes::partial}},
              Need::optional)
      .means("Of nodes at the edge of the horizon: counted whole, or in part");
    reach.flag("Surface correction", horizon.surface_correction)
      .means("Bonds of nodes whose family the surface cuts are made stiffer by the volume that it lacks");
  }

  void PeridynamicsModel::declare_defects(Section &root)
  {
    root.section("Holes", "One sub-section per round hole").named_sections("HOLE", [this](Section &opened) {
      PeridynamicHole &added = holes.emplace_back();
      added.name             = opened.name();
      declare_list(opened, "Centre", added.centre.text, "m", Need::required)
        .means("Of the circle; in space of the cylinder along z");
      opened.number("Radius", added.radius, "m", Range::positive(), Need::required).means("Of the hole");
    });
    root.section("Cracks", "One sub-section per crack: bonds that cross it are broken from the start")
      .named_sections("CRACK", [this](Section &opened) {
        PeridynamicCrack &added = cracks.emplace_back();
        added.name              = opened.name();
        declare_list(opened, "From", added.from.text, "m", Need::required)
          .means("One end of the segment; in space a corner of a parallelogram");
        declare_list(opened, "To", added.to.text, "m", Need::required).means("The other end; in space of one edge");
        declare_list(opened, "Depth", added.depth.text, "m", Need::optional)
          .means("In space: the other edge, as a vector");
      });
    root.section("No-fail zones", "One sub-section per region whose nodes have bonds that never break")
      .named_sections("ZONE", [this](Section &opened) {
        NoFailZone &added = safe.emplace_back();
        added.name        = opened.name();
        added.region.declare(opened);
      });
  }

  void PeridynamicsModel::declare(Section &root)
  {
    declare_body(root);
    materials.declare(root);
    declare_defects(root);
    loads.declare(root);
    Section &start = root.section("Initial velocity", "Of the motion, by place");
    declare_components(start, "", velocity, "m/s", "Empty: at rest");
    analysis.declare(root);
    output.declare(root);
  }

  void PeridynamicsModel::declare_as_part(Section &root)
  {
    declare_body(root);
    materials.declare(root);
    declare_defects(root);
    loads.declare(root);
    analysis.declare_as_part(root);
  }

  int PeridynamicsModel::dimension() const { return static_cast<int>(numbers_between_commas(size).size()); }

  pd::Space PeridynamicsModel::space() const
  {
    return dimension() == 1 ? pd::Space::rod : dimension() == 3 ? pd::Space::space : plane;
  }

  void PeridynamicsModel::check_body(const base::EntryPath &root) const
  {
    const base::EntryPath     body    = root.at("Body");
    const std::vector<double> lengths = numbers_between_commas(size);
    if (lengths.empty() || lengths.size() > 3 || *std::min_element(lengths.begin(), lengths.end()) <= 0)
      body.refuse("Size", "must be one to three lengths > 0 between commas.");
    if (pd::half_family(dimension(), horizon).empty())
      root.at("Horizon").refuse("Ratio", "no other node lies within the horizon: it must be at least one spacing.");
    for (const double length : lengths)
      if (const double cells = length / spacing;
          std::abs(cells - std::round(cells)) > 1e-6 * cells || std::round(cells) < 1)
        root.at("Grid").refuse(
          "Spacing",
          fmt::format("must divide every length of the body without a rest; {} m are {:.6g} spacings.", length, cells));
  }

  void PeridynamicsModel::check_places(const base::EntryPath &root) const
  {
    const int  d       = dimension();
    const auto require = [&](const base::EntryPath &section, const char *entry, const PlaceEntry &place,
                             const bool needed) {
      const std::size_t n = numbers_between_commas(place.text).size();
      if ((needed || !place.text.empty()) && (n < static_cast<std::size_t>(std::min(d, 2)) || n > 3))
        section.refuse(entry, fmt::format("expected {} coordinates between commas.", d));
    };
    for (const PeridynamicHole &hole : holes)
      {
        const base::EntryPath section = root.at("Holes").at(hole.name);
        if (d == 1)
          section.refuse("Radius", "a rod cannot have a hole.");
        require(section, "Centre", hole.centre, true);
      }
    for (const PeridynamicCrack &crack : cracks)
      {
        const base::EntryPath section = root.at("Cracks").at(crack.name);
        if (d == 1)
          section.refuse("From", "a rod cannot have a crack along itself.");
        require(section, "From", crack.from, true);
        require(section, "To", crack.to, true);
        require(section, "Depth", crack.depth, d == 3);
      }
    for (const NoFailZone &zone : safe)
      zone.region.check(root.at("No-fail zones").at(zone.name), d == 1 ? 3 : d);
  }

  void PeridynamicsModel::check(const base::EntryPath &root) const
  {
    check_body(root);
    materials.check(root, space(), !analysis.quiet());
    check_places(root);
    loads.check(root, dimension());
  }

  pd::Body PeridynamicsModel::body() const
  {
    pd::Body made;
    made.space     = space();
    made.size      = PlaceEntry{size}.value();
    made.spacing   = spacing;
    made.thickness = thickness > 0 ? thickness : spacing;
    made.layout    = layout;
    for (const PeridynamicHole &hole : holes)
      made.holes.push_back({hole.name, hole.centre.value(), hole.radius});
    return made;
  }

  pd::Bonds PeridynamicsModel::bonds() const
  {
    const pd::Grid grid(body(), pd::reach_of(horizon));
    pd::Bonds      made(grid, horizon, materials.mixture(grid, horizon.ratio * spacing));
    for (const PeridynamicCrack &crack : cracks)
      if (made.cut({crack.from.value(), crack.to.value(), crack.depth.value()}) == 0)
        throw base::InputError("Cracks/" + crack.name +
                               ": no bond crosses it. Check its places against Body/Size (metres).");
    if (!safe.empty())
      {
        std::vector<bool> protects(grid.places(), false);
        for (const std::size_t i : grid.nodes())
          protects[i] = std::any_of(safe.begin(), safe.end(), [&](const NoFailZone &zone) {
            return zone.region.holds(grid.position(i), grid.dimension() == 1 ? 3 : grid.dimension());
          });
        made.protect(protects);
      }
    made.refuse_isolated_nodes();
    return made;
  }
} // namespace apps
