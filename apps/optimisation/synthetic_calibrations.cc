#include "apps/optimisation/synthetic_calibrations.h"

#include "apps/optimisation/least_squares_search.h"
#include "apps/optimisation/model_noise.h"
#include "apps/statistics/uncertainty.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace optimisation
{
  namespace
  {
    constexpr double confidence = 0.95, usual_step = 0.03, wide_step = 0.06; // steps: of the ranges

    /** Of one specimen: any change of its constants, however small, gives other scatter. */
    Eigen::VectorXd rough_stresses(const Eigen::Vector3d &constants, const double scatter, const unsigned int specimen)
    {
      std::vector<unsigned int> bits = {specimen};
      for (const double value : constants)
        {
          std::uint64_t own = 0;
          std::memcpy(&own, &value, sizeof own);
          bits.push_back(static_cast<unsigned int>(own));
          bits.push_back(static_cast<unsigned int>(own >> 32));
        }
      std::seed_seq              seed(bits.begin(), bits.end());
      std::mt19937               stream(seed);
      std::normal_distribution<> noise(0, scatter);
      Eigen::VectorXd            all = softening_stresses(constants);
      for (double &stress : all)
        stress += noise(stream);
      return all;
    }

    struct SoughtTruth
    {
      const Eigen::Vector3d truth = {3, 1, 2}, start = {2.7, 1.1, 2.2}, lower = {1, 0.4, 0.6}, upper = {9, 2.5, 5};
    };

    /** One calibration. @param observed with its own errors */
    void calibrate_once(const SyntheticCalibrations &requested,
                        const unsigned int           specimen,
                        const Eigen::VectorXd       &observed,
                        Coverage                    &found)
    {
      const SoughtTruth     constants;
      const Eigen::VectorXd ranges = constants.upper - constants.lower;
      LeastSquaresProblem   problem;
      problem.start     = constants.start;
      problem.lower     = constants.lower;
      problem.upper     = constants.upper;
      problem.steps     = usual_step * ranges;
      problem.residuals = [&](const std::vector<Eigen::VectorXd> &places) {
        std::vector<std::optional<Eigen::VectorXd>> all;
        for (const Eigen::VectorXd &place : places)
          all.emplace_back((rough_stresses(place, requested.model_scatter, specimen) - observed) / requested.deviation);
        return all;
      };
      LeastSquaresOptions options;
      options.updated_jacobian  = true;
      options.smallest_decrease = 0.01;
      options.smallest_step     = 1.0 / 30;
      options.most_evaluations  = 200;
      const auto   fit          = least_squares(problem, options);
      NoiseOptions by_default;
      by_default.wide_steps              = wide_step * ranges;
      by_default.deviation               = requested.known ? 1 : 0;
      const auto                     end = model_at_end(problem, options, fit, by_default);
      statistics::UncertaintyOptions all;
      all.known_scatter  = requested.known ? 1 : 0;
      const auto narrow  = statistics::uncertainty(end.jacobian, end.residuals, ranges, all);
      all.model_noise    = end.noise;
      all.noise_share    = end.share;
      all.jacobian_noise = end.of_column / (wide_step * wide_step);
      all.noise_degrees  = end.noise_degrees;
      const auto wide    = statistics::uncertainty(end.jacobian, end.residuals, ranges, all);
      found.rough += end.noise.cols() > 0;
      for (int k = 0; k < 3; ++k)
        {
          const double truth = constants.truth[k];
          found.inside[k] += std::fabs(end.place[k] - truth) < wide.half_width(k, confidence);
          found.by_residuals[k] += std::fabs(fit.place[k] - truth) < narrow.half_width(k, confidence);
        }
    }
  } // namespace

  Eigen::VectorXd softening_stresses(const Eigen::Vector3d &constants)
  {
    constexpr int   samples = 12;
    Eigen::VectorXd all(samples);
    for (int k = 0; k < samples; ++k)
      {
        const double x = 2.0 * (k + 1) / samples;
        all[k]         = constants[0] * x * std::exp(-std::pow(x / constants[1], constants[2]) / constants[2]);
      }
    return all;
  }

  Coverage coverage_of(const SyntheticCalibrations &requested)
  {
    std::mt19937               stream(7);
    std::normal_distribution<> noise(0, requested.deviation);
    Coverage                   found;
    for (int calibration = 0; calibration < requested.count; ++calibration)
      {
        Eigen::VectorXd observed = rough_stresses(SoughtTruth().truth, requested.model_scatter, calibration);
        for (double &stress : observed)
          stress += noise(stream);
        calibrate_once(requested, calibration, observed, found);
      }
    return found;
  }
} // namespace optimisation
