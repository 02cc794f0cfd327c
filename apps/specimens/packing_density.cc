#include "apps/specimens/packing_density.h"

#include "dem/measures/bulk_volume.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace apps
{
  namespace
  {
    std::vector<double> solids_of(const dem::Packing &packing, const int dimension)
    {
      std::vector<double> solid;
      for (const double r : packing.radius)
        solid.push_back(dimension == 3 ? 4.0 / 3.0 * M_PI * r * r * r : M_PI * r * r);
      return solid;
    }

    double bulk_of(const Eigen::Vector3d &box, const int dimension) { return box.head(dimension).prod(); }

    Eigen::Vector3d box_around(const dem::Packing &packing)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      Eigen::Vector3d  lower = Eigen::Vector3d::Constant(infinity), upper = -lower;
      for (std::size_t i = 0; i < packing.size(); ++i)
        {
          lower = lower.cwiseMin((packing.centre[i].array() - packing.radius[i]).matrix());
          upper = upper.cwiseMax((packing.centre[i].array() + packing.radius[i]).matrix());
        }
      return upper - lower;
    }
  } // namespace

  bool PackingDensity::has_sparse_faces() const
  {
    constexpr double of_small_bodies = 0.85; // cubes of some twenty diameters are above it
    return whole < of_small_bodies * inside;
  }

  PackingDensity density_in(const dem::Packing &packing, const Eigen::Vector3d &box, const int dimension)
  {
    const std::vector<double> solid = solids_of(packing, dimension);
    const double              all   = std::accumulate(solid.begin(), solid.end(), 0.0);
    return {1 / dem::bulk_over_solid(packing.centre, packing.radius, solid, dimension, 1.0),
            all / bulk_of(box, dimension)};
  }

  std::string density_line(const dem::Packing &packing, const int dimension)
  {
    if (!packing.bodies.empty())
      return "";
    if (packing.periodic_cell)
      {
        const std::vector<double> solid = solids_of(packing, dimension);
        return fmt::format("  packed       {:.3f} of the periodic cell\n",
                           std::accumulate(solid.begin(), solid.end(), 0.0) /
                             bulk_of(*packing.periodic_cell, dimension));
      }
    const PackingDensity density = density_in(packing, box_around(packing), dimension);
    return fmt::format("  packed       {:.3f} inside, {:.3f} of the box around all\n", density.inside, density.whole);
  }
} // namespace apps
