#pragma once

#include "dem/laws/cpm_table.h"
#include "dem/links.h"
#include "dem/particles.h"
#include "dem/specimen.h"

namespace dem
{
  /**
 * First of the two passes: force records and new history of every link from its two particles. No scatter; blocks of
 * links are independent, so the result does not depend on the number of threads.
 */
  using LinkPass = void (*)(LinkSet &links, const Particles &particles, const CpmTable &laws);

  /** In what the particles of a specimen may differ. */
  enum class Mixture
  {
    equal,    ///< in nothing: one material, and one radius, so that arms are half the length
    radii,    ///< in radius
    materials ///< in material, and in radius perhaps: each link has the constants of its pair
  };

  /** The pass compiled for what the scene models. */
  LinkPass select_bond_pass(const Physics &physics, Mixture mixture, bool shear_damages);

  /** The same for contacts: no tension, no cohesion. */
  LinkPass select_contact_pass(const Physics &physics, Mixture mixture);

  // The halves of both, each compiled in a file of its own.
  LinkPass select_bond_pass_in_plane(const Physics &physics, Mixture mixture, bool shear_damages);
  LinkPass select_bond_pass_in_space(const Physics &physics, Mixture mixture, bool shear_damages);
  LinkPass select_contact_pass_in_plane(const Physics &physics, Mixture mixture);
  LinkPass select_contact_pass_in_space(const Physics &physics, Mixture mixture);
} // namespace dem
