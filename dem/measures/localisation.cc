#include "dem/measures/localisation.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace dem
{
  namespace
  {
    /** One of each pair k, -k in {-1, 0, 1}^3. */
    std::vector<std::array<int, 3>> waves(const int dimension)
    {
      std::vector<std::array<int, 3>> all;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b)
          for (int c = dimension == 3 ? -1 : 0; c <= (dimension == 3 ? 1 : 0); ++c)
            if (std::array<int, 3>{a, b, c} > std::array<int, 3>{0, 0, 0})
              all.push_back({a, b, c});
      return all;
    }

    /** Width w in (0, 1] of the even band with mean resultant length sin(pi w)/(pi w), by bisection: it falls with w. */
    double width_of(const double concentration)
    {
      double low = 0, high = 1;
      for (int i = 0; i < 60; ++i)
        {
          const double w                                                 = 0.5 * (low + high);
          (std::sin(M_PI * w) / (M_PI * w) > concentration ? low : high) = w;
        }
      return 0.5 * (low + high);
    }
  } // namespace

  Band strongest_band(const Eigen::Matrix3d              &base,
                      const std::vector<Eigen::Vector3d> &places,
                      const std::vector<double>          &weights,
                      const int                           dimension)
  {
    if (places.size() != weights.size())
      throw std::invalid_argument("strongest band: as many weights as places are needed.");
    double sum = 0, squares = 0;
    for (const double w : weights)
      {
        sum += w;
        squares += w * w;
      }
    Band band;
    if (!(sum > 0))
      return band;
    const Eigen::Matrix3d inverse = base.inverse();
    const auto            all     = waves(dimension);
    for (const auto &k : all)
      {
        const Eigen::Vector3d reciprocal = inverse.transpose() * Eigen::Vector3d(k[0], k[1], k[2]);
        std::complex<double>  resultant  = 0;
        for (std::size_t i = 0; i < places.size(); ++i)
          resultant += weights[i] * std::polar(1.0, 2.0 * M_PI * reciprocal.dot(places[i]));
        const double length = std::abs(resultant) / sum;
        if (length <= band.concentration)
          continue;
        const double phase = std::arg(resultant) / (2.0 * M_PI);
        band.wave          = k;
        band.concentration = length;
        band.normal        = reciprocal.normalized();
        band.period        = 1.0 / reciprocal.norm();
        band.place         = phase - std::floor(phase);
      }
    const double effective = sum * sum / squares;
    band.thickness         = width_of(band.concentration) * band.period;
    band.participation     = effective / static_cast<double>(places.size());
    band.by_chance =
      std::min(1.0, static_cast<double>(all.size()) * std::exp(-effective * band.concentration * band.concentration));
    return band;
  }
} // namespace dem
