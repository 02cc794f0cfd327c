#include "dem/mesostructure/mix.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <cmath>

namespace dem
{
  namespace
  {
    constexpr double least_voids = -0.01, most_voids = 0.5;

    void check(const Mix &mix)
    {
      if (mix.constituents.empty())
        throw base::InputError("Mix: it has no constituents.");
      for (const Constituent &one : mix.constituents)
        {
          if (!(one.mass >= 0 && std::isfinite(one.mass)))
            throw base::InputError("Mix: mass of " + one.name + " = " + base::number_text(one.mass) +
                                   " kg/m^3: must be 0 or above.");
          if (!(one.density > 0 && std::isfinite(one.density)))
            throw base::InputError("Mix: density of " + one.name + " = " + base::number_text(one.density) +
                                   " kg/m^3: must be above 0.");
        }
      if (!(mix.air >= 0 && mix.air < 1))
        throw base::InputError("Mix: air = " + base::number_text(mix.air) + ": must be in [0, 1).");
      if (!(mix.unit_weight >= 0 && std::isfinite(mix.unit_weight)))
        throw base::InputError("Mix: unit weight = " + base::number_text(mix.unit_weight) +
                               " kg/m^3: must be above 0, or left out.");
    }
  } // namespace

  MixVolumes volumes_of(const Mix &mix)
  {
    check(mix);
    double mass = 0, volume = 0;
    for (const Constituent &one : mix.constituents)
      {
        mass += one.mass;
        volume += one.mass / one.density;
      }
    if (!(mass > 0))
      throw base::InputError("Mix: no constituent has a mass above 0.");
    MixVolumes found;
    found.voids = mix.unit_weight > 0 ? 1 - mix.unit_weight / mass : mix.air;
    if (!(found.voids >= least_voids && found.voids <= most_voids))
      throw base::InputError("Mix: a unit weight of " + base::number_text(mix.unit_weight) + " kg/m^3 and masses of " +
                             base::number_text(mass) + " kg/m^3 leave voids of " +
                             base::number_text(100 * found.voids) + " %: from -1 to 50 % would be concrete.");
    for (const Constituent &one : mix.constituents)
      found.fractions.push_back(one.mass / one.density / volume * (1 - found.voids));
    return found;
  }
} // namespace dem
