#include "apps/drivers/particles/walls.h"

#include "apps/drivers/particles/wall_files.h"
#include "apps/scene/same_name.h"
#include "dem/facets/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace apps
{
  namespace
  {
    Eigen::Vector3d vector(const std::array<double, 3> &v) { return {v[0], v[1], v[2]}; }

    const char *const motion_names[6] = {"Velocity x", "Velocity y", "Velocity z", "Spin x", "Spin y", "Spin z"};
  } // namespace

  void WallSection::declare(Section &s)
  {
    declare_shape(s);
    declare_plane_and_plate(s);
    declare_box(s);
    declare_cylinder(s);
    declare_file(s);
    contact.declare(s);
    declare_control(s);
  }

  void WallSection::declare_shape(Section &s)
  {
    s.choice("Shape", shape,
             {{"plane", Shape::plane},
              {"plate", Shape::plate},
              {"box", Shape::box},
              {"cylinder", Shape::cylinder},
              {"file", Shape::file}},
             Need::optional)
      .means(
        "plane: unbounded, particles on the side of its normal; plate: a parallelogram; box: along the axes; "
        "cylinder: the mantle of one; file: triangles. In two dimensions a line, a segment, a rectangle, a circle. "
        "All but a plane push from both sides");
  }

  void WallSection::declare_plane_and_plate(Section &s)
  {
    const auto plane = [this] { return shape == Shape::plane; };
    const auto plate = [this] { return shape == Shape::plate; };
    s.vector("Point", point, "m", Range(), Need::optional).means("On the plane").only_if(plane, "Shape = plane");
    s.vector("Normal", normal, "-", Range(), Need::optional)
      .means("Of the plane, to where the particles are; of any length")
      .only_if(plane, "Shape = plane");
    s.vector("Corner", corner, "m", Range(), Need::required).means("Of the plate").only_if(plate, "Shape = plate");
    s.vector("First edge", first_edge, "m", Range(), Need::required)
      .means("Of the plate, from its corner; in two dimensions the segment")
      .only_if(plate, "Shape = plate");
    s.vector("Second edge", second_edge, "m", Range(), Need::optional)
      .means("Of the plate, from its corner; not in two dimensions")
      .only_if(plate, "Shape = plate");
  }

  void WallSection::declare_box(Section &s)
  {
    const auto chosen = [this] { return shape == Shape::box; };
    s.vector("Lower", lower, "m", Range(), Need::required)
      .means("Corner of the box with the least coordinates")
      .only_if(chosen, "Shape = box");
    s.vector("Upper", upper, "m", Range(), Need::required)
      .means("Corner of the box with the largest coordinates")
      .only_if(chosen, "Shape = box");
    s.choices("Open sides", open, {{"-x", 0}, {"+x", 1}, {"-y", 2}, {"+y", 3}, {"-z", 4}, {"+z", 5}}, Need::optional)
      .means("That the box does not have")
      .only_if(chosen, "Shape = box");
  }

  void WallSection::declare_cylinder(Section &s)
  {
    const auto chosen = [this] { return shape == Shape::cylinder; };
    s.vector("From", from, "m", Range(), Need::required)
      .means("Where the axis of the cylinder begins; in two dimensions the centre of the circle")
      .only_if(chosen, "Shape = cylinder");
    s.vector("To", to, "m", Range(), Need::optional)
      .means("Where the axis of the cylinder ends; not in two dimensions")
      .only_if(chosen, "Shape = cylinder");
    s.number("Radius", radius, "m", Range::positive(), Need::required)
      .means("Of the cylinder")
      .only_if(chosen, "Shape = cylinder");
    s.integer("Sides", around, "", Range::between(3, 100000), Need::optional)
      .means("Plane sides that stand for its mantle; their edges lie on it")
      .only_if(chosen, "Shape = cylinder");
    s.flag("Ends", ends).means("The cylinder is closed by discs at both ends").only_if(chosen, "Shape = cylinder");
  }

  void WallSection::declare_file(Section &s)
  {
    const auto chosen = [this] { return shape == Shape::file; };
    s.file("File", file)
      .means("STL (text or binary), or Gmsh (.msh, text): its triangles and quadrilaterals; from the scene's folder")
      .only_if(chosen, "Shape = file");
    s.number("Scale", scale, "-", Range::positive(), Need::optional)
      .means("By which lengths of the file are multiplied to be metres")
      .only_if(chosen, "Shape = file");
  }

  void WallSection::declare_control(Section &s)
  {
    s.choice("Control", control, {{"motion", Control::motion}, {"force", Control::force}}, Need::optional)
      .means("motion: it rests, or moves as said; force: it moves along a direction until it presses with a force");
    const auto moved = [this] { return control == Control::motion; };
    const auto held  = [this] { return control == Control::force; };
    declare_components(s, "Velocity", velocity, "m/s", "By time t; empty: none");
    declare_components(s, "Spin", spin, "rad/s", "By time t, about Centre; empty: none");
    for (const char *entry : motion_names)
      s.find_entry(entry)->only_if(moved, "Control = motion");
    s.vector("Centre", centre, "m", Range(), Need::optional)
      .means("That it spins about; moves with it")
      .only_if(moved, "Control = motion");
    s.vector("Direction", direction, "-", Range(), Need::required)
      .means("Along which it presses and moves; of any length")
      .only_if(held, "Control = force");
    s.expression("Force", force, "N")
      .means("On the particles along the direction, by time t")
      .only_if(held, "Control = force");
    s.number("Largest speed", largest_speed, "m/s", Range::positive(), Need::required)
      .means("Of the wall, also on its way to the particles")
      .only_if(held, "Control = force");
    s.number("Gain", gain, "-", {std::numeric_limits<double>::min(), 1.0, false}, Need::optional)
      .means("Part of what the force lacks that a step makes good")
      .only_if(held, "Control = force");
  }

  void WallSection::check(const base::EntryPath &section, const int dimension) const
  {
    for (int d = 0; d < dimension && shape == Shape::box; ++d)
      if (!(lower[static_cast<std::size_t>(d)] < upper[static_cast<std::size_t>(d)]))
        section.refuse("Upper", "each coordinate must be above that of Lower.");
    if (shape == Shape::file && !std::filesystem::is_regular_file(file))
      section.refuse("File", "there is no such file.");
    if (shape == Shape::file && dimension == 2)
      section.refuse("Shape", "in two dimensions walls are built in: plane, plate, box or cylinder.");
    if (shape == Shape::cylinder && dimension == 3 && from == to)
      section.refuse("To", "is the same place as From: the cylinder has no length.");
    contact.check(section);
    if (control == Control::force)
      {
        if (!force.given())
          section.refuse("Force", "is not set. Say how hard the wall presses.");
        if (!(vector(direction).norm() > 0))
          section.refuse("Direction", "has no length.");
        if (force.varies_in_space())
          section.refuse("Force", "a wall is pressed as a whole: a formula of t alone.");
        return;
      }
    for (std::size_t i = 0; i < 6; ++i)
      if ((i < 3 ? velocity[i] : spin[i - 3]).varies_in_space())
        section.refuse(motion_names[i], "a wall moves as a rigid body: a formula of t alone.");
    if (shape == Shape::plane && any_given(spin))
      section.refuse("Spin x", "an unbounded plane does not spin. Take a plate.");
  }

  dem::FacetMesh WallSection::mesh(const int dimension) const
  {
    dem::BoxSides there = {true, true, true, true, true, true};
    for (const int side : open)
      there[static_cast<std::size_t>(side)] = false;
    switch (shape)
      {
      case Shape::plate:
        return dimension == 2 ? dem::segment(vector(corner), vector(corner) + vector(first_edge)) :
                                dem::plate(vector(corner), vector(first_edge), vector(second_edge));
      case Shape::box:
        return dimension == 2 ? dem::rectangle(vector(lower), vector(upper), there) :
                                dem::box(vector(lower), vector(upper), there);
      case Shape::cylinder:
        return dimension == 2 ? dem::circle(vector(from), radius, static_cast<int>(around)) :
                                dem::cylinder(vector(from), vector(to), radius, static_cast<int>(around), ends);
      case Shape::file:
        return read_wall(file, scale);
      default:
        return dem::FacetMesh::plane(vector(point), vector(normal));
      }
  }

  void WallsSection::declare(Section &root)
  {
    root
      .section("Walls", "One sub-section per wall that particles touch, in contact with friction. What belongs "
                        "together should be one wall: a sphere has one contact with it, also over edges")
      .named_sections("WALL", [this](Section &opened) {
        WallSection &added = walls.emplace_back();
        added.name         = opened.name();
        added.declare(opened);
      });
  }

  void WallsSection::check(const base::EntryPath &root, const int dimension) const
  {
    for (const WallSection &wall : walls)
      wall.check(root.at("Walls").at(wall.name), dimension);
  }

  bool WallsSection::knows(const std::string &name) const
  {
    return std::any_of(walls.begin(), walls.end(), [&](const WallSection &w) { return same_name(w.name, name); });
  }

  std::vector<std::string> WallsSection::names() const
  {
    std::vector<std::string> all;
    for (const WallSection &wall : walls)
      all.push_back(wall.name);
    return all;
  }

  Walls::Walls(dem::Specimen &body, const WallsSection &section)
    : specimen(&body)
    , walls(section.walls.begin(), section.walls.end())
  {
    for (std::size_t w = 0; w < walls.size(); ++w)
      {
        body.surfaces().add(
          {walls[w].name, walls[w].mesh(body.parameters().physics.dimension), walls[w].contact.materials()});
        if (walls[w].control == WallSection::Control::motion)
          body.surfaces().set_motion(w, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), vector(walls[w].centre));
        for (const Expressions *formulas : {&walls[w].velocity, &walls[w].spin})
          for (const Expression &formula : *formulas)
            varying = varying || formula.varies_in_time();
        varying = varying || walls[w].force.varies_in_time();
        lead(w);
      }
  }

  void Walls::lead(const std::size_t w)
  {
    const WallSection    &wall   = walls[w];
    const double          middle = specimen->time() + 0.5 * specimen->time_step();
    const Eigen::Vector3d nowhere(0, 0, 0);
    if (wall.control == WallSection::Control::force)
      specimen->surfaces().hold_at_force(
        w, {vector(wall.direction), wall.force(0, 0, 0, middle), wall.largest_speed, wall.gain});
    else
      specimen->surfaces().set_motion(w, value_of(wall.velocity, nowhere, middle), value_of(wall.spin, nowhere, middle),
                                      specimen->surfaces().at(w).centre);
  }

  void Walls::lead_next_step()
  {
    for (std::size_t w = 0; w < walls.size(); ++w)
      lead(w);
  }

  const dem::Surface &Walls::surface(const std::string &name) const
  {
    const auto found =
      std::find_if(walls.begin(), walls.end(), [&](const WallSection &w) { return same_name(w.name, name); });
    return specimen->surfaces().at(static_cast<std::size_t>(found - walls.begin()));
  }

  std::string Walls::text() const
  {
    std::string text;
    for (std::size_t w = 0; w < walls.size(); ++w)
      text += fmt::format("{}{}{}{}", w ? ", " : "", walls[w].name,
                          walls[w].is_plane() ? " (unbounded)" :
                                                fmt::format(" ({} facets)", specimen->surfaces().at(w).mesh.size()),
                          walls[w].control == WallSection::Control::force ? " at a force" : "");
    return text;
  }
} // namespace apps
