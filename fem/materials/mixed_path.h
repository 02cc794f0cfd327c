#pragma once

#include "fem/materials/mixed_newton.h"

#include <cmath>

namespace fem
{
  /**
   * The way of a point from its last state to a target: every given component, strain or stress, goes along a straight line.
   */
  template <typename Law>
  class MixedPath
  {
  public:
    using State = typename Law::State;

    /// @param stress_unit [Pa] against which residuals are measured, see newton_mixed()
    MixedPath(const Law           &law_,
              const MixedTarget   &target_,
              const State         &committed_,
              const ElementExtent &element_,
              const double         stress_unit_)
      : law(law_)
      , target(target_)
      , committed(committed_)
      , element(element_)
      , stress_unit(stress_unit_)
    {
    }

    /// The answer if the step does not yield: nothing if it does.
    std::optional<MixedSolution<Law>> elastic() const
    {
      const base::Voigt strain = predictor();
      if (!strain.allFinite() || !(increment_to(strain) <= longest_elastic))
        return std::nullopt;
      auto answer = newton_mixed(law, strain, target, committed, element, stress_unit, longest_elastic, 1);
      if (answer && Law::was_elastic(committed, answer->response.trial))
        return answer;
      return std::nullopt;
    }

    /// The answer of the step taken whole, the one nearest to a guess.
    std::optional<MixedSolution<Law>> whole(const base::Voigt &guess, const double reach) const
    {
      return newton_mixed(law, guess, target, committed, element, stress_unit, reach);
    }

    /// How far a walk in equal steps came.
    struct Walk
    {
      MixedSolution<Law> end;         ///< of the last step that was done
      int                done    = 0; ///< steps
      double             longest = 0; ///< strain increment of a step, its largest component [-]

      bool   complete() const { return done == end.parts; }
      double part() const { return double(done) / end.parts; }
    };

    /**
     * Follow the path in equal steps, each from the state of the one before, as long as they find an answer.
     * @param reach ends the walk before a step of a longer strain increment [-]: it would be a leap to another answer
     * @param passed (history before, history after) is called for each step
     */
    template <typename Passed>
    Walk walk(const int steps, const double reach, const Passed &passed) const
    {
      Walk w;
      w.end.strain         = committed.strain;
      w.end.response.trial = committed;
      w.end.parts          = steps;
      base::Voigt last     = (predictor() - committed.strain) / steps;
      if (!(last.cwiseAbs().maxCoeff() <= reach))
        last.setZero();
      for (; w.done < steps; ++w.done)
        {
          const State       from  = w.end.response.trial;
          const MixedTarget there = at(w.done + 1, steps);
          auto next = newton_mixed(law, base::Voigt(w.end.strain + last), there, from, element, stress_unit, reach);
          if (!next) // the path may bend here
            next = newton_mixed(law, w.end.strain, there, from, element, stress_unit, reach);
          if (!next)
            break;
          last           = next->strain - w.end.strain;
          w.longest      = std::fmax(w.longest, last.cwiseAbs().maxCoeff());
          w.end.strain   = next->strain;
          w.end.response = next->response;
          passed(from, w.end.response.trial);
        }
      return w;
    }

    Walk walk(const int steps, const double reach) const
    {
      return walk(steps, reach, [](const State &, const State &) {});
    }

    double increment_to(const base::Voigt &strain) const { return (strain - committed.strain).cwiseAbs().maxCoeff(); }

    /// Longest of the increments that are given in strain [-].
    double given_increment() const
    {
      double longest = 0;
      for (int i = 0; i < 6; ++i)
        if (!target.stress_given[i])
          longest = std::fmax(longest, std::fabs(target.value[i] - committed.strain[i]));
      return longest;
    }

  private:
    static constexpr double longest_elastic = 1.0; // [-]: no solid is elastic beyond

    MixedTarget at(const int k, const int steps) const
    {
      MixedTarget t = target;
      if (k < steps) // the last step ends on the target itself, not on a rounded sum
        for (int i = 0; i < 6; ++i)
          {
            const double from = target.stress_given[i] ? committed.stress[i] : committed.strain[i];
            t.value[i]        = from + (target.value[i] - from) * (double(k) / steps);
          }
      return t;
    }

    /// Strain at the target if the point only unloads.
    base::Voigt predictor() const
    {
      const base::Stiffness stiffness = (1 - Law::damage_of(committed)) * law.elastic_stiffness();
      base::Stiffness       rows      = base::Stiffness::Identity();
      base::Voigt           right;
      for (int i = 0; i < 6; ++i)
        {
          right[i] = target.value[i] - (target.stress_given[i] ? committed.stress[i] : committed.strain[i]);
          if (target.stress_given[i])
            rows.row(i) = stiffness.row(i) / stiffness(i, i);
          if (target.stress_given[i])
            right[i] /= stiffness(i, i);
        }
      return committed.strain + rows.partialPivLu().solve(right);
    }

    const Law           &law;
    const MixedTarget   &target;
    const State         &committed;
    const ElementExtent &element;
    const double         stress_unit;
  };
}
