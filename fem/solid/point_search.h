#pragma once

#include "fem/solid/solid.h"

#include <array>
#include <optional>

namespace fem
{
  /// A place in an element: how the displacements of the element's nodes make that of the place, u = sum weight_i u_i.
  template <int dim>
  struct PlaceInElement
  {
    typename dealii::DoFHandler<dim>::active_cell_iterator        cell;
    std::vector<std::array<dealii::types::global_dof_index, dim>> nodes;   ///< displacements of each node, by component
    std::vector<double>                                           weights; ///< of each node [-]
    std::vector<dealii::Tensor<1, dim>>                           gradients; ///< of the weights with the place [1/m]
  };

  /**
   * Finds the element around a place among those of this rank: a tree of their bounding boxes, so that a place costs the logarithm of
   * their number. The mesh must stay as it is.
   */
  template <int dim>
  class PointSearch
  {
  public:
    explicit PointSearch(const Solid<dim> &solid);
    ~PointSearch();

    /**
     * Of several elements that share the place, the one in which it lies deepest, and of equals the first; nothing where none of this
     * rank has it. @param where undeformed [m]; 1e-8 of an element outside still counts as inside
     */
    std::optional<PlaceInElement<dim>> find(const dealii::Point<dim> &where) const;

  private:
    struct Tree;
    const Solid<dim>     &solid;
    std::unique_ptr<Tree> tree;
  };
}
