#include "dem/laws/elastic_links.h"

#include "dem/laws/cpm.h"

namespace dem
{
  LinkMaterials elastic_links(const double normal_modulus, const double shear_ratio)
  {
    CpmParameters law;
    law.normal_modulus = normal_modulus;
    law.shear_ratio    = shear_ratio;
    // Limits that physics without damage and friction never reach, but which must be possible.
    law.limit_elastic_strain = 1;
    law.relative_ductility   = 2;
    law.cohesion             = 1e3 * normal_modulus;
    return law;
  }
} // namespace dem
