#include "dem/mesostructure/aggregate_sizes.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/core/uniform_random.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dem
{
  namespace
  {
    constexpr std::size_t most_aggregates = 1000000;
    constexpr double      right_volume = 0.005, right_passing = 0.005;
    constexpr double      as_good  = 0.05; ///< as both, of these tolerances
    constexpr double      stride   = 4e-4; ///< of increments
    constexpr double      farthest = 1.06; ///< of these, over that where the volume first is right

    double cube(const double d) { return d * d * d; }
    double sphere(const double d) { return M_PI / 6 * cube(d); }

    void check(const GradingCurve &curve, const double smallest)
    {
      if (!(smallest >= curve.smallest() && smallest < curve.largest()))
        throw base::InputError("Grading: smallest aggregate = " + base::number_text(smallest) +
                               " m: must be on the curve, from " + base::number_text(curve.smallest()) + " to below " +
                               base::number_text(curve.largest()) + " m.");
      if (!(curve.between(smallest, curve.largest()) > 0))
        throw base::InputError("Grading: nothing is coarser than " + base::number_text(smallest) + " m.");
    }

    void check_volume(const GradingCurve &curve, const double smallest, const double volume)
    {
      check(curve, smallest);
      if (!(volume >= sphere(smallest) && std::isfinite(volume)))
        throw base::InputError("Grading: a volume of " + base::number_text(volume) +
                               " m^3 is less than that of the smallest aggregate, " +
                               base::number_text(sphere(smallest)) + " m^3. Enlarge the specimen or the content.");
    }

    AggregateSizes descending(std::vector<double> diameters)
    {
      AggregateSizes sizes;
      std::sort(diameters.begin(), diameters.end(), std::greater<double>());
      sizes.diameters = std::move(diameters);
      sizes.volume    = volume_of_spheres(sizes.diameters);
      return sizes;
    }

    /** The increment D at which [P(d + D) - P(d)]/(d + D)^3 first comes to a number; below 0: it never does. */
    double next_increment(const GradingCurve &curve, const double d, const double number, const double guess)
    {
      const double furthest = curve.largest() - d;
      const auto   lacks    = [&](const double more) { return curve.between(d, d + more) < number * cube(d + more); };
      double       low = 0, high = std::min(guess, furthest);
      while (lacks(high))
        {
          if (!(high < furthest))
            return -1;
          low  = high;
          high = std::min(1.1 * high, furthest);
        }
      for (;;)
        {
          const double middle = 0.5 * (low + high);
          if (!(high - low > 1e-14 * d))
            return high;
          (lacks(middle) ? low : high) = middle;
        }
    }
  } // namespace

  double volume_of_spheres(const std::vector<double> &diameters)
  {
    double volume = 0;
    for (const double d : diameters)
      volume += sphere(d);
    return volume;
  }

  AggregateSizes sizes_by_increment(const GradingCurve &curve, const double smallest, const double increment)
  {
    check(curve, smallest);
    if (!(increment > 0 && smallest + increment < curve.largest()))
      throw base::InputError("Grading: increment = " + base::number_text(increment) +
                             " m: must be above 0, and lead to a size of the curve.");
    const double number = curve.between(smallest, smallest + increment) / cube(smallest + increment);
    if (!(number > 0))
      throw base::InputError("Grading: no aggregate is between " + base::number_text(smallest) + " and " +
                             base::number_text(smallest + increment) + " m, from where sizes begin.");
    std::vector<double> diameters = {smallest};
    for (double more = increment;;)
      {
        more = next_increment(curve, diameters.back(), number, 0.5 * more);
        if (!(more > 0))
          break;
        diameters.push_back(diameters.back() + more);
        if (diameters.size() > most_aggregates)
          throw base::InputError("Grading: increment = " + base::number_text(increment) +
                                 " m gives more than a million aggregates.");
      }
    AggregateSizes sizes = descending(std::move(diameters));
    sizes.increment      = increment;
    return sizes;
  }

  AggregateSizes sizes_for_volume(const GradingCurve &curve, const double smallest, const double volume)
  {
    check_volume(curve, smallest, volume);
    // The number of aggregates goes with the inverse of the increment: large ones have too few, small ones too many.
    const auto of  = [&](const double increment) { return sizes_by_increment(curve, smallest, increment); };
    double     few = 0.5 * (curve.largest() - smallest), many = few;
    while (of(many).volume < volume)
      many *= 0.5;
    while (few / many > 1 + stride)
      {
        const double middle                       = std::sqrt(few * many);
        (of(middle).volume < volume ? few : many) = middle;
      }
    // Near there the volume goes in saw teeth, as the largest aggregate comes and goes: the one nearest to volume and curve.
    const auto misfit = [&](const AggregateSizes &sizes) {
      return std::max(std::abs(sizes.volume / volume - 1) / right_volume,
                      largest_misfit(curve, smallest, sizes.diameters) / right_passing);
    };
    AggregateSizes best = of(many);
    for (double next = many * farthest; next > many / farthest && !(misfit(best) < as_good); next /= 1 + stride)
      if (AggregateSizes sizes = of(next); misfit(sizes) < misfit(best))
        best = std::move(sizes);
    return best;
  }

  AggregateSizes
  drawn_sizes(const GradingCurve &curve, const double smallest, const double volume, const std::uint64_t seed)
  {
    check_volume(curve, smallest, volume);
    const double           all = curve.between(smallest, curve.largest());
    std::vector<SievePart> classes; // bounds, ascending
    classes.push_back({smallest, curve.passing(smallest)});
    for (const SievePart &sieve : curve.points())
      if (sieve.size > smallest)
        classes.push_back(sieve);
    UniformRandom       random(seed);
    std::vector<double> diameters;
    double              lacking = 0; // of all coarser classes [m^3]
    for (std::size_t k = classes.size(); k-- > 1;)
      {
        // Between sieves P' ~ 1/d, so that f ~ d^-4: its distribution is linear in d^-3.
        const double low = 1 / cube(classes[k].size), high = 1 / cube(classes[k - 1].size);
        lacking += (classes[k].part - classes[k - 1].part) / all * volume;
        while (classes[k].part > classes[k - 1].part)
          {
            const double d = std::cbrt(1 / (low + random() * (high - low)));
            if (!(0.5 * sphere(d) < lacking))
              break;
            diameters.push_back(d);
            lacking -= sphere(d);
            if (diameters.size() > most_aggregates)
              throw base::InputError("Grading: a volume of " + base::number_text(volume) +
                                     " m^3 takes more than a million aggregates.");
          }
      }
    return descending(std::move(diameters));
  }

  double largest_misfit(const GradingCurve &curve, const double smallest, const std::vector<double> &diameters)
  {
    const double volume = volume_of_spheres(diameters), fines = curve.passing(smallest);
    double       misfit = 0;
    for (const SievePart &sieve : curve.points())
      {
        if (sieve.size < smallest)
          continue;
        double finer = 0;
        for (const double d : diameters)
          finer += d < sieve.size ? sphere(d) : 0;
        misfit = std::max(misfit, std::abs(fines + (1 - fines) * finer / volume - sieve.part));
      }
    return misfit;
  }
} // namespace dem
