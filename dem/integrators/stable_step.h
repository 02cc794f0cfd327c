#pragma once

#include "dem/model/link_law.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace dem
{
  /** Links of one kind, and their law. */
  struct LawfulLinks
  {
    const LinkSet &links;
    const LinkLaw &law;
  };

  /**
 * Stable step from per-particle stiffness, min over P of sqrt(2 m_P / sum_{c in P} kappa_c) [s], a rigorous lower bound of the
 * critical step (element eigenvalue theorem; doc/theory/integration.md, 3).
 *
 * kappa_c = max(k_N, k_T (1 + m d^2/I) + k_bending m/I, k_twist m/I) of a link seen from the particle: stretching, twisting, and
 * what turns it across the link are independent motions. Links count with their undamaged stiffness, so the bound stays valid while
 * they soften. Infinite when no particle has a link.
 *
 * @param of_surfaces sum of kappa_c over contacts with surfaces, of each particle [N/m]; empty: none
 * @param ahead contacts whose stiffness grows count with an overlap larger by this than now [m]
 * @param among first of the particles that count, and behind the last: those whose links this process updates, among several. None: all
 */
  double stable_step(const Particles                                          &particles,
                     const std::vector<LawfulLinks>                           &links,
                     bool                                                      rotations,
                     const std::vector<double>                                &of_surfaces = {},
                     double                                                    ahead       = 0,
                     const std::optional<std::pair<std::size_t, std::size_t>> &among       = {});

  /** Sum of kappa_c over one particle's links, as the bound has it [N/m], in time proportional to their number. */
  double stiffness_around(const Particles                &particles,
                          const std::vector<LawfulLinks> &links,
                          bool                            rotations,
                          std::int32_t                    particle,
                          double                          of_surfaces = 0,
                          double                          ahead       = 0);

  /** The same bound of one particle alone [s], in time proportional to its links. @pre something acts on it */
  double stable_step_of(const Particles                &particles,
                        const std::vector<LawfulLinks> &links,
                        bool                            rotations,
                        std::int32_t                    particle,
                        double                          of_surfaces = 0,
                        double                          ahead       = 0);

  /**
 * Sharp critical step 2/sqrt(largest eigenvalue of M^-1 K) of the undamaged links at the present positions [s], by Lanczos iteration
 * to a relative 1e-10.
 *
 * @throws std::runtime_error if the iteration does not converge
 */
  double critical_step(const Particles &particles, const std::vector<LawfulLinks> &links, bool rotations);
} // namespace dem
