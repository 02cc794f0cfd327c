#include "fem/solid/point_search.h"

#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>

namespace fem
{
  using namespace dealii;

  namespace
  {
    constexpr double tolerance = 1e-8; // in the unit element, and of its extent

    /// How far a unit point lies outside the reference element, 0 inside.
    template <int dim>
    double distance_outside(const Point<dim> &p, const ElementFamily family)
    {
      double outside = 0, sum = 0;
      for (int d = 0; d < dim; ++d)
        {
          sum += p[d];
          outside = std::max(outside, -p[d]);
          if (family == ElementFamily::hypercube)
            outside = std::max(outside, p[d] - 1);
        }
      return family == ElementFamily::simplex ? std::max(outside, sum - 1) : outside;
    }

    template <int dim>
    PlaceInElement<dim> place_in(const Solid<dim>                                     &solid,
                                 const typename DoFHandler<dim>::active_cell_iterator &cell,
                                 const Point<dim>                                     &unit)
    {
      const auto         &fe = solid.dofs().get_fe();
      const unsigned int  n  = fe.n_dofs_per_cell() / dim;
      PlaceInElement<dim> place{cell, {}, std::vector<double>(n), std::vector<Tensor<1, dim>>(n)};
      place.nodes.resize(n);
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      cell->get_dof_indices(indices);
      FEValues<dim> values(solid.mapping(), fe, Quadrature<dim>(unit), update_gradients);
      values.reinit(cell);
      for (unsigned int i = 0; i < indices.size(); ++i)
        {
          const auto [component, node] = fe.system_to_component_index(i);
          place.nodes[node][component] = indices[i];
          place.weights[node]          = fe.shape_value(i, unit);
          place.gradients[node]        = values.shape_grad(i, 0);
        }
      return place;
    }
  }

  template <int dim>
  struct PointSearch<dim>::Tree
  {
    using Cell = typename DoFHandler<dim>::active_cell_iterator;
    std::vector<Cell>                                                cells;
    std::vector<BoundingBox<dim>>                                    boxes;
    decltype(pack_rtree_of_indices(std::vector<BoundingBox<dim>>())) index;

    explicit Tree(const Solid<dim> &solid)
      : cells(cells_of(solid))
      , boxes(boxes_of(cells))
      , index(pack_rtree_of_indices(boxes))
    {
    }

    static std::vector<Cell> cells_of(const Solid<dim> &solid)
    {
      std::vector<Cell> cells;
      for (const auto &cell : solid.dofs().active_cell_iterators())
        if (cell->is_locally_owned())
          cells.push_back(cell);
      return cells;
    }

    static std::vector<BoundingBox<dim>> boxes_of(const std::vector<Cell> &cells)
    {
      std::vector<BoundingBox<dim>> boxes;
      for (const Cell &cell : cells)
        {
          boxes.push_back(cell->bounding_box());
          boxes.back().extend(tolerance * cell->diameter());
        }
      return boxes;
    }
  };

  template <int dim>
  PointSearch<dim>::PointSearch(const Solid<dim> &solid_)
    : solid(solid_)
    , tree(std::make_unique<Tree>(solid_))
  {
  }

  template <int dim>
  PointSearch<dim>::~PointSearch() = default;

  template <int dim>
  std::optional<PlaceInElement<dim>> PointSearch<dim>::find(const Point<dim> &where) const
  {
    namespace index = boost::geometry::index;
    std::vector<std::size_t> candidates;
    index::query(tree->index, index::intersects(where), std::back_inserter(candidates));
    std::sort(candidates.begin(), candidates.end());
    double                     least = tolerance;
    std::optional<std::size_t> home;
    Point<dim>                 unit;
    for (const std::size_t c : candidates)
      try
        {
          const Point<dim> p       = solid.mapping().transform_real_to_unit_cell(tree->cells[c], where);
          const double     outside = distance_outside(p, solid.mesh().family);
          if (outside < least)
            {
              least = outside;
              unit  = p;
              home  = c;
            }
        }
      catch (const typename Mapping<dim>::ExcTransformationFailed &)
        {
        }
    if (!home)
      return std::nullopt;
    return place_in(solid, tree->cells[*home], unit);
  }

  template class PointSearch<2>;
  template class PointSearch<3>;
}
