#include "dem/references/peridynamic_lattice.h"

#include "dem/peridynamics/lattice_constants.h"

#include <string>

namespace dem::references
{
  using namespace peridynamics;

  namespace
  {
    struct GridRow
    {
      BondModel model;
      Volumes   volumes;
      double    ratio, axis, poisson, shear, oblique;
      int       neighbours;
    };

    std::string name_of(const GridRow &row)
    {
      std::string ratio = std::to_string(row.ratio);
      ratio.erase(ratio.find_last_not_of('0') + 1);
      if (ratio.back() == '.')
        ratio.pop_back();
      return std::string(row.model == BondModel::prototype ? "prototype" : "general") +
             (row.volumes == Volumes::full ? ", full volumes" : ", partial volumes") + ", horizon " + ratio + ": ";
    }
  } // namespace

  void peridynamic_lattice(base::Comparisons &rows)
  {
    constexpr BondModel pm = BondModel::prototype, general = BondModel::general;
    constexpr Volumes   full = Volumes::full, partial = Volumes::partial;
    // Table 7.2 of the source documents, to four decimals.
    constexpr double digits  = 5.1e-5;
    const GridRow    table[] = {{pm, full, 3, 1.0644, 0.3182, 1.0051, 1.0168, 28},
                                {pm, full, 3.015, 1.0486, 0.3182, 0.9902, 1.0017, 28},
                                {pm, full, 4, 0.9860, 0.3170, 0.9266, 0.9383, 48},
                                {pm, full, 5, 1.0038, 0.3623, 1.1164, 1.0932, 80},
                                {pm, full, 6, 0.9820, 0.3446, 1.0239, 1.0154, 112},
                                {pm, full, 12, 0.9649, 0.3316, 0.9586, 0.9599, 440},
                                {pm, partial, 3.015, 1.0434, 0.3165, 0.9786, 0.9913, 36},
                                {pm, partial, 4, 1.0188, 0.3294, 1.0037, 1.0067, 68},
                                {pm, partial, 6, 1.0100, 0.3306, 0.9996, 1.0017, 136},
                                {pm, partial, 12, 1.0021, 0.3335, 1.0026, 1.0025, 488},
                                {general, full, 3.015, 1.0721, 0.3178, 1.0108, 1.0228, 28},
                                {general, partial, 6, 1.0189, 0.3305, 1.0080, 1.0102, 136}};
    for (const GridRow &row : table)
      {
        const LatticeConstants l  = lattice_constants(Space::plane_stress, row.model, {row.ratio, row.volumes, false});
        const std::string      of = name_of(row);
        rows.of(of + "Young's modulus along an axis", "", l.young_modulus).within_margin(digits, row.axis);
        rows.of(of + "Poisson's ratio", "", l.poisson_ratio).within_margin(digits, row.poisson);
        rows.of(of + "shear modulus", "", l.shear_modulus).within_margin(digits, row.shear);
        rows.of(of + "Young's modulus at 45 degrees", "", l.young_modulus_oblique).within_margin(digits, row.oblique);
        rows.of(of + "neighbours", "", l.neighbours).within_margin(0, row.neighbours);
      }
    // The document cuts 1.02540 off after its fourth decimal.
    rows
      .of("prototype, full volumes, horizon 3.015: bulk modulus", "",
          lattice_constants(Space::plane_stress, pm, {3.015, full, false}).bulk)
      .within_margin(1e-4, 1.0253);
  }
} // namespace dem::references
