#include "fem/references/references.h"

#include "fem/references/concrete.h"
#include "fem/references/solids.h"

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
       references::published_compression},
      {"solid: Cook's membrane", "Simo and Rifai (1990), converged in plane stress", references::cook_membrane},
      {"solid: cantilever under its own weight", "Timoshenko's beam, closed form", references::cantilever_of_weight},
      {"solid: plate with a hole", "Kirsch (1898), closed form", references::hole_in_plate},
      {"solid: cube of St. Venant and Kirchhoff's material stretched by 0.3", "closed form, nominal stress",
       references::stretched_cube},
      {"solid: thick cylinder that hardly changes its volume", "Lame, closed form, Poisson ratio 0.4999",
       references::thick_cylinder}};
    return all;
  }
} // namespace fem
