#include "dem/peridynamics/fictitious_density.h"

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  base::Column bound_of_stiffness(const Bonds &bonds)
  {
    const Grid                        &grid = bonds.grid();
    const auto                         d    = static_cast<std::size_t>(grid.dimension());
    std::vector<std::array<double, 3>> row(grid.places(), {0, 0, 0});
    bonds.each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
      const Offset &offset = bonds.offsets()[o];
      double        all    = 0;
      for (std::size_t a = 0; a < d; ++a)
        all += std::abs(offset.steps[a]) / offset.length;
      const double stiffness = bonds.stiffness()[bond] / (offset.length * grid.spacing());
      for (std::size_t a = 0; a < d; ++a)
        for (const std::size_t end : {i, j})
          row[end][a] += 2 * stiffness * std::abs(offset.steps[a]) / offset.length * all;
    });
    base::Column bound(grid.places(), 1.0);
    for (const std::size_t i : grid.nodes())
      if (const double most = *std::max_element(row[i].begin(), row[i].end()); most > 0)
        bound[i] = most / grid.volume()[i];
    return bound;
  }

  double constant_bound(const Bonds &bonds)
  {
    const Grid     &grid = bonds.grid();
    const double    pi = std::acos(-1.0), delta = bonds.horizon();
    const double    family = grid.dimension() == 1 ? 2 * delta :
                             grid.dimension() == 2 ? pi * delta * delta :
                                                     4 * pi / 3 * delta * delta * delta;
    const Material &m      = bonds.material();
    const double    c      = bond_constant(grid.body().space, m.model, m.young_modulus, delta, grid.body().section());
    return 5 * family * grid.body().section() * c / (m.model == BondModel::prototype ? grid.spacing() : 1.0);
  }
} // namespace dem::peridynamics
