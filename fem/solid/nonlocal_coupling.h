#pragma once

#include "fem/points/averaged_points.h"
#include "fem/solid/solid.h"

#include <map>

namespace fem
{
  /**
   * Couples elements beyond their common nodes where the damage of points is averaged over a length: the pass before a sweep, and the part
   * of the consistent tangent that reaches over elements (Jirasek and Patzak, 2002; doc/theory/late-transfers.md, 4). One rank only.
   */
  template <int dim>
  class NonlocalCoupling
  {
  public:
    /// Finds the neighbours of the points. @throws base::InputError on several ranks
    explicit NonlocalCoupling(const Solid<dim> &solid);

    /// Whether the solid has points that need it.
    static bool wanted(const Solid<dim> &solid);

    /// First pass over the points at a displacement, and the averages. @throws MaterialFailure
    void flow(const Vector &displacement, bool with_tangent);

    /// Entries of the tangent that plain elements do not have.
    void add_to(dealii::TrilinosWrappers::SparsityPattern &pattern) const;

    /// After the second pass: adds to tangent and products of the sweep what acts through the averages.
    void add_tangent(const Vector &displacement, const Sweep &wanted);

  private:
    struct Element
    {
      typename dealii::DoFHandler<dim>::active_cell_iterator cell;
      std::vector<dealii::types::global_dof_index>           dofs;
      AveragedPoints                                        *points; ///< nullptr: local material
      std::size_t                                            first;  ///< of its points
      std::vector<std::size_t>                               neighbours;
      Eigen::MatrixXd force_by_average, variable_by_displacement; ///< a column per point
    };

    void find_elements();
    void find_neighbours();
    void
    add_block(const Element &rows, const Element &columns, const Eigen::MatrixXd &block, const Sweep &wanted) const;

    /// visit(element, kernel, weights of integration) for every element with averaged points, its displacements taken.
    template <typename Visit>
    void visit_elements(const Vector &displacement, const Visit &visit);

    const Solid<dim>                                    &solid;
    std::vector<Element>                                 elements;
    std::map<AveragedPoints *, std::vector<std::size_t>> element_of; ///< of each point
  };
}
