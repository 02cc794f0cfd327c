#include "dem/measures/spline_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    using Record = Eigen::Matrix<double, 4, 1>;

    /** Places that one grid of its own collects: their number decides how sums are formed, not that of the threads. */
    constexpr std::size_t places_per_part = 16384;

    /** Of the four knots around a place. @param part of the way from the second to the third */
    std::array<double, 4> spline_weights(const double part)
    {
      const double rest = 1 - part;
      return {rest * rest * rest / 6, (4 - 6 * part * part + 3 * part * part * part) / 6,
              (4 - 6 * rest * rest + 3 * rest * rest * rest) / 6, part * part * part / 6};
    }
  } // namespace

  SplineGrid::SplineGrid(const std::vector<Eigen::Vector3d> &all, const double spacing, const int dimension)
    : places(all.size())
    , layers(dimension == 3 ? 4 : 1)
  {
    std::array<long, 3> low{}, high{};
    const auto          axes = static_cast<std::size_t>(dimension);
    const auto          knot = [&](const Eigen::Vector3d &place, const std::size_t c) {
      return static_cast<long>(std::floor(place[static_cast<Eigen::Index>(c)] / spacing));
    };
    for (std::size_t c = 0; c < axes && !all.empty(); ++c)
      {
        low[c] = high[c] = knot(all[0], c);
        for (const Eigen::Vector3d &place : all)
          {
            low[c]  = std::min(low[c], knot(place, c));
            high[c] = std::max(high[c], knot(place, c));
          }
      }
    knot_count = 1;
    for (std::size_t c = 0; c < 3; ++c)
      {
        size[c] = c < axes ? high[c] - low[c] + 4 : 1;
        knot_count *= static_cast<std::size_t>(size[c]);
      }
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        std::array<long, 3> first{};
        places[k].weight[2] = {1, 0, 0, 0};
        for (std::size_t c = 0; c < axes; ++c)
          {
            const double at     = all[k][static_cast<Eigen::Index>(c)] / spacing;
            first[c]            = knot(all[k], c) - low[c];
            places[k].weight[c] = spline_weights(at - std::floor(at));
          }
        places[k].first = static_cast<std::uint32_t>((first[2] * size[1] + first[1]) * size[0] + first[0]);
      }
  }

  void SplineGrid::spread_part(const std::size_t begin, const std::size_t end, const double *values, double *grid) const
  {
    for (std::size_t k = begin; k < end; ++k)
      {
        const Place &place = places[k];
        const Record value = Eigen::Map<const Record>(values + record * k);
        for (std::size_t z = 0; z < layers; ++z)
          for (std::size_t y = 0; y < 4; ++y)
            {
              const Record across = place.weight[2][z] * place.weight[1][y] * value;
              double      *row    = grid + record * (place.first + (z * static_cast<std::size_t>(size[1]) + y) *
                                                             static_cast<std::size_t>(size[0]));
              for (std::size_t x = 0; x < 4; ++x)
                Eigen::Map<Record>(row + record * x) += place.weight[0][x] * across;
            }
      }
  }

  void SplineGrid::spread(const base::Column &values, base::Column &grid) const
  {
    const std::size_t numbers = record * knot_count, count = (places.size() + places_per_part - 1) / places_per_part;
    grid.assign(numbers, 0.0);
    if (count > 1)
      parts.assign(numbers * (count - 1), 0.0);
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < count; ++p)
      spread_part(p * places_per_part, std::min((p + 1) * places_per_part, places.size()), values.data(),
                  p == 0 ? grid.data() : &parts[numbers * (p - 1)]);
    for (std::size_t p = 1; p < count; ++p)
      for (std::size_t i = 0; i < numbers; ++i)
        grid[i] += parts[numbers * (p - 1) + i];
  }

  void SplineGrid::gather(const base::Column &grid, base::Column &values) const
  {
    values.resize(record * places.size());
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        const Place &place = places[k];
        Record       sum   = Record::Zero();
        for (std::size_t z = 0; z < layers; ++z)
          for (std::size_t y = 0; y < 4; ++y)
            {
              const double *row    = grid.data() + record * (place.first + (z * static_cast<std::size_t>(size[1]) + y) *
                                                                          static_cast<std::size_t>(size[0]));
              Record        across = Record::Zero();
              for (std::size_t x = 0; x < 4; ++x)
                across += place.weight[0][x] * Eigen::Map<const Record>(row + record * x);
              sum += place.weight[2][z] * place.weight[1][y] * across;
            }
        Eigen::Map<Record>{&values[record * k]} = sum;
      }
  }
} // namespace dem
