#pragma once

#include "fem/materials/element_extent.h"
#include "fem/materials/mixed_target.h"
#include "fem/materials/response.h"

#include <array>
#include <optional>
#include <type_traits>

namespace fem
{
  /// Strain that meets a target, and the answer of the law there.
  template <typename Law>
  struct MixedSolution
  {
    base::Voigt                   strain;
    Response<typename Law::State> response;
    int                           parts = 1; ///< steps of their own into which the whole was divided
  };

  /**
   * Newton for the components given in stress, with halved steps.
   *
   * Far from the committed state a softening law has several answers; which one this finds depends on the guess.
   * @param guess start; its strain-given components are replaced by the target.
   * @param reach largest strain increment, in any component, that is tried [-]
   * @param stress_unit [Pa] against which the residual is measured: converged below 1e-12 of it, or when rounding stops
   *        the descent below 1e-9.
   * @return nothing if it does not converge.
   */
  template <typename Law>
  std::optional<MixedSolution<Law>> newton_mixed(const Law                 &law,
                                                 const base::Voigt         &guess,
                                                 const MixedTarget         &target,
                                                 const typename Law::State &committed,
                                                 const ElementExtent       &element,
                                                 const double               stress_unit,
                                                 const double               reach,
                                                 const int                  most_iterations = 50)
  {
    const auto too_far = [&]([[maybe_unused]] const base::Voigt &strain) {
      if constexpr (std::is_empty_v<typename Law::State>)
        return false;
      else
        return !((strain - committed.strain).cwiseAbs().maxCoeff() <= reach);
    };
    using OpenVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
    using OpenMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
    std::array<int, 6> open{};
    int                n      = 0;
    base::Voigt        strain = guess;
    for (int i = 0; i < 6; ++i)
      if (target.stress_given[i])
        open[n++] = i;
      else
        strain[i] = target.value[i];

    const auto residual = [&](const Response<typename Law::State> &response) {
      OpenVector r(n);
      for (int i = 0; i < n; ++i)
        r[i] = response.stress[open[i]] - target.value[open[i]];
      return r;
    };
    try
      {
        if (too_far(strain))
          return std::nullopt;
        MixedSolution<Law> now{strain, law.evaluate(strain, committed, element)};
        OpenVector         r = residual(now.response);
        for (int iteration = 0; iteration < most_iterations; ++iteration)
          {
            if (!(r.norm() > 1e-12 * stress_unit))
              return now;
            OpenMatrix k(n, n);
            for (int i = 0; i < n; ++i)
              for (int j = 0; j < n; ++j)
                k(i, j) = now.response.tangent(open[i], open[j]);
            const OpenVector step = k.fullPivLu().solve(-r);

            bool improved = false;
            for (double a = 1; a > 1e-4 && !improved; a /= 2)
              {
                base::Voigt next = now.strain;
                for (int i = 0; i < n; ++i)
                  next[open[i]] += a * step[i];
                if (too_far(next))
                  continue;
                const auto       tried  = law.evaluate(next, committed, element);
                const OpenVector r_next = residual(tried);
                if (r_next.norm() < r.norm())
                  {
                    now.strain   = next;
                    now.response = tried;
                    r            = r_next;
                    improved     = true;
                  }
              }
            if (!improved)
              break;
          }
        if (r.norm() <= 1e-9 * stress_unit)
          return now;
      }
    catch (const MaterialFailure &)
      {
        // The law has no answer to one of the strains on the way.
      }
    return std::nullopt;
  }
}
