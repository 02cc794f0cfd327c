#include "fem/mesh/bodies.h"
#include "fem/mesh/shapes.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    constexpr const char *side_names[6] = {"left", "right", "bottom", "top", "back", "front"};

    void check(const NamedBox &box, const unsigned int dim)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!(box.size[d] > 0) || box.divisions[d] == 0)
          throw std::invalid_argument("box " + box.name + ": its size and divisions must be positive.");
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
            throw std::invalid_argument("boxes " + boxes[a].name + " and " + boxes[b].name +
                                        " overlap. Bodies may touch, no more.");
    }

    /// Elements of all boxes, side by side: no vertex is shared.
    template <int dim>
    struct Coarse
    {
      std::vector<Point<dim>>    vertices;
      std::vector<CellData<dim>> cells;
      SubCellData                faces;

      void add(const NamedBox &box, const types::material_id material, const types::boundary_id first_boundary)
      {
        Point<dim>                corner, opposite;
        std::vector<unsigned int> divisions;
        for (unsigned int d = 0; d < dim; ++d)
          {
            corner[d]   = box.corner[d];
            opposite[d] = box.corner[d] + box.size[d];
            divisions.push_back(box.divisions[d]);
          }
        Triangulation<dim> part;
        GridGenerator::subdivided_hyper_rectangle(part, divisions, corner, opposite, true);
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
  Mesh<dim> make_shape(const BoxesShape &shape, const ShapeOptions &options)
  {
    if (shape.boxes.empty())
      throw std::invalid_argument("boxes: there is none.");
    for (const NamedBox &box : shape.boxes)
      check(box, dim);
    refuse_overlaps(shape.boxes, dim);

    Coarse<dim>                               coarse;
    std::map<std::string, types::boundary_id> boundaries;
    std::map<std::string, types::material_id> materials;
    for (const NamedBox &box : shape.boxes)
      {
        const auto material = materials.emplace(box.material, materials.size()).first->second;
        const auto first    = static_cast<types::boundary_id>(boundaries.size());
        coarse.add(box, material, first);
        for (unsigned int side = 0; side < 2 * dim; ++side)
          if (!boundaries.emplace(box.name + " " + side_names[side], first + side).second)
            throw std::invalid_argument("boxes: two of them are named " + box.name + ".");
      }
    const auto build = [&](Triangulation<dim> &mesh) {
      Triangulation<dim> whole;
      whole.create_triangulation(coarse.vertices, coarse.cells, coarse.faces);
      mesh.copy_triangulation(whole);
      mesh.refine_global(options.refinements);
    };
    Mesh<dim> mesh  = make_mesh_of_bodies<dim>(build, options.family, options.communicator);
    mesh.boundaries = boundaries;
    mesh.materials  = materials;
    return mesh;
  }

  template Mesh<2> make_shape(const BoxesShape &, const ShapeOptions &);
  template Mesh<3> make_shape(const BoxesShape &, const ShapeOptions &);
}
