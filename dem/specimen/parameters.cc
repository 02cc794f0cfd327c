#include "dem/specimen/parameters.h"

#include "base/errors.h"
#include "dem/contacts/deepest_overlap.h"

#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    [[noreturn]] void refuse(const char *entry, const double value, const char *rule)
    {
      std::ostringstream message;
      message << entry << " = " << value << ": " << rule;
      throw base::InputError(message.str());
    }
  } // namespace

  void SpecimenParameters::check() const
  {
    if (physics.dimension != 2 && physics.dimension != 3)
      refuse("Dimension", physics.dimension, "must be 2 or 3.");
    if (!(density > 0))
      refuse("Density", density, "must be above 0 kg/m^3.");
    if (!(interaction_ratio >= 1 && interaction_ratio <= 10))
      refuse("Interaction ratio", interaction_ratio, "must be at least 1, and at most 10. 1.5 is usual for concrete.");
    if (!(installation_gap >= 0 && std::isfinite(installation_gap)))
      refuse("Installation gap", installation_gap, "must not be negative.");
    if (!(step_factor > 0 && step_factor < 1.5))
      refuse("Step factor", step_factor, "must be above 0, and below 1 for a stable run.");
    if (const double most = physics.largest_overlap; !(most > 0 && most <= DeepestOverlap::gone_through))
      refuse("Largest overlap", most, "must be above 0, and at most 1.");
    if (!(damping >= 0 && damping < 1))
      refuse("Damping", damping, "must be in [0, 1).");
    if (!gravity.allFinite())
      throw base::InputError("Gravity: must be finite.");
    if (!(emission_reach >= 0 && emission_reach <= 1000))
      refuse("Emission/Reach", emission_reach, "must be from 0 to 1000 mean diameters of the particles.");
    if (physics.periodic && emission_reach > 0)
      throw base::InputError("Emission/Reach: a periodic cell is not listened to: must be 0.");
    if (physics.periodic && !gravity.isZero(0))
      throw base::InputError("Gravity: a periodic cell has nothing to stand on and would fall for ever.");
    if (physics.dimension == 2 && gravity.z() != 0)
      throw base::InputError("Gravity: in two dimensions it must lie in the plane, z = 0.");
    if (physics.dimension == 2 && !(thickness > 0))
      refuse("Thickness", thickness, "must be above 0 m in two dimensions.");
  }
} // namespace dem
