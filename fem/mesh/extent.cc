#include "fem/mesh/extent.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace fem
{
  using namespace dealii;

  template <int dim>
  Extent<dim> extent_of(const Mesh<dim> &mesh)
  {
    const MPI_Comm communicator = mesh.triangulation->get_communicator();
    Extent<dim>    box;
    for (int d = 0; d < dim; ++d)
      {
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const auto &vertex : mesh.triangulation->get_vertices())
          {
            low  = std::min(low, vertex[d]);
            high = std::max(high, vertex[d]);
          }
        box.low[d]  = Utilities::MPI::min(low, communicator);
        box.high[d] = Utilities::MPI::max(high, communicator);
      }
    return box;
  }

  template Extent<2> extent_of(const Mesh<2> &);
  template Extent<3> extent_of(const Mesh<3> &);
}
