#pragma once

#include <limits>

namespace dem
{
  /** Shape of the shear strength under compression (doc/theory/cpm-options.md, 2). */
  enum class StrengthSurface
  {
    linear,     ///< cohesion and friction
    logarithmic ///< the same at no normal stress, ever flatter under compression
  };

  /** Factor of the overstress of visco-damage (doc/theory/cpm-options.md, 3). */
  enum class DamageOverstress
  {
    whole,    ///< as its definition says
    undamaged ///< times 1 - omega, as programs in common use have it: only to compare with them
  };

  /** What the cohesive particle model can do beyond its usual form; all off by default (doc/theory/cpm-options.md). */
  struct CpmOptions
  {
    double compression_yield_strain = 0;   ///< eps_s; 0: no plastic flow in compression
    double compression_hardening    = 0.3; ///< K_s: slope of the flow over E

    StrengthSurface  strength_surface  = StrengthSurface::linear;
    double           logarithmic_speed = 0.1; ///< Y_0
    double           damage_time       = 0;   ///< tau_d [s]; 0: damage does not depend on the rate
    double           damage_exponent   = 0.2; ///< M_d
    DamageOverstress damage_overstress = DamageOverstress::whole;
    double           plastic_time      = 0;   ///< tau_p [s]; 0: sliding does not depend on the rate
    double           plastic_exponent  = 0.2; ///< M_p
    double           prestress         = 0;   ///< sigma_0 [Pa], pressure negative

    bool depends_on_rate() const { return damage_time > 0 || plastic_time > 0; }
    bool any() const
    {
      return compression_yield_strain < 0 || strength_surface != StrengthSurface::linear || depends_on_rate() ||
             prestress < 0;
    }
    /** Those that contacts have, too. */
    bool any_of_contacts() const
    {
      return compression_yield_strain < 0 || strength_surface != StrengthSurface::linear || plastic_time > 0;
    }

    /** As CpmLaw::describe(). */
    template <typename Number, typename Choice>
    static void describe(CpmOptions &o, Number &&number, Choice &&choice)
    {
      constexpr double largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::min();
      number("Compression yield strain", o.compression_yield_strain, "-",
             "eps_s, elastic normal strain past which a link flows in compression, negative; 0: never", -1.0, 0.0,
             false);
      number("Compression hardening", o.compression_hardening, "-",
             "K_s, stiffness of a link that flows in compression over its normal modulus", 0.0, 1.0, false);
      choice("Strength surface", o.strength_surface,
             {{"linear", StrengthSurface::linear}, {"logarithmic", StrengthSurface::logarithmic}},
             "growth of shear strength with compression: by friction alone, or less and less");
      number("Logarithmic speed", o.logarithmic_speed, "-",
             "Y_0, of the logarithmic strength surface: the smaller, the sooner it flattens", smallest, largest, false);
      number("Damage time", o.damage_time, "s", "tau_d, time scale of visco-damage; 0: damage without delay", 0.0,
             largest, false);
      number("Damage rate exponent", o.damage_exponent, "-", "M_d: the overstress goes with this power of the rate",
             1e-3, 10.0, false);
      choice("Damage overstress", o.damage_overstress,
             {{"whole", DamageOverstress::whole}, {"undamaged", DamageOverstress::undamaged}},
             "whole: as its definition says; undamaged: times 1 - omega, only to compare with programs that do so");
      number("Plastic time", o.plastic_time, "s", "tau_p, time scale of visco-plastic sliding; 0: without delay", 0.0,
             largest, false);
      number("Plastic rate exponent", o.plastic_exponent, "-", "M_p: the overstress goes with this power of the rate",
             1e-3, 10.0, false);
      number("Prestress", o.prestress, "Pa",
             "sigma_0, pressure that every bond bears from the start and that is not part of its stress, negative",
             -largest, 0.0, false);
    }
  };
} // namespace dem
