#include "fem/materials/damage_plastic/parameters.h"

#include "fem/materials/refuse.h"

#include <cmath>

namespace fem
{
  void DamagePlasticParameters::validate() const
  {
    DamagePlasticParameters copy = *this;
    describe(copy, [](const char *name, const double &value, const char *, const char *, const double lower,
                      const double upper, bool) {
      std::ostringstream rule;
      rule << "must lie in [" << lower << ", " << upper << "].";
      demand(value >= lower && value <= upper, name, value, rule.str());
    });
    demand(tensile_strength < compressive_strength, "Tensile strength", tensile_strength,
           "must be below the compressive strength.");
    demand(crack_opening > 0 || fracture_energy > 0, "Fracture energy [J/m^2]", fracture_energy,
           "is needed, and positive; or the crack opening [m] in its place.");
    demand(!(crack_opening > 0 && fracture_energy > 0), "Crack opening", crack_opening,
           "give either the crack opening or the fracture energy, and not both.");
    demand(nonlocal_length == 0 || element_size > 0, "Nonlocal length", nonlocal_length,
           "needs an Element size of its own: the averaging spreads the failure, not the mesh.");
    demand(hardening_b > hardening_d, "Hardening B", hardening_b, "must exceed Hardening D.");
    demand(hardening_a > hardening_b, "Hardening A", hardening_a, "must exceed Hardening B.");
  }
}
