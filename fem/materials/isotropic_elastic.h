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

  /// Hooke's law, sigma = K tr(eps) 1 + 2 G dev(eps); doc/theory/elastic-materials.md, 1.
  class IsotropicElastic
  {
  public:
    using Parameters                     = IsotropicElasticParameters;
    static constexpr const char *name    = "isotropic elastic";
    static constexpr const char *meaning = "Hooke's law";

    struct State
    {
    };

    template <typename Number> // number(key, member, unit, meaning, lower bound, upper bound, required)
    static void describe(Parameters &p, Number &&number)
    {
      number("Young modulus", p.young_modulus, "Pa", "E", 1e-300, 1e300, true);
      number("Poisson ratio", p.poisson_ratio, "-", "nu", -0.9999999, 0.4999999, true);
    }

    /// @throws base::InputError for what is softer than gels: a number in another unit.
    static void check(const Parameters &p)
    {
      demand(p.young_modulus >= 1e3, "Young modulus [Pa]", p.young_modulus,
             "no solid is as soft. Is it in Pa? 25 GPa are 25e9.");
    }

    template <typename Column> // column(quantity, first value)
    static void describe_state(State &, Column &&)
    {
    }

    /// @throws base::InputError unless E > 0 and -1 < nu < 0.5.
    explicit IsotropicElastic(const Parameters &p)
    {
      demand(p.young_modulus > 0 && std::isfinite(p.young_modulus), "Young modulus", p.young_modulus,
             "must be positive.");
      demand(p.poisson_ratio > -1 && p.poisson_ratio < 0.5, "Poisson ratio", p.poisson_ratio, "must lie in (-1, 0.5).");
      stiffness = base::isotropic_stiffness(p.young_modulus / (3 * (1 - 2 * p.poisson_ratio)),
                                            p.young_modulus / (2 * (1 + p.poisson_ratio)));
    }

    Response<State>
    evaluate(const base::Voigt &strain, const State &, const ElementExtent &, bool /*with_tangent*/ = true) const
    {
      return {stiffness * strain, stiffness, {}};
    }

    const base::Stiffness &elastic_stiffness() const { return stiffness; }

    double stored_energy(const base::Voigt &strain, const base::Voigt &stress, const State &) const
    {
      return 0.5 * stress.dot(strain);
    }

  private:
    base::Stiffness stiffness;
  };
}
