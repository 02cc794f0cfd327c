// Passes of the cohesive particle model with options, in space.
#include "dem/kernels/link_update.h"
#include "dem/laws/cpm_extended_contact.h"

namespace dem
{
  template LinkPass link_pass_in_space<CpmExtendedBond>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmExtendedContact>(bool, Mixture);
} // namespace dem
