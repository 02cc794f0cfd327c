#include "base/errors.h"
#include "fem/mesh/ball_mesh.h"
#include "fem/mesh/shapes.h"
#include "fem/mesh/sides.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    using Names = std::vector<std::string>;

    void check(const NamedBox &box, const unsigned int dim)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!(box.size[d] > 0) || box.divisions[d] == 0)
          throw base::InputError("box " + box.name + ": its size and divisions must be positive.");
    }

    template <int dim>
    void make_box(const NamedBox &box, Triangulation<dim> &part)
    {
      Point<dim>                corner, opposite;
      std::vector<unsigned int> divisions;
      for (unsigned int d = 0; d < dim; ++d)
        {
          corner[d]   = box.corner[d];
          opposite[d] = box.corner[d] + box.size[d];
          divisions.push_back(box.divisions[d]);
        }
      GridGenerator::subdivided_hyper_rectangle(part, divisions, corner, opposite, true);
    }

    /// More than touching, up to rounding.
    bool overlap(const NamedBox &a, const NamedBox &b, const unsigned int dim)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double slack = 1e-9 * std::min(a.size[d], b.size[d]);
          if (a.corner[d] + a.size[d] <= b.corner[d] + slack || b.corner[d] + b.size[d] <= a.corner[d] + slack)
            return false;
        }
      return true;
    }

    void refuse_overlaps(const std::vector<NamedBox> &boxes, const unsigned int dim)
    {
      for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = a + 1; b < boxes.size(); ++b)
          if (overlap(boxes[a], boxes[b], dim))
            throw base::InputError("boxes " + boxes[a].name + " and " + boxes[b].name +
                                   " overlap. Bodies may touch, no more.");
    }

    void check(const NamedBall &ball)
    {
      if (!(ball.radius > 0) || !(ball.fineness >= 1))
        throw base::InputError("ball " + ball.name + ": its radius must be positive, and its fineness at least 1.");
      if (ball.divisions == 0 || ball.divisions % 2 != 0)
        throw base::InputError("ball " + ball.name + ": its divisions must be even, and at least 2.");
    }

    void
    refuse_overlaps(const std::vector<NamedBall> &balls, const std::vector<NamedBox> &boxes, const unsigned int dim)
    {
      const auto refuse = [](const std::string &a, const std::string &b) {
        throw base::InputError("bodies " + a + " and " + b + " overlap. Bodies may touch, no more.");
      };
      for (std::size_t a = 0; a < balls.size(); ++a)
        {
          const NamedBall &ball = balls[a];
          for (std::size_t b = a + 1; b < balls.size(); ++b)
            {
              double square = 0;
              for (unsigned int d = 0; d < dim; ++d)
                square += (ball.centre[d] - balls[b].centre[d]) * (ball.centre[d] - balls[b].centre[d]);
              if (std::sqrt(square) < (ball.radius + balls[b].radius) * (1 - 1e-9))
                refuse(ball.name, balls[b].name);
            }
          for (const NamedBox &box : boxes)
            {
              double square = 0; // of the distance from the box
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double nearest = std::clamp(ball.centre[d], box.corner[d], box.corner[d] + box.size[d]);
                  square += (ball.centre[d] - nearest) * (ball.centre[d] - nearest);
                }
              if (std::sqrt(square) < ball.radius * (1 - 1e-9))
                refuse(ball.name, box.name);
            }
        }
    }

    /// Elements of all bodies, side by side: no vertex is shared.
    template <int dim>
    struct Coarse
    {
      std::vector<Point<dim>>    vertices;
      std::vector<CellData<dim>> cells;
      SubCellData                faces;

      void
      add(const Triangulation<dim> &part, const types::material_id material, const types::boundary_id first_boundary)
      {
        auto [places, elements, sides] = GridTools::get_coarse_mesh_description(part);
        const auto moved               = [&](auto &pieces) {
          for (auto &piece : pieces)
            for (unsigned int &vertex : piece.vertices)
              vertex += static_cast<unsigned int>(vertices.size());
        };
        moved(elements);
        for (CellData<dim> &element : elements)
          element.material_id = material;
        auto &outer = side_list(sides);
        moved(outer);
        for (auto &side : outer)
          side.boundary_id += first_boundary;
        append(cells, elements);
        append(side_list(faces), outer);
        append(vertices, places);
      }

    private:
      static auto &side_list(SubCellData &of)
      {
        if constexpr (dim == 2)
          return of.boundary_lines;
        else
          return of.boundary_quads;
      }

      template <typename List>
      static void append(List &whole, const List &part)
      {
        whole.insert(whole.end(), part.begin(), part.end());
      }
    };
  }

  template <int dim>
  Mesh<dim> make_shape(const BodiesShape &shape, const ShapeOptions &options)
  {
    if (shape.boxes.empty() && shape.balls.empty())
      throw base::InputError("bodies: there is none.");
    for (const NamedBox &box : shape.boxes)
      check(box, dim);
    for (const NamedBall &ball : shape.balls)
      check(ball);
    refuse_overlaps(shape.boxes, dim);
    refuse_overlaps(shape.balls, shape.boxes, dim);

    Coarse<dim>                               coarse;
    std::map<std::string, types::boundary_id> boundaries;
    std::map<std::string, types::material_id> materials;
    const auto add = [&](const Triangulation<dim> &part, const std::string &material, const Names &sides) {
      const auto first = static_cast<types::boundary_id>(boundaries.size());
      coarse.add(part, materials.emplace(material, materials.size()).first->second, first);
      for (std::size_t side = 0; side < sides.size(); ++side)
        if (!boundaries.emplace(sides[side], first + side).second)
          throw base::InputError("bodies: two of them are named " + sides[side] + ".");
    };
    for (const NamedBox &box : shape.boxes)
      {
        Triangulation<dim> part;
        make_box(box, part);
        Names sides;
        for (unsigned int side = 0; side < 2 * dim; ++side)
          sides.push_back(box.name + " " + side_names.at(side).word);
        add(part, box.material, sides);
      }
    for (const NamedBall &ball : shape.balls)
      {
        Triangulation<dim> part;
        make_ball(ball, part);
        add(part, ball.material, {ball.name});
      }
    const auto build = [&](Triangulation<dim> &mesh) {
      Triangulation<dim> whole;
      whole.create_triangulation(coarse.vertices, coarse.cells, coarse.faces);
      mesh.copy_triangulation(whole);
      mesh.refine_global(options.refinements);
    };
    Mesh<dim> mesh = make_mesh<dim>(build, options.family, options.communicator, Bodies::several);
    name_by_axis(boundaries);
    mesh.boundaries = boundaries;
    mesh.materials  = materials;
    return mesh;
  }

  template Mesh<2> make_shape(const BodiesShape &, const ShapeOptions &);
  template Mesh<3> make_shape(const BodiesShape &, const ShapeOptions &);
}
