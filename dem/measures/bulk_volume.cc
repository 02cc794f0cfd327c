#include "dem/measures/bulk_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dem
{
  namespace
  {
    constexpr double diameters = 2.5; ///< radius of the ball that gives the depth; holds about 70 spheres, 22 discs
    constexpr double deep = 0.06; ///< its content's centre off its own, in radii: 0.03 by chance, 0.375 for half a ball
    constexpr double width = 0.75; ///< of the Gaussian, in diameters: 6 exp(-2 pi^2 width^2) = 9e-5 off for a lattice
    constexpr double cut   = 4.5;  ///< of the Gaussian, in widths: 2e-4 lies beyond
    constexpr std::size_t most_balls = 1000; ///< enough for 0.3 % of the mean; more would cost time on large specimens
    constexpr std::size_t fewest     = 5;    ///< deep particles

    double of_box(const std::vector<Eigen::Vector3d> &centre,
                  const std::vector<double>          &radius,
                  const double                        solid,
                  const int                           dimension,
                  const double                        thickness)
    {
      Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
      for (std::size_t i = 0; i < centre.size(); ++i)
        {
          low  = low.min(centre[i].array() - radius[i]);
          high = high.max(centre[i].array() + radius[i]);
        }
      const Eigen::Array3d box = high - low;
      return (dimension == 3 ? box.prod() : box[0] * box[1] * thickness) / solid;
    }
  } // namespace

  double bulk_over_solid(const std::vector<Eigen::Vector3d> &centre,
                         const std::vector<double>          &radius,
                         const std::vector<double>          &solid,
                         const int                           dimension,
                         const double                        thickness)
  {
    const std::size_t n        = centre.size();
    const double      total    = std::accumulate(solid.begin(), solid.end(), 0.0);
    const double      diameter = 2 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(n);
    const double      reach = diameters * diameter, s = width * diameter;
    const double      kernel = dimension == 3 ? std::pow(2 * M_PI * s * s, 1.5) : 2 * M_PI * s * s * thickness;
    const std::size_t stride = std::max<std::size_t>(1, n / most_balls);
    // The solid volume around each ball's middle, by the Gaussian; below zero: it is not deep.
    std::vector<double> weighted((n + stride - 1) / stride);
#pragma omp parallel for schedule(static)
    for (std::size_t ball = 0; ball < weighted.size(); ++ball)
      {
        const std::size_t i       = ball * stride;
        double            content = 0, sum = 0;
        Eigen::Vector3d   moment = Eigen::Vector3d::Zero();
        for (std::size_t j = 0; j < n; ++j)
          {
            const Eigen::Vector3d offset   = centre[j] - centre[i];
            const double          distance = offset.squaredNorm();
            if (distance < reach * reach)
              {
                content += solid[j];
                moment += solid[j] * offset;
              }
            if (distance < cut * cut * s * s)
              sum += solid[j] * std::exp(-0.5 * distance / (s * s));
          }
        weighted[ball] = moment.norm() > deep * reach * content ? -1 : sum;
      }
    double      inside = 0;
    std::size_t balls  = 0;
    for (const double of_ball : weighted)
      if (of_ball >= 0)
        {
          inside += of_ball;
          ++balls;
        }
    const double fraction = balls >= fewest ? inside / (static_cast<double>(balls) * kernel) : 0;
    // A lone particle, or a loose heap of few, is "deep" without being a body: its balls are then nearly empty.
    constexpr double loosest = 0.3;
    return fraction > loosest ? 1 / fraction : of_box(centre, radius, total, dimension, thickness);
  }
} // namespace dem
