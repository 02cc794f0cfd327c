#include "apps/runs/continuum/picture.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/picture_facets.h"
#include "coupling/multiscale/cell_points.h"
#include "postprocess/pictures/field_picture.h"
#include "postprocess/pictures/picture_axes.h"

#include <deal.II/base/mpi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace apps
{
  namespace
  {
    bool is_damage(const fem::PointQuantity &of) { return of.role == fem::PointQuantity::Role::damage; }

    template <int dim>
    bool can_be_damaged(const fem::Solid<dim> &solid)
    {
      for (const auto &group : solid.groups())
        {
          const auto quantities = group.second->quantities();
          if (std::any_of(quantities.begin(), quantities.end(), is_damage))
            return true;
        }
      return false;
    }

    /** Largest damage of the points of every owned element, by its index. */
    template <int dim>
    std::map<unsigned int, double> damage_of_elements(fem::Solid<dim> &solid, const fem::Vector &displacement)
    {
      std::map<unsigned int, double> damage;
      solid.visit_points(displacement, [&](const fem::PointView<dim> &point) {
        double &largest = damage[point.cell->active_cell_index()];
        point.material->visit(point.index, [&](const fem::PointQuantity &of, const double *value) {
          if (is_damage(of))
            largest = std::max(largest, *value);
        });
      });
      return damage;
    }

    /** A point of a solid that particles answer for. */
    template <int dim>
    struct PromotedPoint
    {
      typename dealii::DoFHandler<dim>::active_cell_iterator cell;
      dealii::Point<dim>                                     place; ///< [m]
      double                                                 since; ///< number of the state
    };

    template <int dim>
    std::vector<PromotedPoint<dim>> promoted_points(fem::Solid<dim> &solid, const fem::Vector &displacement)
    {
      std::vector<PromotedPoint<dim>> promoted;
      solid.visit_points(displacement, [&](const fem::PointView<dim> &point) {
        point.material->visit(point.index, [&](const fem::PointQuantity &of, const double *value) {
          if (of.name == coupling::CellPoints::promoted_in_state && *value > 0)
            promoted.push_back({point.cell, point.place, *value});
        });
      });
      return promoted;
    }

    /** Small squares at the points of elements that the plane meets. */
    template <int dim>
    std::vector<double>
    squares_of(const std::vector<PromotedPoint<dim>> &points, const PicturePlane &plane, const unsigned int per_element)
    {
      std::vector<double> facets;
      for (const PromotedPoint<dim> &point : points)
        {
          bool below = dim == 2, above = dim == 2;
          for (const unsigned int v : point.cell->vertex_indices())
            if (dim == 3)
              (point.cell->vertex(v)[plane.across] < plane.position ? below : above) = true;
          if (!below || !above)
            continue;
          const double x = point.place[plane.right], y = point.place[plane.up],
                       half = 0.35 * std::pow(point.cell->measure() / per_element, 1.0 / dim);
          append_polygon(facets,
                         {{x - half, y - half, 0, 0},
                          {x + half, y - half, 0, 0},
                          {x + half, y + half, 0, 0},
                          {x - half, y + half, 0, 0}},
                         point.since);
        }
      return facets;
    }
  } // namespace

  template <int dim>
  SolidCut cut_of(const fem::Solid<dim>       &solid,
                  const fem::Vector           &displacement,
                  const unsigned int           across,
                  const std::optional<double> &through)
  {
    const unsigned int             along = dim == 3 ? across : 1;
    SolidCut                       cut;
    PicturePlane                   plane;
    std::map<unsigned int, double> no_value;
    double                         most = 0, low = 1e300, high = -1e300, nearest = 1e300;
    const auto                     each_vertex = [&](const auto &use) {
      for (const auto &cell : solid.dofs().active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          {
            double squared = 0;
            for (unsigned int c = 0; c < dim; ++c)
              squared += std::pow(displacement[cell->vertex_dof_index(v, c)], 2);
            use(cell, cell->vertex(v), squared);
          }
    };
    each_vertex([&](const auto &cell, const dealii::Point<dim> &vertex, const double squared) {
      no_value[cell->active_cell_index()] = 0;
      most                                = std::max(most, squared);
      low                                 = std::min(low, vertex[along]);
      high                                = std::max(high, vertex[along]);
    });
    // Of what moves next to most the place that is most in the middle; and just inside of elements, whose faces belong to none.
    if (dim == 3)
      each_vertex([&](const auto &cell, const dealii::Point<dim> &vertex, const double squared) {
        const double off = std::fabs(vertex[along] - through.value_or(0.5 * (low + high)));
        if ((!through && squared < 0.8 * most) || off >= nearest)
          return;
        nearest        = off;
        plane.position = vertex[along] + 1e-3 * (cell->center()[along] - vertex[along]);
      });
    if (dim == 3)
      {
        plane.right  = across == 0 ? 1 : 0;
        plane.up     = across == 2 ? 1 : 2;
        plane.across = across;
      }
    const std::vector<double> all = facets_of(solid, displacement, no_value, plane);
    for (auto numbers = all.begin(); numbers != all.end(); numbers += facet_length)
      {
        postprocess::PictureFacet &facet = cut.facets.emplace_back();
        for (std::ptrdiff_t c = 0; c < 4; ++c)
          {
            const double u = numbers[4 * c + 2], v = numbers[4 * c + 3];
            facet.corner[static_cast<std::size_t>(c)] = {numbers[4 * c] + u, numbers[4 * c + 1] + v};
            facet.value += 0.25 * std::hypot(u, v);
          }
      }
    cut.right    = static_cast<int>(plane.right);
    cut.up       = static_cast<int>(plane.up);
    cut.across   = static_cast<int>(plane.across);
    cut.position = plane.position;
    cut.in_space = dim == 3;
    return cut;
  }

  template SolidCut cut_of(const fem::Solid<2> &, const fem::Vector &, unsigned int, const std::optional<double> &);
  template SolidCut cut_of(const fem::Solid<3> &, const fem::Vector &, unsigned int, const std::optional<double> &);

  unsigned int calmest_axis(const fem::Solid<3> &solid, const fem::Vector &displacement)
  {
    std::array<double, 3> sum{};
    for (const auto &cell : solid.dofs().active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < 3; ++c)
          sum[c] += std::pow(displacement[cell->vertex_dof_index(v, c)], 2);
    return static_cast<unsigned int>(std::min_element(sum.begin(), sum.end()) - sum.begin());
  }

  std::string draw_cut(const std::filesystem::path            &file,
                       const SolidCut                         &cut,
                       const std::string                      &title,
                       std::vector<postprocess::PictureCircle> circles)
  {
    postprocess::FieldPicture what;
    what.right   = "xyz"[cut.right];
    what.up      = "xyz"[cut.up];
    what.circles = std::move(circles);
    what.title   = title;
    if (cut.in_space)
      what.title += fmt::format(": cut at {} = {}", "xyz"[cut.across], postprocess::length_text(cut.position));
    double most = 0;
    for (const postprocess::PictureFacet &facet : cut.facets)
      most = std::max(most, facet.value);
    const postprocess::LengthUnit unit   = postprocess::length_unit(most);
    auto                          facets = cut.facets;
    for (postprocess::PictureFacet &facet : facets)
      facet.value *= unit.per_metre;
    what.highest = most > 0 ? most * unit.per_metre : 1;
    what.tick    = postprocess::tick_step(what.highest, 8);
    what.label   = fmt::format("Displacement [{}]", unit.name);
    return postprocess::picture_of_field(file, facets, what);
  }

  template <int dim>
  std::string draw_damage(fem::Solid<dim>             &solid,
                          const fem::Vector           &displacement,
                          const std::filesystem::path &file,
                          const std::string           &title)
  {
    if (!can_be_damaged(solid))
      return "";
    const auto                damage = damage_of_elements(solid, displacement);
    const PicturePlane        plane  = plane_of(solid, displacement, damage);
    const std::vector<double> all = of_all_ranks(facets_of(solid, displacement, damage, plane), solid.communicator());
    if (!is_first_rank())
      return "";
    const double                                 magnify = magnification_of(all);
    const std::vector<postprocess::PictureFacet> facets  = as_facets(all, magnify);
    postprocess::FieldPicture                    what;
    what.title = fmt::format("{}: damage, displacements x {}{}", title, magnify, place_of(plane, dim));
    what.label = "Damage";
    what.right = "xyz"[plane.right];
    what.up    = "xyz"[plane.up];
    return postprocess::picture_of_field(file, facets, what);
  }

  template std::string
  draw_damage(fem::Solid<2> &, const fem::Vector &, const std::filesystem::path &, const std::string &);
  template std::string
  draw_damage(fem::Solid<3> &, const fem::Vector &, const std::filesystem::path &, const std::string &);

  template <int dim>
  std::string draw_promotion(fem::Solid<dim>             &solid,
                             const fem::Vector           &displacement,
                             const std::filesystem::path &file,
                             const std::string           &title)
  {
    const auto                     points = promoted_points(solid, displacement);
    std::map<unsigned int, double> none, many;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        none[cell->active_cell_index()] = many[cell->active_cell_index()] = 0;
    double latest = 0;
    for (const PromotedPoint<dim> &point : points)
      {
        ++many[point.cell->active_cell_index()];
        latest = std::max(latest, point.since);
      }
    latest           = dealii::Utilities::MPI::max(latest, solid.communicator());
    const auto count = dealii::Utilities::MPI::sum(points.size(), solid.communicator());
    if (count == 0)
      return "";
    const PicturePlane        plane = plane_of(solid, displacement, many);
    const std::vector<double> elements =
      of_all_ranks(facets_of(solid, displacement, none, plane), solid.communicator());
    const std::vector<double> squares =
      of_all_ranks(squares_of(points, plane, solid.quadrature().size()), solid.communicator());
    if (!is_first_rank())
      return "";
    std::vector<postprocess::PictureFacet>       facets = as_facets(elements, 0);
    const std::vector<postprocess::PictureFacet> taken  = as_facets(squares, 0);
    facets.insert(facets.end(), taken.begin(), taken.end());
    postprocess::FieldPicture what;
    what.title   = fmt::format("{}: {} points whose particles have taken over{}", title, count, place_of(plane, dim));
    what.label   = "State in which they did";
    what.right   = "xyz"[plane.right];
    what.up      = "xyz"[plane.up];
    what.highest = latest;
    what.tick    = std::max(1.0, postprocess::tick_step(latest, 8));
    return postprocess::picture_of_field(file, facets, what);
  }

  template std::string
  draw_promotion(fem::Solid<2> &, const fem::Vector &, const std::filesystem::path &, const std::string &);
  template std::string
  draw_promotion(fem::Solid<3> &, const fem::Vector &, const std::filesystem::path &, const std::string &);
} // namespace apps
