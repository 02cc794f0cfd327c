#pragma once

#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/mixed_control.h"

#include <vector>

/** Material points of published concretes. */
namespace fem::references
{
  /** Material M1 of doc/theory/damage-plastic-concrete.md, 6; increments are taken whole, as in the published runs. */
  inline DamagePlasticParameters material_m1()
  {
    DamagePlasticParameters p;
    p.young_modulus        = 30e9;
    p.poisson_ratio        = 0.2;
    p.compressive_strength = 30e6;
    p.tensile_strength     = 3e6;
    p.crack_opening        = 3e-4;
    p.softening            = 35;
    p.element_size         = 1.0;
    p.largest_increment    = 0.0;
    return p;
  }

  /** Material M2: the continuum of the sequential mapping, Stransky (2018). */
  inline DamagePlasticParameters material_m2()
  {
    DamagePlasticParameters p;
    p.young_modulus        = 33e9;
    p.poisson_ratio        = 0.2;
    p.compressive_strength = 40e6;
    p.tensile_strength     = 1e6;
    p.fracture_energy      = 100;
    p.softening            = 6;
    p.element_size         = 2.0;
    p.reference_size       = 2.0;
    p.largest_increment    = 0.0;
    return p;
  }

  /** A point pulled or pushed along xx with free sides, step after step. */
  class UniaxialPoint
  {
  public:
    explicit UniaxialPoint(const DamagePlasticParameters &p)
      : law(p)
      , increments(p.largest_increment > 0 ? Increments::followed : Increments::whole)
    {
    }

    /** Moves to the axial strain in equal steps; returns the axial stress [Pa]. */
    double go_to(const double axial, const int steps)
    {
      const double from = state.strain[0];
      for (int i = 1; i <= steps; ++i)
        {
          MixedTarget target;
          target.stress_given = {false, true, true, true, true, true};
          target.value[0]     = from + (axial - from) * i / steps;
          state               = solve_mixed(law, target, state, extent, 1e6, increments).response.trial;
        }
      return state.stress[0];
    }

    DamagePlasticConcrete law;
    Increments            increments;
    DamagePlasticState    state;
    ElementExtent         extent;
  };

  /** A point on a strain path, each corner reached in equal steps. */
  inline DamagePlasticState
  follow(const DamagePlasticConcrete &law, const std::vector<base::Voigt> &corners, const int steps)
  {
    DamagePlasticState state;
    for (const base::Voigt &corner : corners)
      {
        const base::Voigt from = state.strain;
        for (int i = 1; i <= steps; ++i)
          state = law.evaluate(from + (corner - from) * (double(i) / steps), state, {}).trial;
      }
    return state;
  }
} // namespace fem::references
