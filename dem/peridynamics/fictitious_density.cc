#include "dem/peridynamics/fictitious_density.h"

#include <cmath>
#include <vector>

namespace dem::peridynamics
{
  base::Column bound_of_stiffness(const Bonds &bonds)
  {
    const Grid                  &grid = bonds.grid();
    const auto                   d    = static_cast<std::size_t>(grid.dimension());
    std::vector<Eigen::Matrix3d> own(grid.places(), Eigen::Matrix3d::Zero()); // block of the node itself
    Field                        others = grid.field(); // magnitudes in the blocks of its neighbours
    bonds.each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
      const Offset         &offset = bonds.offsets()[o];
      const Eigen::Vector3d e      = Eigen::Vector3d(offset.steps[0], offset.steps[1], offset.steps[2]) / offset.length;
      const Eigen::Matrix3d block  = bonds.stiffness()[bond] / (offset.length * grid.spacing()) * e * e.transpose();
      for (const std::size_t end : {i, j})
        {
          own[end] += block;
          others.add(end, block.cwiseAbs().rowwise().sum());
        }
    });
    base::Column bound(grid.places(), 1.0);
    for (const std::size_t i : grid.nodes())
      {
        // Neighbours on opposite sides cancel in the node's own block, but for its diagonal.
        const Eigen::Vector3d rows = own[i].cwiseAbs().rowwise().sum() + others.at(i);
        if (const double most = rows.head(static_cast<Eigen::Index>(d)).maxCoeff(); most > 0)
          bound[i] = most / grid.volume()[i];
      }
    return bound;
  }

  double constant_bound(const Bonds &bonds)
  {
    const Grid  &grid = bonds.grid();
    const double pi = std::acos(-1.0), delta = bonds.horizon();
    const double family = grid.dimension() == 1 ? 2 * delta :
                          grid.dimension() == 2 ? pi * delta * delta :
                                                  4 * pi / 3 * delta * delta * delta;
    const double c =
      bond_constant(grid.body().space, bonds.model(), bonds.mixture().largest_modulus(), delta, grid.body().section());
    return 5 * family * grid.body().section() * c / (bonds.model() == BondModel::prototype ? grid.spacing() : 1.0);
  }
} // namespace dem::peridynamics
