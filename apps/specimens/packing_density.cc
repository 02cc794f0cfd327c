#include "apps/specimens/packing_density.h"

#include "dem/measures/bulk_volume.h"
#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
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

    /** Of each particle half the length times area of its links [m^3]; discs as thick as the unit. */
    std::vector<double>
    halves_of_links(const dem::Packing &packing, const int dimension, const double ratio, const double gap)
    {
      dem::ParticleShape shape;
      shape.dimension = dimension;
      shape.thickness = 1;
      std::vector<double> half(packing.size(), 0.0);
      for (const dem::NeighbourPair &pair : dem::find_pairs(packing.centre, packing.radius, ratio, gap, std::nullopt))
        {
          const std::size_t first  = static_cast<std::size_t>(pair.first),
                            second = static_cast<std::size_t>(pair.second);
          const double length      = (packing.centre[second] - packing.centre[first]).norm(),
                       part        = 0.5 * length * shape.link_area(packing.radius[first], packing.radius[second]);
          half[first] += part;
          half[second] += part;
        }
      return half;
    }

    double bulk_of(const Eigen::Vector3d &box, const int dimension) { return box.head(dimension).prod(); }

    /** Inside and in the box, of what each particle has of it. */
    PackingDensity density_of(const std::vector<double> &share,
                              const dem::Packing        &packing,
                              const Eigen::Vector3d     &box,
                              const int                  dimension)
    {
      return {1 / dem::bulk_over_solid(packing.centre, packing.radius, share, dimension, 1.0),
              std::accumulate(share.begin(), share.end(), 0.0) / bulk_of(box, dimension)};
    }

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
    return density_of(solids_of(packing, dimension), packing, box, dimension);
  }

  double linked_part(
    const dem::Packing &packing, const Eigen::Vector3d &box, const int dimension, const double ratio, const double gap)
  {
    const PackingDensity links = density_of(halves_of_links(packing, dimension, ratio, gap), packing, box, dimension);
    return links.whole / links.inside;
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
