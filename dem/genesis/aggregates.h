#pragma once

#include "dem/genesis/grading.h"
#include "dem/genesis/polygon.h"
#include "dem/genesis/vessel.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dem
{
  /** Polygonal aggregates of a plane section, as Su et al. (2021) have them. */
  struct AggregateParameters
  {
    double              content = 0.75; ///< P_k: part of the volume that is aggregate of any size
    std::vector<double> bounds;         ///< of the classes of sizes that are modelled, ascending [m]
    int                 fewest_corners = 4, most_corners = 6;
    double              clearance    = 0;    ///< between two, at least [m]
    bool                middle_sizes = true; ///< all of a class have its middle size; off: evenly spread over the class
    std::uint64_t       seed         = 1;
  };

  /**
   * As many polygons as the grading gives, each of the area of a circle of its size, at random places wholly inside a box and apart from
   * each other, the largest first. After 100000 draws without a place all begin anew, with other random numbers.
   *
   * @throws base::InputError where ten such beginnings have found no place for all
   */
  std::vector<Polygon> place_aggregates(const AggregateParameters &parameters, const Vessel &box);

  /**
   * Particles whose centre lies in a polygon (of two that share an edge the lower number) become pebbles of its body, and are of the
   * material `inside`, all others of `outside` (doc/theory/genesis.md, 6). @throws base::InputError for a polygon with fewer than three pebbles
   */
  void make_pebbles(Packing                    &packing,
                    const std::vector<Polygon> &polygons,
                    const std::string          &outside,
                    const std::string          &inside);
} // namespace dem
