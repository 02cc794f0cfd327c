#pragma once

#include "fem/points/material_points.h"
#include "fem/solid/element_blocks.h"

#include <deal.II/fe/fe_values.h>

#include <map>

namespace fem
{
  struct SolidOptions;
  template <int dim>
  class Solid;

  /// Collects the elements of a solid, or of a coarser level of its mesh, into blocks: one for each material and geometry.
  template <int dim, typename Number>
  class BlockBuilder
  {
  public:
    explicit BlockBuilder(const Solid<dim> &solid);

    /// @param positions of the degrees of freedom of the element in the displacement array, in the element's order.
    void add(const typename dealii::Triangulation<dim>::cell_iterator &cell,
             const std::vector<unsigned int>                          &positions,
             const MaterialPoints                                     &material);

    std::vector<ElementBlocksOf<Number>> take() { return std::move(blocks); }

  private:
    ElementBlocksOf<Number> &block_for(const MaterialPoints &material, BlockGeometry geometry, std::size_t &lane);

    /// Inverse Jacobians and volumes at the 8 points of a hexahedron. @return whether all Jacobians are one.
    bool find_jacobians(const typename dealii::Triangulation<dim>::cell_iterator &cell);

    /// Lets only what counts of the points' volumes count. @return whether all of it does. @pre find_jacobians()
    bool share_volumes(const typename dealii::Triangulation<dim>::cell_iterator &cell);

    void store_jacobians(ElementBlocksOf<Number> &e, std::size_t lane) const;
    void store_gradients(ElementBlocksOf<Number> &e, std::size_t lane) const;

    const dealii::FiniteElement<dim>    &fe;
    const SolidOptions                  &options;
    dealii::FEValues<dim>                values;
    const unsigned int                   nodes, n_points;
    const bool                           trilinear;
    const double                         thickness;
    std::vector<ElementBlocksOf<Number>> blocks;
    std::map<std::pair<const MaterialPoints *, BlockGeometry>, std::pair<std::size_t, std::size_t>>
                                         known; // block, elements
    std::array<std::array<double, 9>, 8> inverse{};
    std::array<double, 8>                volume{};
  };
}
