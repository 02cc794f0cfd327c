#include "apps/statistics/space_filling.h"

#include "base/errors.h"

#include <boost/random/sobol.hpp>

#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace statistics
{
  namespace
  {
    constexpr int most_sobol_factors = 3667; // of the table of direction numbers in Boost

    void demand_size(const std::string &design, const int runs, const int factors)
    {
      if (runs < 1 || factors < 1)
        throw base::InputError(design + ": " + std::to_string(runs) + " runs of " + std::to_string(factors) +
                               " factors: at least one of each.");
    }

    /** In [0, 1), from the upper 53 bits: the distributions of the standard library differ from one to the next. */
    double uniform(std::mt19937_64 &stream) { return static_cast<double>(stream() >> 11) * 0x1p-53; }
  } // namespace

  Eigen::MatrixXd latin_hypercube(const int runs, const int factors, const std::uint64_t seed)
  {
    demand_size("Latin hypercube", runs, factors);
    std::mt19937_64  stream(seed);
    Eigen::MatrixXd  points(runs, factors);
    std::vector<int> slice(runs);
    for (int factor = 0; factor < factors; ++factor)
      {
        std::iota(slice.begin(), slice.end(), 0);
        for (int last = runs - 1; last > 0; --last)
          std::swap(slice[last], slice[static_cast<int>(uniform(stream) * (last + 1))]);
        for (int run = 0; run < runs; ++run)
          points(run, factor) = (slice[run] + uniform(stream)) / runs;
      }
    return points;
  }

  Eigen::MatrixXd sobol_points(const int runs, const int factors)
  {
    demand_size("Sobol's sequence", runs, factors);
    if (factors > most_sobol_factors)
      throw base::InputError("Sobol's sequence: " + std::to_string(factors) + " factors: at most " +
                             std::to_string(most_sobol_factors) + ".");
    boost::random::sobol sequence(factors);
    Eigen::MatrixXd      points(runs, factors);
    for (int run = 0; run < runs; ++run)
      for (int factor = 0; factor < factors; ++factor)
        points(run, factor) = static_cast<double>(sequence() >> 11) * 0x1p-53;
    return points;
  }
} // namespace statistics
