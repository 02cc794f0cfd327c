#pragma once

#include "dem/laws/cpm.h"
#include "dem/links.h"
#include "dem/particles.h"
#include "dem/specimen.h"

namespace dem
{
  /**
 * First of the two passes: force records and new history of every link from its two particles. No scatter; blocks of
 * links are independent, so the result does not depend on the number of threads.
 */
  using LinkPass = void (*)(LinkSet &links, const Particles &particles, const CpmConstants &law);

  /** The pass compiled for what the scene models. @param equal_radii all particles have one radius: arms are half the length. */
  LinkPass select_bond_pass(const Physics &physics, bool equal_radii, bool shear_damages);

  /** The same for contacts: no tension, no cohesion. */
  LinkPass select_contact_pass(const Physics &physics, bool equal_radii);
} // namespace dem
