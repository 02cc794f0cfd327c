#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dem
{
  /** The equilibrium from which a specimen starts, and how it was found. */
  struct InitialEquilibrium
  {
    double largest_displacement = 0; ///< of any particle from its place in the packing [m]
    /** Forces (and moments, over the mean arm) left over on free particles, over link forces; both root of sums of squares. */
    double unbalanced_ratio = 0;
    /** What of it the rounding of the particles' coordinates explains: a strain is known to 1e-16 of coordinate over length. */
    double      rounding       = 0;
    double      largest_strain = 0; ///< in tension, of any link, over the strain at which it would damage [-]
    int         solutions      = 0; ///< of the linearised equilibrium; the geometry follows
    std::size_t undetermined =
      0; ///< particles with a motion that no link resists and nothing loads; they stay where they are
    /** Numbers of the particles that find no equilibrium, as on a hinge of two links: their weight acts with the first step. */
    std::vector<std::int32_t> unsettled;
    std::string               solver; ///< method, iterations, residual of the first solution
  };

  constexpr double wanted_unbalanced_ratio = 1e-10; ///< at which one is found, unless rounding allows none

  /** Is told before each solution what has been found so far: the search may last. */
  using EquilibriumWatch = std::function<void(const InitialEquilibrium &so_far)>;
} // namespace dem
