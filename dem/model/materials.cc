#include "dem/model/materials.h"

#include "base/errors.h"

#include <cmath>

namespace dem
{
  std::vector<double> LinkMaterials::densities(const double otherwise) const
  {
    std::vector<double> found;
    for (const double own : density)
      found.push_back(own > 0 ? own : otherwise);
    return found;
  }

  LinkMaterials LinkMaterials::with_contacts(const LinkMaterials &other) const
  {
    if (other.size() != size())
      throw base::InputError("Contacts: there are " + std::to_string(size()) +
                             " materials, but contacts are told for " + std::to_string(other.size()) + ".");
    LinkMaterials both = *this;
    both.touching      = other.touching;
    return both;
  }

  void check_materials(const Packing &packing, const LinkMaterials &materials)
  {
    for (std::size_t i = 0; i < packing.material.size(); ++i)
      if (packing.material[i] < 0 || static_cast<std::size_t>(packing.material[i]) >= materials.size())
        throw base::InputError("particle " + std::to_string(i + 1) +
                               ": material = " + std::to_string(packing.material[i]) + ": " +
                               std::to_string(materials.size()) + " given, numbered from 0.");
  }

  // tan(atan()) might miss equal ones by a bit
  double mean_friction(const double a, const double b)
  {
    return a == b ? a : std::tan(mean(std::atan(a), std::atan(b)));
  }
} // namespace dem
