#include "apps/runs/peridynamics/results.h"

#include "postprocess/files/series.h"
#include "postprocess/pictures/field_picture.h"
#include "postprocess/pictures/picture_axes.h"
#include "postprocess/vtk/vtk_points.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace pd = dem::peridynamics;

  PeridynamicState::PeridynamicState(const PeridynamicBody &body, const pd::Field &u)
    : bonds(body.bonds)
    , displacement(u)
    , damage(body.bonds.damage())
  {
    if (!body.loads.held)
      pd::remove_rigid_motion(bonds.grid(), displacement);
  }

  void PeridynamicState::write_table(const std::filesystem::path &file) const
  {
    postprocess::SeriesWriter table(file, {{"x", "m"},
                                           {"y", "m"},
                                           {"z", "m"},
                                           {"u_x", "m"},
                                           {"u_y", "m"},
                                           {"u_z", "m"},
                                           {"damage", "-"},
                                           {"volume", "m^3"}});
    for (std::size_t n = 0; n < damage.size(); ++n)
      {
        const std::size_t     at = bonds.grid().nodes()[n];
        const Eigen::Vector3d x = bonds.grid().position(at), u = displacement.at(at);
        table.append({x.x(), x.y(), x.z(), u.x(), u.y(), u.z(), damage[n], bonds.grid().volume()[at]});
      }
    table.flush();
  }

  void PeridynamicState::write_points(const std::filesystem::path &file, const double time) const
  {
    postprocess::PointCloud      points;
    std::vector<Eigen::Vector3d> moved;
    std::vector<double>          volume;
    for (const std::size_t at : bonds.grid().nodes())
      {
        moved.push_back(displacement.at(at));
        points.place.push_back(bonds.grid().position(at) + moved.back());
        volume.push_back(bonds.grid().volume()[at]);
      }
    points.scalars = {{"damage", damage}, {"volume", volume}};
    if (!bonds.mixture().of.empty())
      points.scalars.push_back({"material", materials()});
    points.vectors = {{"displacement", moved}};
    postprocess::write_vtk_points(file, postprocess::field_file("nodes"), points, time);
  }

  std::vector<double> PeridynamicState::materials() const
  {
    std::vector<double> numbers;
    for (const std::size_t at : bonds.grid().nodes())
      numbers.push_back(bonds.mixture().of[at]);
    return numbers;
  }

  namespace
  {
    double median_length(const pd::Grid &grid, const pd::Field &u)
    {
      std::vector<double> lengths;
      for (const std::size_t i : grid.nodes())
        lengths.push_back(u.at(i).norm());
      const auto median = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
      std::nth_element(lengths.begin(), median, lengths.end());
      return *median;
    }
  } // namespace

  int PeridynamicState::plane() const { return bonds.grid().counts()[2] / 2; }

  double PeridynamicState::magnification(const double length) const
  {
    const double median = median_length(bonds.grid(), displacement);
    return postprocess::round_magnification(median > 0 ? 0.03 * length / median : 1);
  }

  std::vector<postprocess::PictureFacet> PeridynamicState::facets(const Shown shown, const double magnify) const
  {
    const pd::Grid                        &grid = bonds.grid();
    const double                           half = 0.5 * grid.spacing();
    std::vector<postprocess::PictureFacet> all;
    for (std::size_t n = 0; n < damage.size(); ++n)
      {
        const std::size_t at = grid.nodes()[n];
        if (grid.numbers(at)[2] != plane())
          continue;
        const Eigen::Vector3d      u = displacement.at(at), x = grid.position(at) + magnify * u;
        postprocess::PictureFacet &facet = all.emplace_back();
        facet.corner                     = {{{x.x() - half, x.y() - half},
                                             {x.x() + half, x.y() - half},
                                             {x.x() + half, x.y() + half},
                                             {x.x() - half, x.y() + half}}};
        facet.value                      = shown == Shown::damage ? damage[n] : u.norm();
      }
    return all;
  }

  std::string PeridynamicState::title_of_picture(const std::string &title, const double magnify) const
  {
    const pd::Grid &grid = bonds.grid();
    return fmt::format("{}, displacements x {}{}", title, magnify,
                       grid.dimension() == 3 ?
                         ": plane at z = " + postprocess::length_text(grid.position(grid.place({0, 0, plane()})).z()) :
                         std::string());
  }

  std::string PeridynamicState::draw_facets(const std::filesystem::path           &file,
                                            const std::string                     &title,
                                            std::vector<postprocess::PictureFacet> facets,
                                            const Shown                            shown)
  {
    double most = 0;
    for (const postprocess::PictureFacet &facet : facets)
      most = std::max(most, facet.value);
    postprocess::FieldPicture what;
    what.title = title;
    if (shown == Shown::damage)
      {
        what.label   = "Damage [-]";
        what.highest = std::max(most, 0.4); // a crack between two rows of nodes leaves 0.39
        what.tick    = 0.1;
        return postprocess::picture_of_field(file, facets, what);
      }
    const postprocess::LengthUnit unit = postprocess::length_unit(most);
    for (postprocess::PictureFacet &facet : facets)
      facet.value *= unit.per_metre;
    what.highest = most > 0 ? most * unit.per_metre : 1;
    what.tick    = postprocess::tick_step(what.highest, 8);
    what.label   = fmt::format("Displacement [{}]", unit.name);
    return postprocess::picture_of_field(file, facets, what);
  }

  std::string
  PeridynamicState::draw(const std::filesystem::path &file, const std::string &title, const Shown shown) const
  {
    const double magnify = magnification(bonds.grid().body().size.maxCoeff());
    return draw_facets(file, title_of_picture(title, magnify), facets(shown, magnify), shown);
  }
} // namespace apps
