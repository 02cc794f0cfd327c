// Passes of flat joints in the plane.
#include "dem/kernels/link_update.h"
#include "dem/laws/flat_joint_update.h"

namespace dem
{
  template LinkPass link_pass_in_plane<FlatJoint>(bool, Mixture);
} // namespace dem
