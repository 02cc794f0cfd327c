#include "apps/runs/particles/walls.h"

#include "apps/runs/particles/wall_files.h"
#include "apps/text/same_name.h"
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
        drive(w);
      }
  }

  void Walls::drive(const std::size_t w)
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

  void Walls::drive_next_step()
  {
    for (std::size_t w = 0; w < walls.size(); ++w)
      drive(w);
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
