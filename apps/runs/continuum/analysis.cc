#include "apps/runs/continuum/analysis.h"

#include <algorithm>

namespace apps
{
  void visit_vector(base::StateVisitor &visitor, const std::string &name, fem::Vector &vector)
  {
    base::Column values(vector.begin(), vector.begin() + vector.locally_owned_size());
    visitor.column(name, values);
    std::copy(values.begin(), values.end(), vector.begin());
  }

  template <int dim>
  void visit_histories(base::StateVisitor &visitor, fem::Solid<dim> &solid)
  {
    solid.visit_state(visitor);
  }

  template void visit_histories(base::StateVisitor &, fem::Solid<2> &);
  template void visit_histories(base::StateVisitor &, fem::Solid<3> &);
} // namespace apps
