// Passes of the cohesive particle model in space.
#include "dem/kernels/link_update.h"
#include "dem/laws/cpm_links.h"

namespace dem
{
  template LinkPass link_pass_in_space<CpmBond<DamageDriver::none, false>>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmBond<DamageDriver::none, true>>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmBond<DamageDriver::normal, false>>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmBond<DamageDriver::normal, true>>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmBond<DamageDriver::normal_and_shear, false>>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmBond<DamageDriver::normal_and_shear, true>>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmContact<false>>(bool, Mixture);
  template LinkPass link_pass_in_space<CpmContact<true>>(bool, Mixture);
} // namespace dem
