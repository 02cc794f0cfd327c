#include "apps/drivers/continuum/analysis.h"

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
    base::Column values;
    solid.visit_histories([&](const fem::PointQuantity &of, const double *first) {
      values.insert(values.end(), first, first + of.values());
    });
    visitor.column("histories", values);
    std::size_t next = 0;
    solid.visit_histories([&](const fem::PointQuantity &of, double *first) {
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(next), of.values(), first);
      next += static_cast<std::size_t>(of.values());
    });
  }

  template void visit_histories(base::StateVisitor &, fem::Solid<2> &);
  template void visit_histories(base::StateVisitor &, fem::Solid<3> &);
} // namespace apps
