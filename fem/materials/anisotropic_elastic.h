#pragma once

#include "fem/materials/element_extent.h"
#include "fem/materials/response.h"

#include <array>

namespace fem
{
  struct AnisotropicElasticParameters
  {
    std::array<double, 21> upper; ///< D_11 D_12 ... D_16 D_22 ... D_66 [Pa], rows of the upper triangle

    AnisotropicElasticParameters() { upper.fill(required); }
  };

  /// Linear elasticity from any symmetric positive definite 6 x 6, e.g. a homogenised stiffness.
  class AnisotropicElastic
  {
  public:
    using Parameters                     = AnisotropicElasticParameters;
    static constexpr const char *name    = "anisotropic elastic";
    static constexpr const char *meaning = "Any stiffness, e.g. a homogenised one";

    struct State
    {
    };

    template <typename Number>
    static void describe(Parameters &p, Number &&number)
    {
      static constexpr const char *names[21] = {"D11", "D12", "D13", "D14", "D15", "D16", "D22",
                                                "D23", "D24", "D25", "D26", "D33", "D34", "D35",
                                                "D36", "D44", "D45", "D46", "D55", "D56", "D66"};
      for (unsigned int i = 0; i < 21; ++i)
        number(names[i], p.upper[i], "Pa", "stiffness, order xx yy zz yz zx xy, engineering shear", -1e300, 1e300,
               true);
    }

    /// @param stiffness [Pa], symmetric
    static void take_stiffness(Parameters &p, const base::Stiffness &stiffness)
    {
      unsigned int next = 0;
      for (int i = 0; i < 6; ++i)
        for (int j = i; j < 6; ++j)
          p.upper[next++] = stiffness(i, j);
    }

    template <typename Column>
    static void describe_state(State &, Column &&)
    {
    }

    /// @throws base::InputError unless the matrix is positive definite.
    explicit AnisotropicElastic(const Parameters &parameters);

    /// @param stiffness [Pa].
    /// @throws base::InputError unless symmetric to 1e-10 of its largest entry, and positive definite.
    explicit AnisotropicElastic(const base::Stiffness &stiffness);

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
