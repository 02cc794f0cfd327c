#pragma once

#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/mixed_control.h"

#include <vector>

/// Material M1 of doc/theory/damage-plastic-concrete.md, 6; increments are taken whole, as in the published runs.
inline fem::DamagePlasticParameters material_m1()
{
  fem::DamagePlasticParameters p;
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

/// Material M2: the continuum of the sequential mapping, Stransky (2018).
inline fem::DamagePlasticParameters material_m2()
{
  fem::DamagePlasticParameters p;
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

/// A point pulled or pushed along xx with free sides, step after step.
class UniaxialPoint
{
public:
  explicit UniaxialPoint(const fem::DamagePlasticParameters &p)
    : law(p)
    , increments(p.largest_increment > 0 ? fem::Increments::followed : fem::Increments::whole)
  {
  }

  /// Moves to the axial strain in equal steps; returns the axial stress [Pa].
  double go_to(const double axial, const int steps)
  {
    const double from = state.strain[0];
    for (int i = 1; i <= steps; ++i)
      {
        fem::MixedTarget target;
        target.stress_given = {false, true, true, true, true, true};
        target.value[0]     = from + (axial - from) * i / steps;
        state               = fem::solve_mixed(law, target, state, extent, 1e6, increments).response.trial;
      }
    return state.stress[0];
  }

  fem::DamagePlasticConcrete law;
  fem::Increments            increments;
  fem::DamagePlasticState    state;
  fem::ElementExtent         extent;
};

/// A point on a strain path, each corner reached in equal steps.
inline fem::DamagePlasticState
follow(const fem::DamagePlasticConcrete &law, const std::vector<base::Voigt> &corners, const int steps)
{
  fem::DamagePlasticState state;
  for (const base::Voigt &corner : corners)
    {
      const base::Voigt from = state.strain;
      for (int i = 1; i <= steps; ++i)
        state = law.evaluate(from + (corner - from) * (double(i) / steps), state, {}).trial;
    }
  return state;
}
