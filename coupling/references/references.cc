#include "coupling/references/references.h"

#include "coupling/references/published_transfers.h"
#include "coupling/sequential/mapping_law.h"
#include "dem/measures/damage_tensor.h"
#include "fem/materials/mixed_control.h"
#include "fem/references/concrete_points.h"

#include <cmath>

namespace coupling
{
  namespace
  {
    using base::Comparisons;
    using references::PublishedCase;

    Eigen::Matrix3d diagonal_of(const std::array<double, 3> &values)
    {
      return Eigen::Vector3d(values[0], values[1], values[2]).asDiagonal();
    }

    /** Tensors are printed with six decimals; the law's exponent magnifies what is lost of a small measure. */
    double by_printed_digits(const PublishedCase &c)
    {
      const double measure = 0.58 * c.corrected[0] - 0.10 * c.corrected[1] + 0.02 * c.corrected[2];
      return 4.7 * 0.5e-6 / measure + 5e-4;
    }

    /** 5e-4 of a value; zeros are exact. */
    void printed(Comparisons::Found row, const double reference)
    {
      if (reference == 0)
        row.within_margin(0, 0);
      else
        row.within(5e-4, reference);
    }

    /** The point of a continuum after the transfer of a published state. */
    fem::DamagePlasticState
    received(const PublishedCase &c, const fem::DamagePlasticConcrete &concrete, const MappedDamage &mapped)
    {
      fem::InitialPointState given;
      given.stress    = Eigen::Map<const base::Voigt>(c.stress.data());
      given.damage    = mapped.damage;
      given.hardening = mapped.hardening;
      return concrete.initial_state(given, {});
    }

    void damage_tensors(Comparisons &rows)
    {
      for (const PublishedCase &c : references::published_cases())
        {
          const Eigen::Matrix3d back  = dem::with_published_factor(diagonal_of(c.corrected)),
                                forth = dem::from_published_factor(diagonal_of(c.published));
          for (int i = 0; i < 3; ++i) // six decimals are printed
            {
              const std::string value = "state " + std::string(c.name) + ", eigenvalue " + std::to_string(i + 1);
              const auto        k     = static_cast<std::size_t>(i);
              rows.of(value + " by 12/(2N)", "", back(i, i)).within_margin(2e-6, c.published[k]);
              rows.of(value + " by 15/(2N)", "", forth(i, i)).within_margin(2e-6, c.corrected[k]);
            }
        }
    }

    void mapped_states(Comparisons &rows)
    {
      const MappingLaw                 law;
      const fem::DamagePlasticConcrete concrete(fem::references::material_m2());
      for (const PublishedCase &c : references::published_cases())
        {
          const std::string  of     = " of state " + std::string(c.name);
          const MappedDamage mapped = map_damage(diagonal_of(c.corrected), law);
          const auto         state  = received(c, concrete, mapped);
          rows.of("damage before the switch" + of, "", mapped.raw).within(by_printed_digits(c), c.raw);
          printed(rows.of("damage" + of, "", mapped.damage), c.damage);
          printed(rows.of("kappa_D" + of, "", state.kappa_d), c.kappa_d);
          printed(rows.of("kappa_P" + of, "", state.kappa_p), c.kappa_p);
        }
    }

    void continuations(Comparisons &rows)
    {
      const MappingLaw                 law;
      const fem::DamagePlasticConcrete concrete(fem::references::material_m2());
      for (const PublishedCase &c : references::published_cases())
        {
          auto        state = received(c, concrete, map_damage(diagonal_of(c.corrected), law));
          std::size_t next  = 0;
          for (int step = 0; next < c.after.size(); ++step)
            {
              // One tetrahedron, pushed along z: sides free, shear strains held at zero.
              fem::MixedTarget target;
              target.stress_given = {{true, true, false, false, false, false}};
              target.value[2]     = -3.5e-5 * step;
              state = fem::solve_mixed(concrete, target, state, {}, 1e6, fem::Increments::whole).response.trial;
              if (std::fabs(target.value[2] - c.after[next].strain) > 1e-9)
                continue;
              rows
                .of("stress of state " + std::string(c.name) + " after step " + std::to_string(step), "Pa",
                    state.stress[2])
                .within(5e-4, 1e6 * c.after[next].stress);
              ++next;
            }
        }
    }
  } // namespace

  const std::vector<base::Reference> &all_references()
  {
    static const std::vector<base::Reference> all = {
      {"transfer: published damage tensors", "Stransky (2018), chapter 6", damage_tensors},
      {"transfer: mapped damage and hardening", "Stransky (2018), chapter 6", mapped_states},
      {"transfer: continued compression", "Stransky (2018), chapter 6, by OOFEM 2.3", continuations}};
    return all;
  }
} // namespace coupling
