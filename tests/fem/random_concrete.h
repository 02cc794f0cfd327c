#pragma once

#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/damage_plastic/stress_invariants.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/materials/mixed_control.h"

#include <cmath>
#include <random>

/// Uniform and normal numbers that are the same with every library.
class Random
{
public:
  explicit Random(const unsigned int seed)
    : engine(seed)
  {
  }
  double between(const double a, const double b) { return a + (b - a) * (engine() / 4294967296.0); }
  double log_between(const double a, const double b) { return a * std::pow(b / a, between(0, 1)); }
  double normal() { return std::sqrt(-2 * std::log(between(1e-12, 1))) * std::cos(between(0, 6.283185307179586)); }
  bool   one_in(const int n) { return engine() % n == 0; }

private:
  std::mt19937 engine;
};

inline fem::DamagePlasticParameters any_concrete(Random &random)
{
  fem::DamagePlasticParameters p;
  p.young_modulus        = random.between(15e9, 45e9);
  p.poisson_ratio        = random.between(0, 0.49);
  p.compressive_strength = random.between(10e6, 60e6);
  p.tensile_strength     = p.compressive_strength / random.between(8, 40);
  p.softening            = random.between(2, 40);
  p.element_size         = 0.1;
  p.crack_opening        = 0.1 * p.tensile_strength / p.young_modulus / random.log_between(3e-3, 0.8);
  return p;
}

/// Proportional to the elastic stress of the target: the factor at which it reaches the surface of a hardening variable.
inline double factor_to_yield(const fem::DamagePlasticConcrete   &law,
                              const fem::DamagePlasticParameters &p,
                              const base::Voigt                  &stress,
                              const double                        kappa)
{
  const fem::StressInvariants inv(stress);
  const auto                 &surface = law.plasticity().surface();
  const double                r = surface.lode_radius(inv.lode).value, q = surface.hardening(kappa).value;
  const double                fc     = p.compressive_strength;
  const auto                  inside = [&](const double a) {
    return surface.yield(a * inv.volumetric / fc, a * inv.deviatoric / fc, r, q) <= 0;
  };
  double a = 1e-12, b = 1e-12;
  while (inside(b) && b < 1e12)
    b *= 2;
  for (int i = 0; i < 60; ++i)
    (inside((a + b) / 2) ? a : b) = (a + b) / 2;
  return a;
}

/// 0.1 to 10 times the elastic limit, that of the virgin material or that of the hardened one.
inline fem::MixedTarget any_target(const fem::DamagePlasticConcrete   &law,
                                   const fem::DamagePlasticParameters &p,
                                   const std::array<bool, 6>          &stress_given,
                                   Random                             &random)
{
  fem::MixedTarget target;
  target.stress_given = stress_given;
  const bool free     = random.one_in(2); // stresses are given as zero
  for (int i = 0; i < 6; ++i)
    target.value[i] = target.stress_given[i] ? (free ? 0 : 0.5 * random.normal() * p.young_modulus) : random.normal();
  fem::IsotropicElastic::Parameters hooke;
  hooke.young_modulus       = p.young_modulus;
  hooke.poisson_ratio       = p.poisson_ratio;
  const base::Voigt elastic = fem::solve_mixed(fem::IsotropicElastic(hooke), target, {}, {}, 1e9).response.stress;
  const double      limit   = factor_to_yield(law, p, elastic, random.one_in(2) ? 0 : 1);
  target.value *= limit * random.log_between(0.1, 10);
  return target;
}
