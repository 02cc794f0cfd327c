#pragma once

#include "fem/materials/element_extent.h"
#include "fem/materials/refuse.h"
#include "fem/materials/response.h"

#include <cmath>

namespace fem
{
  struct IsotropicElasticParameters
  {
    double young_modulus = required; ///< E  [Pa], > 0
    double poisson_ratio = required; ///< nu [-], in (-1, 0.5)
  };

  /// Hooke's law, sigma = K tr(eps) 1 + 2 G dev(eps).
  class IsotropicElastic
  {
  public:
    using Parameters                  = IsotropicElasticParameters;
    static constexpr const char *name = "isotropic elastic";

    struct State
    {
    };

    template <typename Entry> // entry(name, value, meaning with unit, lower bound, upper bound)
    static void describe(Parameters &p, Entry &&entry)
    {
      entry("Young modulus", p.young_modulus, "E [Pa]", 1e-300, 1e300);
      entry("Poisson ratio", p.poisson_ratio, "nu [-]", -0.9999999, 0.4999999);
    }

    template <typename Column> // column(name, first value, number of values)
    static void describe_state(State &, Column &&)
    {
    }

    /// @throws std::invalid_argument unless E > 0 and -1 < nu < 0.5.
    explicit IsotropicElastic(const Parameters &p)
    {
      demand(p.young_modulus > 0 && std::isfinite(p.young_modulus), "Young modulus", p.young_modulus,
             "must be positive.");
      demand(p.poisson_ratio > -1 && p.poisson_ratio < 0.5, "Poisson ratio", p.poisson_ratio, "must lie in (-1, 0.5).");
      stiffness = isotropic_stiffness(p.young_modulus / (3 * (1 - 2 * p.poisson_ratio)),
                                      p.young_modulus / (2 * (1 + p.poisson_ratio)));
    }

    Response<State>
    evaluate(const Voigt &strain, const State &, const ElementExtent &, bool /*with_tangent*/ = true) const
    {
      return {stiffness * strain, stiffness, {}};
    }

    const Stiffness &elastic_stiffness() const { return stiffness; }

  private:
    Stiffness stiffness;
  };
}
