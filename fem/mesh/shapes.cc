#include "fem/mesh/shapes.h"

#include "base/errors.h"
#include "fem/mesh/sides.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    void demand(const bool holds, const std::string &message)
    {
      if (!holds)
        throw base::InputError(message);
    }

    using Names = std::vector<std::string>; // boundary id -> name

    Names names_of_sides()
    {
      Names names;
      for (const SideName &side : side_names)
        names.emplace_back(side.word);
      return names;
    }

    const Names box_names = names_of_sides();

    /// Builds, refines and spreads; `colour` gives the place in `names` of every boundary face, by its centre.
    template <int dim>
    Mesh<dim> finish(const ShapeOptions                            &options,
                     const Names                                   &names,
                     const BuildMesh<dim>                          &build,
                     const std::function<unsigned int(Point<dim>)> &colour)
    {
      const auto whole = [&](Triangulation<dim> &mesh) {
        Triangulation<dim> shape;
        build(shape);
        for (const auto &cell : shape.active_cell_iterators())
          {
            cell->set_material_id(0);
            for (const unsigned int face : cell->face_indices())
              if (cell->face(face)->at_boundary())
                cell->face(face)->set_boundary_id(colour(cell->face(face)->center()));
          }
        mesh.copy_triangulation(shape);
        mesh.refine_global(options.refinements);
      };
      Mesh<dim>                                 mesh = make_mesh<dim>(whole, options.family, options.communicator);
      std::map<std::string, types::boundary_id> named;
      for (const auto &entry : mesh.boundaries)
        named[names.at(entry.second)] = entry.second;
      name_by_axis(named);
      mesh.boundaries = named;
      mesh.materials  = {{"solid", 0}};
      return mesh;
    }

    /// Which side of a box a face of it is.
    template <int dim>
    unsigned int side_of(const Point<dim> &face, const Point<dim> &corner)
    {
      unsigned int nearest = 0;
      double       least   = 1e300;
      for (unsigned int d = 0; d < dim; ++d)
        for (const double side : {0.0, 1.0})
          if (std::fabs(face[d] - side * corner[d]) < least)
            {
              least   = std::fabs(face[d] - side * corner[d]);
              nearest = 2 * d + static_cast<unsigned int>(side);
            }
      return nearest;
    }

    /// Equal steps of at most `largest` from one place to the next.
    void add_steps(std::vector<double> &steps, const double length, const double largest)
    {
      const auto count = static_cast<unsigned int>(std::ceil(length / largest * (1 - 1e-9)));
      steps.insert(steps.end(), std::max(1u, count), length / std::max(1u, count));
    }
  }

  namespace
  {
    /// Sizes in geometric progression that add up to a length.
    std::vector<double> graded(const double length, const unsigned int count, const double growth)
    {
      std::vector<double> sizes{1};
      double              sum = 1;
      while (sizes.size() < count)
        sum += sizes.emplace_back(sizes.back() * growth);
      for (double &size : sizes)
        size *= length / sum;
      return sizes;
    }
  } // namespace

  template <int dim>
  Mesh<dim> make_shape(const BoxShape &shape, const ShapeOptions &options)
  {
    Point<dim>                corner;
    std::vector<unsigned int> divisions;
    for (unsigned int d = 0; d < dim; ++d)
      {
        demand(shape.size[d] > 0 && shape.divisions[d] > 0, "box: its size and divisions must be positive.");
        demand(shape.growth[d] > 0, "box: the growth of its elements must be positive.");
        corner[d] = shape.size[d];
        divisions.push_back(shape.divisions[d]);
      }
    if (shape.growth != std::array<double, 3>{1, 1, 1})
      return finish<dim>(
        options, box_names,
        [&](Triangulation<dim> &mesh) {
          std::vector<std::vector<double>> sizes;
          for (unsigned int d = 0; d < dim; ++d)
            sizes.push_back(graded(shape.size[d], shape.divisions[d], shape.growth[d]));
          GridGenerator::subdivided_hyper_rectangle(mesh, sizes, Point<dim>(), corner);
        },
        [&](const Point<dim> &face) { return side_of(face, corner); });
    // The same elements as refinements of fewer: geometric multigrid needs the coarser levels, and they cost nothing.
    ShapeOptions refined = options;
    const auto   even    = [](const unsigned int n) { return n % 2 == 0; };
    while (options.family == ElementFamily::hypercube && std::all_of(divisions.begin(), divisions.end(), even))
      {
        for (unsigned int &n : divisions)
          n /= 2;
        ++refined.refinements;
      }
    return finish<dim>(
      refined, box_names,
      [&](Triangulation<dim> &mesh) {
        GridGenerator::subdivided_hyper_rectangle(mesh, divisions, Point<dim>(), corner);
      },
      [&](const Point<dim> &face) { return side_of(face, corner); });
  }

  namespace
  {
    void check(const NotchedBeamShape &s, const int dim)
    {
      demand(s.length > 0 && s.height > 0 && (dim == 2 || s.width > 0),
             "notched beam: length, height and, in three dimensions, width must be positive.");
      demand(s.span > s.band && s.span <= s.length,
             "notched beam: the span must lie between the fine band and the length.");
      demand(s.notch_depth > 0 && s.notch_depth < s.height, "notched beam: the notch depth must lie in (0, height).");
      demand(s.notch_width > 0 && s.notch_width < s.band, "notched beam: the notch width must lie in (0, band).");
      demand(s.fine_size > 0 && s.coarse_size >= s.fine_size,
             "notched beam: the fine element size must be positive and not above the coarse one.");
      demand(s.width_divisions > 0, "notched beam: its divisions across must be positive.");
    }

    /// Steps along x, from the left end to the right, the right half the mirror image of the left. An odd number of columns
    /// stands over the notch: with an even one the crack would have to choose a side.
    std::vector<double> steps_along(const NotchedBeamShape &s)
    {
      std::vector<double> half;
      if (s.length > s.span * (1 + 1e-12))
        add_steps(half, (s.length - s.span) / 2, s.coarse_size);
      add_steps(half, (s.span - s.band) / 2, s.coarse_size);
      add_steps(half, (s.band - s.notch_width) / 2, s.fine_size);
      std::vector<double> over_notch;
      add_steps(over_notch, s.notch_width, s.fine_size);
      if (over_notch.size() % 2 == 0)
        over_notch.assign(over_notch.size() + 1, s.notch_width / (over_notch.size() + 1.0));
      std::vector<double> whole = half;
      whole.insert(whole.end(), over_notch.begin(), over_notch.end());
      whole.insert(whole.end(), half.rbegin(), half.rend());
      return whole;
    }
  }

  template <int dim>
  Mesh<dim> make_shape(const NotchedBeamShape &shape, const ShapeOptions &options)
  {
    check(shape, dim);
    std::vector<std::vector<double>> steps(dim);
    steps[0] = steps_along(shape);
    add_steps(steps[1], shape.notch_depth, shape.fine_size);
    add_steps(steps[1], shape.height - shape.notch_depth, shape.fine_size);
    Point<dim> corner;
    corner[0] = shape.length;
    corner[1] = shape.height;
    if constexpr (dim == 3)
      {
        corner[2] = shape.width;
        steps[2].assign(shape.width_divisions, shape.width / shape.width_divisions);
      }
    Names names = box_names;
    names.push_back("notch");
    const auto in_notch = [&](const Point<dim> &x) {
      return std::fabs(x[0] - shape.length / 2) <= shape.notch_width / 2 * (1 + 1e-9) &&
             x[1] <= shape.notch_depth * (1 + 1e-9);
    };
    return finish<dim>(
      options, names,
      [&](Triangulation<dim> &mesh) {
        Triangulation<dim> full;
        GridGenerator::subdivided_hyper_rectangle(full, steps, Point<dim>(), corner);
        std::set<typename Triangulation<dim>::active_cell_iterator> removed;
        for (const auto &cell : full.active_cell_iterators())
          if (in_notch(cell->center()))
            removed.insert(cell);
        GridGenerator::create_triangulation_with_removed_cells(full, removed, mesh);
      },
      [&](const Point<dim> &face) {
        const unsigned int side    = side_of(face, corner);
        const bool         outside = std::fabs(face[side / 2] - (side % 2) * corner[side / 2]) < 1e-9 * shape.length;
        return outside ? side : 6u;
      });
  }

  template <int dim>
  Mesh<dim> make_shape(const PlateWithHoleShape &s, const ShapeOptions &options)
  {
    demand(s.radius > 0 && s.half_width > s.radius && s.half_height > s.radius,
           "plate with hole: the radius must be positive and below half the width and half the height.");
    demand(s.radial_divisions > 0 && s.angular_divisions > 0 && s.angular_divisions % 2 == 0 && s.depth_divisions > 0,
           "plate with hole: its divisions must be positive, the angular ones even.");
    demand(dim == 2 || s.depth > 0, "plate with hole: in three dimensions its depth must be positive.");
    Point<dim>                unit;
    std::vector<unsigned int> divisions = {s.radial_divisions, s.angular_divisions};
    unit[0] = unit[1] = 1;
    if constexpr (dim == 3)
      {
        unit[2] = s.depth;
        divisions.push_back(s.depth_divisions);
      }
    // From the hole along straight rays to the edge, elements growing with the distance.
    const auto bend = [&](const Point<dim> &x) {
      const double angle = x[1] * numbers::PI / 2, part = std::pow(x[0], 1.5);
      const double edge_x = x[1] <= 0.5 ? s.half_width : 2 * (1 - x[1]) * s.half_width;
      const double edge_y = x[1] <= 0.5 ? 2 * x[1] * s.half_height : s.half_height;
      Point<dim>   bent   = x;
      bent[0]             = x[1] == 1 ? 0 : (1 - part) * s.radius * std::cos(angle) + part * edge_x;
      bent[1]             = x[1] == 0 ? 0 : (1 - part) * s.radius * std::sin(angle) + part * edge_y;
      return bent;
    };
    Names names = box_names;
    names.emplace_back("hole");
    Point<dim> corner;
    corner[0] = s.half_width;
    corner[1] = s.half_height;
    if constexpr (dim == 3)
      corner[2] = s.depth;
    return finish<dim>(
      options, names,
      [&](Triangulation<dim> &mesh) {
        GridGenerator::subdivided_hyper_rectangle(mesh, divisions, Point<dim>(), unit);
        GridTools::transform(bend, mesh);
      },
      [&](const Point<dim> &face) {
        const unsigned int side    = side_of(face, corner);
        const bool         outside = std::fabs(face[side / 2] - (side % 2) * corner[side / 2]) < 1e-9 * corner.norm();
        return outside ? side : 6u;
      });
  }

  template <int dim>
  Mesh<dim> make_shape([[maybe_unused]] const CylinderShape &s, [[maybe_unused]] const ShapeOptions &options)
  {
    if constexpr (dim == 2)
      throw base::InputError("cylinder: is a body in three dimensions. In two, take a box.");
    else
      {
        demand(s.length > 0 && s.radius > 0 && s.divisions > 0,
               "cylinder: its length, radius and divisions must be positive.");
        const Names names = {"left", "right", "side"};
        // The section is a regular polygon of 4, 8, 16 ... sides (0, 1, 2 ... refinements), inscribed in a circle so much
        // larger that it has the area of the wanted one: mass and axial stiffness are those of the round bar.
        const double sides  = 4 * std::pow(2.0, options.refinements);
        const double circle = s.radius * std::sqrt(2 * numbers::PI / (sides * std::sin(2 * numbers::PI / sides)));
        return finish<dim>(
          options, names,
          [&](Triangulation<dim> &mesh) {
            GridGenerator::subdivided_cylinder(mesh, s.divisions, circle, s.length / 2);
            GridTools::shift(Tensor<1, dim>({s.length / 2, 0, 0}), mesh);
          },
          [&](const Point<dim> &face) {
            return std::fabs(face[0]) < 1e-9 * s.length            ? 0u :
                   std::fabs(face[0] - s.length) < 1e-9 * s.length ? 1u :
                                                                     2u;
          });
      }
  }

  template Mesh<2> make_shape(const BoxShape &, const ShapeOptions &);
  template Mesh<3> make_shape(const BoxShape &, const ShapeOptions &);
  template Mesh<2> make_shape(const NotchedBeamShape &, const ShapeOptions &);
  template Mesh<3> make_shape(const NotchedBeamShape &, const ShapeOptions &);
  template Mesh<2> make_shape(const PlateWithHoleShape &, const ShapeOptions &);
  template Mesh<3> make_shape(const PlateWithHoleShape &, const ShapeOptions &);
  template Mesh<2> make_shape(const CylinderShape &, const ShapeOptions &);
  template Mesh<3> make_shape(const CylinderShape &, const ShapeOptions &);
}
