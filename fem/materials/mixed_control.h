#pragma once

#include "fem/materials/mixed_path.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace fem
{
  /// When the end of a path that is walked in more and more parts is believed.
  enum class Settling
  {
    quickly, ///< when twice as many parts change it little, measured by the increment
    surely ///< few parts, which agree by chance, twice; and measured by what is left where a step ends near zero strain
  };

  namespace mixed_control
  {
    // Lengths of strain increments, in units of strain_scale(): that at which the material cracks.
    constexpr double short_step = 0.25; ///< is solved at once
    constexpr double sure_step  = 0.25; ///< longest of a walk whose end may be believed
    constexpr double leap       = 2.0;  ///< lands on another answer

    constexpr double lost = 0.999; ///< damage beyond which strains that answer to stresses are not determined

    constexpr int finest = 1024; ///< steps of a walk
    constexpr int few    = 16;   ///< steps of a walk that may agree with another by chance

    /// Change of the answer with half as many steps that counts as none: long walks gather more error.
    constexpr double settled(const int steps) { return steps < 128 ? 2.5e-3 : 1e-3; }

    /// Difference of two answers to one target: stresses over the largest one, strains over a strain of the caller's. Strains
    /// of what has lost its stiffness do not count.
    template <typename Law>
    double
    difference(const Law &law, const MixedSolution<Law> &a, const MixedSolution<Law> &b, const double strain_unit)
    {
      const double crack = law.strain_scale();
      const double stress =
        std::fmax(b.response.stress.cwiseAbs().maxCoeff(), 0.01 * crack * law.elastic_stiffness()(0, 0));
      const double d = (a.response.stress - b.response.stress).cwiseAbs().maxCoeff() / stress;
      if (Law::damage_of(b.response.trial) > lost)
        return d;
      return std::fmax(d, (a.strain - b.strain).cwiseAbs().maxCoeff() / std::fmax(strain_unit, 0.01 * crack));
    }

    /// What strains are measured by; surely: a step that ends near zero strain is as exact there as one that begins at zero.
    template <typename Law>
    double strain_unit(const MixedPath<Law> &path, const MixedSolution<Law> &end, const Settling settling)
    {
      const double increment = path.increment_to(end.strain);
      return settling == Settling::surely ? std::fmin(increment, end.strain.cwiseAbs().maxCoeff()) : increment;
    }

    /// The rows of what is given in stress condensed, zero outside what is given in strain.
    inline base::Stiffness condensed(const base::Stiffness &full, const std::array<bool, 6> &stress_given)
    {
      using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
      std::array<int, 6> in{}, out{};
      int                n_in = 0, n_out = 0;
      for (int i = 0; i < 6; ++i)
        (stress_given[i] ? out[n_out++] : in[n_in++]) = i;
      const auto block = [&](const auto &rows, const int n_rows, const auto &columns, const int n_columns) {
        Matrix part(n_rows, n_columns);
        for (int i = 0; i < n_rows; ++i)
          for (int j = 0; j < n_columns; ++j)
            part(i, j) = full(rows[i], columns[j]);
        return part;
      };
      Matrix kept = block(in, n_in, in, n_in);
      if (n_out > 0)
        kept -=
          block(in, n_in, out, n_out) * block(out, n_out, out, n_out).partialPivLu().solve(block(out, n_out, in, n_in));
      base::Stiffness result = base::Stiffness::Zero();
      for (int i = 0; i < n_in; ++i)
        for (int j = 0; j < n_in; ++j)
          result(in[i], in[j]) = kept(i, j);
      return result;
    }

    /// The end of the path, walked in ever more steps until it settles.
    template <typename Law>
    MixedSolution<Law>
    follow(const Law &law, const MixedPath<Law> &path, const typename Law::State &committed, const Settling settling)
    {
      using Walk              = typename MixedPath<Law>::Walk;
      const double      crack = law.strain_scale();
      int               steps = 1;
      std::vector<Walk> walks;
      int               agreed = 0;
      while (steps < finest && path.given_increment() > 2 * sure_step * crack * steps)
        steps *= 2;
      for (; steps <= finest; steps *= 2)
        {
          walks.push_back(path.walk(steps, leap * crack));
          const Walk       &now = walks.back();
          const std::size_t n   = walks.size();
          if (!now.complete())
            {
              // Four times as many steps do not come past the step that failed: the path ends there.
              if (n >= 3 && now.part() < walks[n - 3].part() + 1.0 / walks[n - 3].end.parts && !walks[n - 2].complete())
                break;
              continue;
            }
          if (n < 2 || !walks[n - 2].complete())
            continue;
          if (Law::damage_of(committed) <= lost)
            {
              if (now.longest > sure_step * crack)
                continue;
              // Where the longest part does not shrink with the others, the path has a gap.
              if (now.longest > 0.75 * walks[n - 2].longest)
                continue;
            }
          const double change = difference(law, walks[n - 2].end, now.end, strain_unit(path, now.end, settling));
          // Two walks of few steps agree by chance. A point that has left its reference size in one of the steps moves by leaps
          // when steps are divided.
          const bool leaps  = Law::leapt(committed, now.end.response.trial);
          const int  needed = leaps || (settling == Settling::surely && steps < few) ? 2 : 1;
          agreed            = change <= settled(steps) ? agreed + 1 : 0;
          if (agreed >= needed)
            return now.end;
        }
      const Walk        &last = walks.back();
      std::ostringstream text;
      text << "mixed control: ";
      if (last.complete())
        text << "the answer does not settle, not even in " << finest << " parts of the step. Take shorter steps.";
      else
        text << "the path from the last state can be followed over " << 100 * last.part()
             << " % of the step only, to strain " << last.end.strain.transpose() << " and stress "
             << last.end.response.trial.stress.transpose()
             << " Pa: beyond, no strain nearby meets the prescribed stresses.";
      throw MaterialFailure(text.str());
    }
  }

  /**
   * Answer of a point of which some components are given in stress.
   *
   * Used for plane stress, for uniaxial paths, and wherever a test machine leaves a component free. A law with history says of itself
   * strain_scale(), damage_of(), was_elastic() and leapt(), and its states have the members strain and stress.
   *
   * A softening law has several answers far from its last state, one of them fully damaged. The right one is the end of the
   * path on which every given strain and stress goes straight from the last state to the target. A step that does not
   * yield, or in which no strain moves by more than a quarter of that at which the material cracks, is solved at once. Any
   * other is walked in more and more parts, until none is longer than twice that and the end changes by less than 0.25 %.
   *
   * A step that is to be taken whole ends at the one answer to the whole increment that lies next to the end of the path.
   * @param stress_unit [Pa] against which the residual is measured, see newton_mixed()
   * @throws MaterialFailure saying how far the path can be followed: there is no equilibrium beyond.
   */
  template <typename Law>
  MixedSolution<Law> solve_mixed(const Law                 &law,
                                 const MixedTarget         &target,
                                 const typename Law::State &committed,
                                 const ElementExtent       &element,
                                 const double               stress_unit,
                                 const Increments           increments = Increments::followed,
                                 const Settling             settling   = Settling::surely)
  {
    constexpr double anywhere = 1e300;
    if (std::none_of(target.stress_given.begin(), target.stress_given.end(), [](const bool given) { return given; }))
      return {target.value, law.evaluate(target.value, committed, element)};
    if constexpr (std::is_empty_v<typename Law::State>)
      {
        if (const auto found =
              newton_mixed(law, base::Voigt(base::Voigt::Zero()), target, committed, element, stress_unit, anywhere))
          return *found;
        throw MaterialFailure("mixed control: no strain meets the prescribed stresses.");
      }
    else
      {
        using namespace mixed_control;
        const MixedPath<Law> path(law, target, committed, element, stress_unit);
        const double         short_strain = short_step * law.strain_scale();
        if (const auto found = path.elastic())
          return *found;
        if (path.given_increment() <= short_strain)
          if (const auto found = path.whole(committed.strain, leap * law.strain_scale()))
            if (path.increment_to(found->strain) <= short_strain)
              return *found;
        const MixedSolution<Law> followed = follow(law, path, committed, settling);
        if (increments == Increments::followed)
          return followed;
        const auto near = path.whole(followed.strain, anywhere);
        if (near && difference(law, *near, followed, path.increment_to(followed.strain)) <= 0.25)
          return *near;
        throw MaterialFailure("mixed control: the whole step has no answer near that of many small ones.");
      }
  }

  /**
   * Derivative of the stresses with the strains of the components that are given in strain; zero elsewhere [Pa].
   *
   * Of a step solved at once the consistent tangent, condensed. Of a walk, whose parts depend on each other through the history,
   * differences of the same walk: one more for each strain, ahead in its own direction.
   */
  template <typename Law>
  base::Stiffness mixed_tangent(const Law                 &law,
                                const MixedTarget         &target,
                                const typename Law::State &committed,
                                const ElementExtent       &element,
                                const double               stress_unit,
                                const MixedSolution<Law>  &at)
  {
    if (at.parts == 1)
      return mixed_control::condensed(at.response.tangent, target.stress_given);
    base::Stiffness tangent = base::Stiffness::Zero();
    if constexpr (!std::is_empty_v<typename Law::State>)
      {
        const double crack = law.strain_scale();
        const double size  = 1e-6 * std::fmax((at.strain - committed.strain).cwiseAbs().maxCoeff(), 0.01 * crack);
        for (int j = 0; j < 6; ++j)
          {
            if (target.stress_given[j])
              continue;
            MixedTarget  ahead = target;
            const double step  = target.value[j] < committed.strain[j] ? -size : size;
            ahead.value[j] += step;
            const auto walk =
              MixedPath<Law>(law, ahead, committed, element, stress_unit).walk(at.parts, mixed_control::leap * crack);
            if (!walk.complete()) // at the very end of what can be followed
              return mixed_control::condensed(at.response.tangent, target.stress_given);
            for (int i = 0; i < 6; ++i)
              if (!target.stress_given[i])
                tangent(i, j) = (walk.end.response.stress[i] - at.response.stress[i]) / step;
          }
      }
    return tangent;
  }
}
