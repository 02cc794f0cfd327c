#pragma once

#include "fem/materials/element_extent.h"
#include "fem/materials/response.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace fem
{
  /// Which stress components are prescribed; the others are prescribed in strain.
  struct MixedTarget
  {
    std::array<bool, 6> stress_given{};
    Voigt               value = Voigt::Zero(); ///< strain [-] or stress [Pa], component by component
  };

  /// Strain that meets a target, and the answer of the law there.
  template <typename Law>
  struct MixedSolution
  {
    Voigt                         strain;
    Response<typename Law::State> response;
  };

  /**
   * Strain of a point of which some components are given in stress: Newton on those, with halved steps.
   *
   * Used for plane stress, for uniaxial paths, and wherever a test machine leaves a component free.
   * @param guess start; its strain-given components are replaced by the target.
   * @param stress_unit [Pa] against which the residual is measured: converged below 1e-12 of it, or when rounding stops
   *        the descent below 1e-9.
   * @throws MaterialFailure if it does not converge: the path has no equilibrium near, or the step is too long.
   */
  template <typename Law>
  MixedSolution<Law> solve_mixed(const Law                 &law,
                                 const Voigt               &guess,
                                 const MixedTarget         &target,
                                 const typename Law::State &committed,
                                 const ElementExtent       &element,
                                 const double               stress_unit)
  {
    std::vector<int> open;
    Voigt            strain = guess;
    for (int i = 0; i < 6; ++i)
      if (target.stress_given[i])
        open.push_back(i);
      else
        strain[i] = target.value[i];

    MixedSolution<Law> now{strain, law.evaluate(strain, committed, element)};
    const auto         residual = [&](const MixedSolution<Law> &s) {
      Eigen::VectorXd r(open.size());
      for (std::size_t i = 0; i < open.size(); ++i)
        r[i] = s.response.stress[open[i]] - target.value[open[i]];
      return r;
    };
    Eigen::VectorXd r = residual(now);
    for (int iteration = 0; iteration < 50; ++iteration)
      {
        if (!(r.norm() > 1e-12 * stress_unit))
          return now;
        Eigen::MatrixXd k(open.size(), open.size());
        for (std::size_t i = 0; i < open.size(); ++i)
          for (std::size_t j = 0; j < open.size(); ++j)
            k(i, j) = now.response.tangent(open[i], open[j]);
        const Eigen::VectorXd step = k.fullPivLu().solve(-r);

        bool improved = false;
        for (double a = 1; a > 1e-4 && !improved; a /= 2)
          {
            Voigt next = now.strain;
            for (std::size_t i = 0; i < open.size(); ++i)
              next[open[i]] += a * step[i];
            const MixedSolution<Law> tried{next, law.evaluate(next, committed, element)};
            const Eigen::VectorXd    r_next = residual(tried);
            if (r_next.norm() < r.norm())
              {
                now      = tried;
                r        = r_next;
                improved = true;
              }
          }
        if (!improved)
          break;
      }
    if (r.norm() <= 1e-9 * stress_unit)
      return now;
    throw MaterialFailure("mixed control: no strain meets the prescribed stresses (residual " +
                          std::to_string(r.norm()) + " Pa).");
  }
}
