#pragma once

#include "dem/laws/cpm_table.h"
#include "dem/links.h"
#include "dem/measures/loads.h"
#include "dem/particles.h"

namespace dem
{
  /** Which positions belong to the links' forces and state. */
  enum class Geometry
  {
    before_motion, ///< those of before the last step's motion: between steps, when particles have moved on
    present        ///< the present ones: within a step, between link pass and particle pass
  };

  /** A link at the instant t_n of the last force evaluation: particles have moved on since, the link's state and force have not. */
  struct LinkView
  {
    Eigen::Vector3d direction; ///< n, from first to second end
    double          length;    ///< [m]
    double          strain;    ///< normal strain [-]
    Eigen::Vector3d force;     ///< on the first end [N]
  };

  LinkView link_at(const Particles &particles,
                   const LinkSet   &links,
                   std::size_t      link,
                   Geometry         geometry = Geometry::before_motion);

  /** The same as what measures of stress and couple stress take. */
  LinkLoad load_at(const Particles &particles, const LinkSet &links, std::size_t link);

  /** Energy stored in one link [J]; mesoscale specification 8. */
  double elastic_energy(const Particles &particles,
                        const LinkSet   &links,
                        std::size_t      link,
                        const CpmTable  &laws,
                        Geometry         geometry = Geometry::before_motion);

  /** Sum over all living links [J]. */
  double elastic_energy(const Particles &particles, const LinkSet &links, const CpmTable &laws);

  /** Dissipated by damage of the living links [J]; by the closed form where only normal strain damages, plus what the pass
   * has summed up where shear does too. */
  double damage_dissipation(const LinkSet &links, const CpmTable &laws);

  /** Dissipated by damage of one living link [J]; zero where shear damages too (then the pass sums it up). */
  double damage_dissipation(const LinkSet &links, std::size_t link, const CpmTable &laws);

  /** Dissipated by sliding since the start [J]. */
  double plastic_dissipation(const LinkSet &links);

  /**
 * Add each link's share to the particles' stress moments V_P sigma_P = sum (c - x_P) (x) f_on_P [N m], c the contact point (Love-Weber;
 * mesoscale specification 7.1). Particle order is that of `particles`.
 */
  void add_stress_moments(const Particles &particles, const LinkSet &links, std::vector<Eigen::Matrix3d> &moments);
} // namespace dem
