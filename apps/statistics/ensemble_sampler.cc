#include "apps/statistics/ensemble_sampler.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace statistics
{
  namespace
  {
    constexpr double stretch = 2; // Goodman and Weare's a

    /** Numbers that do not depend on the library of the compiler: below one, and of a density 1 / sqrt(z) in [1 / a, a]. */
    class Chance
    {
    public:
      explicit Chance(const std::uint64_t seed)
        : stream(seed)
      {
      }
      double       below_one() { return std::ldexp(static_cast<double>(stream() >> 11), -53); }
      Eigen::Index below(const Eigen::Index count) { return static_cast<Eigen::Index>(below_one() * count); }
      double       stretched()
      {
        const double root = 1 / std::sqrt(stretch) + below_one() * (std::sqrt(stretch) - 1 / std::sqrt(stretch));
        return root * root;
      }

    private:
      std::mt19937_64 stream;
    };

    void refuse_starts(const Eigen::MatrixXd &starts, const Eigen::VectorXd &densities)
    {
      if (starts.cols() < 1 || starts.rows() % 2 != 0 || starts.rows() < 2 * starts.cols() || !starts.allFinite() ||
          !densities.allFinite())
        throw base::InputError("sampler: an even number of possible starts is wanted, twice as many as variables.");
    }
  } // namespace

  Ensemble sampled(const std::function<double(const Eigen::VectorXd &)> &log_density,
                   const Eigen::MatrixXd                                &starts,
                   const EnsembleOptions                                &options)
  {
    const Eigen::Index walkers = starts.rows(), half = walkers / 2, n = starts.cols();
    Eigen::MatrixXd    now = starts;
    Eigen::VectorXd    densities(walkers);
    for (Eigen::Index k = 0; k < walkers; ++k)
      densities[k] = log_density(starts.row(k));
    refuse_starts(starts, densities);
    Chance   chance(options.seed);
    Ensemble found;
    found.places.resize(walkers * options.steps, n);
    std::int64_t accepted = 0;
    for (int step = -options.forgotten; step < options.steps; ++step)
      {
        for (Eigen::Index k = 0; k < walkers; ++k) // each half moves by the places of the other
          {
            const Eigen::Index    other   = (k < half ? half : 0) + chance.below(half);
            const double          z       = chance.stretched();
            const Eigen::VectorXd place   = now.row(other) + z * (now.row(k) - now.row(other));
            const double          density = log_density(place);
            if (std::log(chance.below_one()) < (n - 1) * std::log(z) + density - densities[k])
              {
                now.row(k)   = place;
                densities[k] = density;
                accepted += step >= 0;
              }
          }
        if (step >= 0)
          found.places.middleRows(step * walkers, walkers) = now;
      }
    found.accepted = static_cast<double>(accepted) / static_cast<double>(walkers * std::max(options.steps, 1));
    return found;
  }

  double quantile(const Eigen::VectorXd &values, const double share)
  {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double      place = share * static_cast<double>(sorted.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), sorted.size() - 1);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
  }
} // namespace statistics
