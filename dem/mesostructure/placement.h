#pragma once

#include "dem/mesostructure/mesostructure.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  /** Shapes of aggregates, all of the volume of the sphere of their size. */
  struct AggregateShape
  {
    enum class Kind
    {
      sphere,
      ellipsoid,
      polyhedron
    };

    Kind   kind       = Kind::sphere;
    double elongation = 1, flatness = 1; ///< middle over longest, shortest over middle axis, in [0.1, 1]
    int    corners = 12;                 ///< of a polyhedron
  };

  struct AggregatePlacement
  {
    Eigen::Vector3d box      = Eigen::Vector3d::Zero(); ///< [m]
    bool            periodic = false;                   ///< off: all lie wholly inside
    AggregateShape  shape;
    double          clearance = 0.05; ///< between two, of the sum of their radii, in [0.001, 1]
    double          distance  = 0;    ///< between two, at least [m]
    double          wall      = 0;    ///< between one and a face of the box [m]
    std::int64_t    tries     = 1000; ///< places for each
    int             restarts  = 10;
    std::uint64_t   seed      = 1;
  };

  /** Where the aggregates came to lie, and how. */
  struct PlacedAggregates
  {
    Mesostructure structure;
    int           restarts = 0;     ///< after which all found a place at random
    bool          grown    = false; ///< none did: placed smaller, and grown among each other
  };

  /**
   * Aggregates at random places and in random directions, the largest first, each drawn again until it overlaps none before it; where one
   * finds no place all begin anew. Where that comes to nothing as well (beyond some 35 % of the box), all are placed smaller, and grow while
   * those that come to overlap push each other away (doc/theory/mesostructure.md, 3). The same for a seed.
   *
   * @param diameters of the spheres of their volume [m], > 0
   * @throws base::InputError for parameters out of range, an aggregate larger than the box, or where they cannot grow to their size, with
   *         the content that was reached
   */
  PlacedAggregates place_inclusions(const std::vector<double> &diameters, const AggregatePlacement &parameters);
} // namespace dem
