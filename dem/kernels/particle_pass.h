#pragma once

#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /** Particles that one thread moves in a row; the unit of deterministic sums. */
  constexpr std::size_t particles_per_block = 256;

  /** What a block of particles reports besides its motion. Padded to a cache line: one writer each. */
  struct alignas(64) ParticleBlockAccount
  {
    double damping_before = 0; ///< work of damping forces of this step over the half step before t_n, < 0 [J]
    double damping_after  = 0; ///< the same over the half step after t_n
    double kinetic        = 0; ///< 1/2 m v(n-1/2).v(n+1/2) + the same of rotation [J]; in a cell of the fluctuation
    double pushing_before = 0; ///< work of forces from outside over the half step before t_n [J]
    double pushing_after  = 0; ///< the same over the half step after t_n
    double fastest =
      0; ///< not below the largest squared displacement of the step (sum of the components' largest) [m^2]
  };

  /** Some blocks in a row. */
  struct ParticleBlocks
  {
    std::size_t begin = 0, end = 0;
  };

  /** The halves of the steps that meet at t_n [s]; equal unless the length of the step has changed there. */
  struct StepHalves
  {
    double before = 0, after = 0;
  };

  /**
 * Second of the two passes: every particle adds up its links in a fixed order (its own, then those of which it is the second end,
 * then contacts the same way), its weight and what pushes it from outside, and takes a leap-frog step with local damping
 * (doc/theory/integration.md, 1): a kick over both halves, a drift over twice the second.
 *
 * In a periodic cell the velocity is the fluctuation u = v - G x, and the step is u += dt a, x += dt (G x + u). In the
 * velocities themselves (doc/theory/periodic-cell.md, 1): v += (G_new - G_old) x_n + dt G_old v_(n-1/2) + dt a leaves u_(n+1/2) =
 * u_(n-1/2) + dt a exactly. Damping and kinetic energy are those of u.
 *
 * @param blocks   of particles that are moved
 * @param contacts may be null: there are none
 * @param surfaces force (3) [N] | moment (3) [N m] | 0 0 of surfaces on each particle; looked at by a pass for touched ones only
 * @param gravity  acceleration [m/s^2]; not looked at by a pass without weight
 */
  using ParticlePass = void (*)(Particles                         &particles,
                                const LinkSet                     &bonds,
                                const LinkSet                     *contacts,
                                const base::Column                &surfaces,
                                const StepHalves                  &step,
                                double                             damping,
                                const Eigen::Vector3d             &gravity,
                                const ParticleBlocks              &blocks,
                                std::vector<ParticleBlockAccount> &accounts);

  /** How particles move on: what the pass is compiled for. */
  enum class Surroundings
  {
    free,
    weight,  ///< every particle weighs
    pushed,  ///< every particle weighs, and forces from outside push some
    touched, ///< surfaces touch some, besides weight and push
    periodic ///< in a cell, where nothing can weigh: it would fall for ever
  };

  /** The pass compiled for what the specimen has. @param moments some links carry moments */
  ParticlePass
  select_particle_pass(bool contacts, bool damped, bool equal_radii, bool moments, Surroundings surroundings);

  inline std::size_t particle_blocks(const std::size_t particles)
  {
    return (particles + particles_per_block - 1) / particles_per_block;
  }
} // namespace dem
