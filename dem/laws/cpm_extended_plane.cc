// Passes of the cohesive particle model with options, in the plane.
#include "dem/kernels/link_update.h"
#include "dem/laws/cpm_extended_contact.h"

namespace dem
{
  template LinkPass link_pass_in_plane<CpmExtendedBond>(bool, Mixture);
  template LinkPass link_pass_in_plane<CpmExtendedContact>(bool, Mixture);
} // namespace dem
