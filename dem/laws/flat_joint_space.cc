// Passes of flat joints in space.
#include "dem/kernels/link_update.h"
#include "dem/laws/flat_joint_update.h"

namespace dem
{
  template LinkPass link_pass_in_space<FlatJoint>(bool, Mixture);
} // namespace dem
