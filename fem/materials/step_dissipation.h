#pragma once

#include "fem/materials/dissipation.h"
#include "fem/materials/mixed_path.h"

#include <cmath>
#include <optional>

namespace fem
{
  namespace step_dissipation
  {
    /// Pieces as short as this are not divided, and none longer than this is believed, in units of strain_scale().
    constexpr double short_piece = 0.02, sure_piece = 1.0;

    constexpr double settled = 0.01; ///< change with twice as many pieces that counts as none, over what is dissipated
    constexpr int    finest  = 256;  ///< pieces
  }

  /**
   * What a point dissipates in one step between two histories, along a path of its own [J/m^3].
   *
   * Law::dissipation(from, to) is of second order in the length of a piece. The path is walked again in more and more pieces until the
   * sum settles, whatever the solver's step was: the difference from the work that the solver counts shows whether its steps are short
   * enough.
   * @param walk (pieces) -> the sum over so many equal pieces; nothing where the law has no answer to one of them
   */
  template <typename Law, typename Walk>
  Dissipation
  settled_dissipation(const Law &law, const typename Law::State &from, const typename Law::State &to, const Walk &walk)
  {
    using namespace step_dissipation;
    Dissipation  sum    = law.dissipation(from, to);
    const double length = (to.strain - from.strain).cwiseAbs().maxCoeff() / law.strain_scale();
    if (length <= short_piece)
      return sum;
    for (int pieces = 2; pieces <= finest; pieces *= 2)
      {
        if (length > 2 * sure_piece * pieces)
          continue;
        const std::optional<Dissipation> finer = walk(pieces);
        if (!finer)
          continue;
        const double change =
          std::fmax(std::fabs(finer->plasticity - sum.plasticity), std::fabs(finer->damage - sum.damage));
        sum = *finer;
        if (length <= sure_piece * pieces && change <= settled * std::fabs(sum.total()))
          break;
      }
    return sum;
  }

  /// Along a straight line of strains. @param next (from, strain, done part of the way) -> history
  template <typename Law, typename Next>
  std::optional<Dissipation> dissipation_on_line(
    const Law &law, const typename Law::State &from, const base::Voigt &to, const int pieces, const Next &next)
  {
    Dissipation         sum;
    typename Law::State now   = from;
    const base::Voigt   whole = to - from.strain;
    try
      {
        for (int k = 1; k <= pieces; ++k)
          {
            const double part  = double(k) / pieces;
            const auto   there = next(now, k == pieces ? to : base::Voigt(from.strain + part * whole), part);
            sum.add(law.dissipation(now, there));
            now = there;
          }
      }
    catch (const MaterialFailure &)
      {
        return std::nullopt;
      }
    return sum;
  }

  /// Along a path of strains and stresses. @param reach longest piece [-], see MixedPath::walk()
  template <typename Law>
  std::optional<Dissipation>
  dissipation_on_path(const Law &law, const MixedPath<Law> &path, const int pieces, const double reach)
  {
    Dissipation sum;
    const auto  walk = path.walk(pieces, reach, [&](const typename Law::State &from, const typename Law::State &to) {
      sum.add(law.dissipation(from, to));
    });
    return walk.complete() ? std::optional(sum) : std::nullopt;
  }
}
