#pragma once

#include "dem/laws/cpm_table.h"
#include "dem/links.h"
#include "dem/particles.h"

#include <cstdint>

namespace dem
{
  /**
 * Stable step from per-particle stiffness, min over P of sqrt(2 m_P / sum_{c in P} kappa_c) [s], a rigorous lower bound of the
 * critical step (element eigenvalue theorem; mesoscale specification (5.1)).
 *
 * kappa_c = max(k_N, k_T (1 + m d^2/I)) of a link seen from the particle; links count with their undamaged stiffness, so the bound
 * stays valid while they soften. Infinite when no particle has a link.
 *
 * @param contacts may be null
 */
  double stable_step(
    const Particles &particles, const LinkSet &bonds, const LinkSet *contacts, const CpmTable &laws, bool rotations);

  /** The same bound of one particle alone [s], in time proportional to its links. @pre it has one */
  double stable_step_of(const Particles &particles,
                        const LinkSet   &bonds,
                        const LinkSet   &contacts,
                        const CpmTable  &laws,
                        bool             rotations,
                        std::int32_t     particle);

  /**
 * Sharp critical step 2/sqrt(largest eigenvalue of M^-1 K) of the undamaged links at the present positions [s], by Lanczos iteration
 * to a relative 1e-10.
 *
 * @throws std::runtime_error if the iteration does not converge
 */
  double critical_step(
    const Particles &particles, const LinkSet &bonds, const LinkSet *contacts, const CpmTable &laws, bool rotations);
} // namespace dem
