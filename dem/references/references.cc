#include "dem/references/references.h"

#include "dem/references/peridynamic_lattice.h"
#include "dem/references/random_packings.h"

namespace dem
{
  const std::vector<base::Reference> &all_references()
  {
    static const std::vector<base::Reference> all = {
      {"peridynamics: elastic constants of the square grid", "sums over one node's bonds, doc/theory/peridynamics.md",
       references::peridynamic_lattice},
      {"random packings: links and relaxed over affine modulus",
       "published static solution of one packing of 500 spheres, doc/theory/homogenisation.md, 5",
       references::links_of_random_packings},
      {"random packings: moduli of 500 spheres",
       "published means over several packings, doc/theory/homogenisation.md, 5", references::moduli_of_500_spheres},
      {"random packings: moduli of 100 spheres",
       "published means over several packings, doc/theory/homogenisation.md, 5", references::moduli_of_100_spheres}};
    return all;
  }
} // namespace dem
