#include "dem/peridynamics/lattice_constants.h"

#include <cmath>

namespace dem::peridynamics
{
  int reach_of(const Horizon &horizon)
  {
    const double furthest = horizon.volumes == Volumes::partial ? horizon.ratio + 0.5 : horizon.ratio * (1 + 1e-9);
    return static_cast<int>(std::floor(furthest));
  }

  std::vector<Offset> half_family(const int dimension, const Horizon &horizon)
  {
    std::vector<Offset> found;
    const int           far = reach_of(horizon), far_y = dimension > 1 ? far : 0, far_z = dimension > 2 ? far : 0;
    for (int z = 0; z <= far_z; ++z)
      for (int y = z == 0 ? 0 : -far_y; y <= far_y; ++y)
        for (int x = z == 0 && y == 0 ? 1 : -far; x <= far; ++x)
          {
            const double length = std::sqrt(static_cast<double>(x * x + y * y + z * z));
            if (const double part = volume_part(horizon.volumes, length, horizon.ratio, 1.0); part > 0)
              found.push_back({{x, y, z}, length, part});
          }
    return found;
  }

  namespace
  {
    /** What follows from C11, C12 and C44 = C12. */
    void set_moduli(LatticeConstants &l, const Space space)
    {
      const double nu = poisson_ratio(space), c11 = l.c11, c12 = l.c12;
      if (space == Space::rod)
        {
          l.young_modulus = l.young_modulus_oblique = l.bulk = l.shear_modulus = c11;
          return;
        }
      const bool   plane_stress = space == Space::plane_stress;
      const double shear        = 1 / (2 * (1 + nu));
      l.shear_modulus           = c12 / shear;
      if (plane_stress)
        {
          const double s11 = c11 / (c11 * c11 - c12 * c12), s12 = -c12 / (c11 * c11 - c12 * c12);
          l.poisson_ratio         = c12 / c11;
          l.young_modulus         = 1 / s11;
          l.young_modulus_oblique = 4 / (2 * s11 + 2 * s12 + 1 / c12);
          l.bulk                  = (c11 + c12) * (1 - nu);
          return;
        }
      // Cubic: nothing of the grid distinguishes z from the other axes, or strains vanish along it.
      const double s11        = (c11 + c12) / ((c11 - c12) * (c11 + 2 * c12));
      const double s12        = -c12 / ((c11 - c12) * (c11 + 2 * c12));
      l.poisson_ratio         = c12 / (c11 + c12);
      l.young_modulus         = 1 / s11;
      l.young_modulus_oblique = 4 / (2 * s11 + 2 * s12 + 1 / c12);
      l.bulk = space == Space::space ? (c11 + 2 * c12) * (1 - 2 * nu) : (c11 + c12) * (1 + nu) * (1 - 2 * nu);
    }
  } // namespace

  LatticeConstants lattice_constants(const Space space, const BondModel model, const Horizon &horizon)
  {
    LatticeConstants l;
    const double     c = bond_constant(space, model, 1.0, horizon.ratio, 1.0);
    for (const Offset &o : half_family(dimension_of(space), horizon))
      {
        const double x = o.steps[0], y = o.steps[1], r = o.length;
        const double g = c * o.part / (model == BondModel::prototype ? r * r * r : r * r);
        l.neighbours += 2;
        l.c11 += g * x * x * x * x; // a half of both neighbours
        l.c12 += g * x * x * y * y;
      }
    set_moduli(l, space);
    return l;
  }

  double LatticeConstants::factor(const Calibration calibration) const
  {
    switch (calibration)
      {
      case Calibration::axis:
        return young_modulus;
      case Calibration::bulk:
        return bulk;
      default:
        return 1;
      }
  }

  LatticeConstants LatticeConstants::calibrated(const Calibration calibration) const
  {
    LatticeConstants l = *this;
    for (double *const value : {&l.c11, &l.c12, &l.young_modulus, &l.young_modulus_oblique, &l.shear_modulus, &l.bulk})
      *value /= factor(calibration);
    return l;
  }
} // namespace dem::peridynamics
