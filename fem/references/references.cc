#include "fem/references/references.h"

#include "fem/references/concrete.h"

namespace fem
{
  namespace
  {
    constexpr const char *independent =
      "Grassl and Jirasek (2006), computed by an independent program; doc/theory/damage-plastic-concrete.md, 6";
  }

  const std::vector<base::Reference> &all_references()
  {
    static const std::vector<base::Reference> all = {
      {"concrete: constants of the yield surface, hardening, ductility", independent, references::yield_constants},
      {"concrete: yield surface and potential at a general stress", independent, references::yield_at_general_stress},
      {"concrete: damage over opening", independent, references::damage_over_opening},
      {"concrete in uniaxial tension", std::string(independent) + ", and the regression tests of OOFEM",
       references::uniaxial_tension},
      {"concrete in uniaxial compression", std::string(independent) + ", and the regression tests of OOFEM",
       references::uniaxial_compression},
      {"concrete in oedometric and hydrostatic strain", independent, references::confined_strain},
      {"concrete on a non-proportional path", independent, references::non_proportional_path},
      {"concrete of the sequential mapping in compression", "Stransky (2018), by OOFEM 2.3",
       references::published_compression}};
    return all;
  }
} // namespace fem
