#include "apps/figures/link_failure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    LinkFailure failure_of(const dem::LinkLaw &law, const std::size_t pair)
    {
      constexpr double first = 1e-8, last = 1, growth = 1.02; // of the strain, from step to step
      dem::NewLink     made;
      made.distance     = 1;
      made.first_radius = made.second_radius = 0.5;
      made.area                              = 1;
      std::vector<double> history(law.columns().size(), 0.0), before;
      law.begin(pair, made, history.data());
      dem::LinkStep step;
      step.geometry.reference = step.geometry.area = 1;
      LinkFailure found;
      double      peak = 0;
      for (double strain = first; strain < last; strain *= growth)
        {
          step.strain_before   = step.geometry.strain;
          step.geometry.strain = strain;
          step.geometry.length = 1 + strain;
          before               = history;
          const double stress  = law.update(pair, step, before.data(), history.data()).force.x();
          if (stress > peak)
            {
              peak        = stress;
              found.onset = strain;
            }
          else if (stress < peak / std::exp(1.0))
            {
              found.softening = strain / found.onset > growth * growth ? strain - found.onset : 0.0;
              return found;
            }
        }
      return {};
    }
  } // namespace

  LinkFailure failure_in_tension(const dem::LinkLaw &law)
  {
    LinkFailure longest;
    for (std::size_t pair = 0; pair < law.pairs(); ++pair)
      {
        const LinkFailure one = failure_of(law, pair);
        longest.onset         = std::max(longest.onset, one.onset);
        longest.softening     = std::max(longest.softening, one.softening);
      }
    return longest;
  }

  double strain_of_failure(const dem::LinkLaw &law, const dem::Packing &packing, const dem::UniaxialParameters &test)
  {
    const auto [onset, softening] = failure_in_tension(law);
    if (onset == 0)
      return std::numeric_limits<double>::infinity();
    if (test.strain_rate < 0)
      return 24 * onset;
    const auto [low, high] =
      std::minmax_element(packing.centre.begin(), packing.centre.end(),
                          [axis = test.axis](const auto &a, const auto &b) { return a[axis] < b[axis]; });
    const double length = (*high)[test.axis] - (*low)[test.axis];
    // Links soften over two diameters around the crack: concrete_uniaxial.prm ends at 6.2e-4, by this at 5.8e-4.
    const double zone = 4 * *std::max_element(packing.radius.begin(), packing.radius.end());
    return 1.5 * onset + softening * zone / length * std::log(1 / test.stop_fraction);
  }
} // namespace apps
