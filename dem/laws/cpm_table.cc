#include "dem/laws/cpm_table.h"

#include "dem/core/errors.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    double mean(const double a, const double b) { return 0.5 * (a + b); }

    /** tan of the mean angle; of equal ones the very same, which tan(atan()) might miss by a bit. */
    double mean_friction(const double a, const double b)
    {
      return a == b ? a : std::tan(mean(std::atan(a), std::atan(b)));
    }

    const char *name_of(const DamageLaw law) { return law == DamageLaw::exponential ? "exponential" : "linear"; }
  } // namespace

  std::vector<double> CpmMaterials::densities(const double otherwise) const
  {
    std::vector<double> found;
    for (const CpmMaterial &material : list)
      found.push_back(material.density > 0 ? material.density : otherwise);
    return found;
  }

  void check_materials(const Packing &packing, const CpmMaterials &materials)
  {
    for (std::size_t i = 0; i < packing.material.size(); ++i)
      if (packing.material[i] < 0 || static_cast<std::size_t>(packing.material[i]) >= materials.list.size())
        throw InputError("particle " + std::to_string(i + 1) + ": material = " + std::to_string(packing.material[i]) +
                         ": " + std::to_string(materials.list.size()) + " given, numbered from 0.");
  }

  CpmParameters mean_of(const CpmMaterial &one, const CpmMaterial &other)
  {
    const CpmParameters &a = one.parameters, &b = other.parameters;
    if (a.damage_law != b.damage_law)
      throw InputError("Damage law: material " + one.name + " has the " + name_of(a.damage_law) + " one, " +
                       other.name + " the " + name_of(b.damage_law) +
                       " one; links between them would have neither. Give both the same.");
    CpmParameters between;
    between.normal_modulus          = mean(a.normal_modulus, b.normal_modulus);
    between.shear_ratio             = mean(a.shear_ratio, b.shear_ratio);
    between.limit_elastic_strain    = mean(a.limit_elastic_strain, b.limit_elastic_strain);
    between.relative_ductility      = mean(a.relative_ductility, b.relative_ductility);
    between.cohesion                = mean(a.cohesion, b.cohesion);
    between.friction_coefficient    = mean_friction(a.friction_coefficient, b.friction_coefficient);
    between.damage_law              = a.damage_law;
    between.shear_contribution      = mean(a.shear_contribution, b.shear_contribution);
    between.residual_strength_limit = mean(a.residual_strength_limit, b.residual_strength_limit);
    return between;
  }

  std::vector<CpmParameters> CpmMaterials::pairs() const
  {
    std::vector<CpmParameters> all;
    for (std::size_t one = 0; one < list.size(); ++one)
      for (std::size_t other = 0; other <= one; ++other)
        all.push_back(mean_of(list[other], list[one]));
    return all;
  }

  CpmTable::CpmTable(const CpmMaterials &materials)
  {
    for (const CpmParameters &between : materials.pairs())
      laws.emplace_back(between);
    if (laws.empty())
      throw InputError("Materials: there must be at least one.");
    tabulate();
  }

  CpmTable::CpmTable(const CpmConstants &only)
    : laws{only}
  {
    tabulate();
  }

  void CpmTable::tabulate()
  {
    records.assign(record * laws.size(), 0.0);
    for (std::size_t l = 0; l < laws.size(); ++l)
      {
        const CpmConstants &k     = laws[l];
        const double        all[] = {k.E,
                                     k.G,
                                     k.onset,
                                     k.inverse_softening,
                                     k.cohesion,
                                     k.friction,
                                     k.kappa_broken,
                                     k.softening,
                                     k.shear_weight,
                                     k.linear_factor};
        std::copy(std::begin(all), std::end(all), &records[record * l]);
      }
  }

  bool CpmTable::shear_damages() const
  {
    return std::any_of(laws.begin(), laws.end(), [](const CpmConstants &k) { return k.shear_weight > 0; });
  }
} // namespace dem
