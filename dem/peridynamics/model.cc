#include "dem/peridynamics/model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dem::peridynamics
{
  namespace
  {
    const double pi = std::acos(-1.0);
  }

  double poisson_ratio(const Space space)
  {
    switch (space)
      {
      case Space::rod:
        return 0;
      case Space::plane_stress:
        return 1.0 / 3.0;
      default:
        return 1.0 / 4.0;
      }
  }

  double bond_constant(
    const Space space, const BondModel model, const double young_modulus, const double horizon, const double section)
  {
    const bool   prototype = model == BondModel::prototype;
    const double E = young_modulus, d = prototype ? std::pow(horizon, dimension_of(space) + 1) :
                                                    std::pow(horizon, dimension_of(space) + 2);
    switch (space)
      {
      case Space::rod:
        return (prototype ? 2 : 3) * E / (section * d);
      case Space::plane_stress:
        return (prototype ? 9 : 12) * E / (pi * section * d);
      case Space::plane_strain:
        return (prototype ? 48 : 64) * E / (5 * pi * section * d);
      default:
        return (prototype ? 12 : 15) * E / (pi * d);
      }
  }

  double volume_part(const Volumes volumes, const double distance, const double horizon, const double spacing)
  {
    if (volumes == Volumes::full)
      return distance <= horizon * (1 + 1e-9) ? 1 : 0;
    return std::clamp((horizon - distance) / spacing + 0.5, 0.0, 1.0);
  }

  double critical_stretch(const Space     space,
                          const BondModel model,
                          const double    young_modulus,
                          const double    horizon,
                          const double    fracture_energy)
  {
    if (space == Space::rod)
      throw std::invalid_argument("critical_stretch: a rod has no energy of a crack");
    const bool   prototype       = model == BondModel::prototype;
    const double in_plane_strain = prototype ? 12 / (5 * pi) : 64 / (25 * pi);
    const double in_plane_stress = prototype ? 9 / (4 * pi) : 12 / (5 * pi);
    const double in_space        = prototype ? 6.0 / 5.0 : 5.0 / 4.0;
    const double energy          = space == Space::space        ? in_space :
                                   space == Space::plane_stress ? in_plane_stress :
                                                                  in_plane_strain; // over E delta s^2
    return std::sqrt(fracture_energy / (energy * young_modulus * horizon));
  }
} // namespace dem::peridynamics
