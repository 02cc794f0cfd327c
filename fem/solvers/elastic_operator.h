#pragma once

#include "fem/solid/element_blocks.h"

#include <deal.II/base/subscriptor.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace fem
{
  /// Stiffness of elements in blocks as an operator: held displacements neither act nor answer, their diagonal is 1.
  template <typename Number>
  class ElasticOperator : public dealii::Subscriptor
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<Number>;
    using value_type = Number;
    using size_type  = dealii::types::global_dof_index;

    /// @param held positions of the locally owned held displacements. The blocks must outlive the operator.
    void reinit(const std::vector<ElementBlocksOf<Number>>                       &elements_,
                const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout_,
                const std::vector<unsigned int>                                  &held_)
    {
      elements = &elements_;
      layout   = layout_;
      held     = held_;
      saved.resize(held.size());
    }

    void initialize_dof_vector(VectorType &v) const { v.reinit(layout); }

    size_type m() const { return layout->size(); }
    size_type n() const { return layout->size(); }

    void vmult(VectorType &result, const VectorType &x) const
    {
      // The held entries are blanked in place: a copy of the vector would cost as much as the product.
      auto &given = const_cast<VectorType &>(x);
      for (std::size_t i = 0; i < held.size(); ++i)
        {
          saved[i]                     = given.local_element(held[i]);
          given.local_element(held[i]) = 0;
        }
      x.update_ghost_values();
      result = 0;
      for (const auto &e : *elements)
        add_internal_force(e, x.begin(), result.begin());
      result.compress(dealii::VectorOperation::add);
      x.zero_out_ghost_values();
      for (std::size_t i = 0; i < held.size(); ++i)
        {
          given.local_element(held[i])  = saved[i];
          result.local_element(held[i]) = saved[i];
        }
    }

    /// Read by deal.II's smoothers of a matrix when they are given no diagonal; ours always are.
    Number el(size_type, size_type) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
      return 0;
    }

    void diagonal(VectorType &result) const
    {
      initialize_dof_vector(result);
      for (const auto &e : *elements)
        add_diagonal(e, result.begin());
      result.compress(dealii::VectorOperation::add);
      for (const unsigned int i : held)
        result.local_element(i) = 1;
    }

  private:
    const std::vector<ElementBlocksOf<Number>>                *elements = nullptr;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<unsigned int>                                  held;
    mutable std::vector<Number>                                saved;
  };
}
