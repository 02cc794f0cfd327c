#include "dem/measures/spline_grid.h"

#include "dem/core/simd.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

namespace dem
{
  namespace
  {
    /** Places that one grid of its own collects: their number decides how sums are formed, not that of the threads. */
    constexpr std::size_t places_per_part = 4096;
    /** Products of two B-splines, integrated, by their distance in knots. */
    constexpr std::array<double, 4> overlap_of_splines{2416.0 / 5040, 1191.0 / 5040, 120.0 / 5040, 1.0 / 5040};
    constexpr std::size_t           reach_of_splines = overlap_of_splines.size() - 1;

    /** Of the four knots around a place. @param part of the way from the second to the third */
    std::array<double, 4> spline_weights(const double part)
    {
      const double rest = 1 - part;
      return {rest * rest * rest / 6, (4 - 6 * part * part + 3 * part * part * part) / 6,
              (4 - 6 * rest * rest + 3 * rest * rest * rest) / 6, part * part * part / 6};
    }

    /** The knots around a cell: 16 of each layer in two packs. */
    template <std::size_t Layers, std::size_t Count>
    struct KnotBlock
    {
      static constexpr std::size_t rows = 4;
      Pack                         packs[Count][2 * Layers];

      /** Let a function see each row of four: column, where it starts in the block, where it starts on the grid. */
      template <typename Function>
      static void each_row(const std::size_t first, const std::array<long, 3> &size, Function &&f)
      {
        for (std::size_t z = 0; z < Layers; ++z)
          for (std::size_t y = 0; y < rows; ++y)
            f(rows * (rows * z + y),
              first + (z * static_cast<std::size_t>(size[1]) + y) * static_cast<std::size_t>(size[0]));
      }
    };
  } // namespace

  SplineGrid::SplineGrid(const std::vector<Eigen::Vector3d> &all,
                         const double                        spacing,
                         const int                           dimension,
                         const Components                   &components)
    : places(all.size())
    , first(all.size())
    , given(all.size())
    , requested(components)
    , step(spacing)
    , layers(dimension == 3 ? 4 : 1)
  {
    std::array<long, 3> high{};
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
    std::vector<std::uint32_t> cell(all.size());
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        std::array<long, 3> at{};
        for (std::size_t c = 0; c < axes; ++c)
          at[c] = knot(all[k], c) - low[c];
        cell[k] = static_cast<std::uint32_t>((at[2] * size[1] + at[1]) * size[0] + at[0]);
      }
    std::iota(given.begin(), given.end(), std::size_t(0));
    std::stable_sort(given.begin(), given.end(),
                     [&](const std::size_t a, const std::size_t b) { return cell[a] < cell[b]; });
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        std::array<std::array<double, 4>, 3> weight{{{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}};
        for (std::size_t c = 0; c < axes; ++c)
          {
            const double at = all[given[k]][static_cast<Eigen::Index>(c)] / spacing;
            weight[c]       = spline_weights(at - std::floor(at));
          }
        for (std::size_t y = 0; y < 4; ++y)
          for (std::size_t x = 0; x < 4; ++x)
            places[k].across[4 * y + x] = weight[1][y] * weight[0][x];
        places[k].along = weight[2];
        first[k]        = cell[given[k]];
      }
  }

  Eigen::Vector3d SplineGrid::place_of_knot(const std::size_t knot) const
  {
    const auto            n = static_cast<long>(knot);
    const Eigen::Vector3d index(static_cast<double>(n % size[0]), static_cast<double>(n / size[0] % size[1]),
                                static_cast<double>(n / size[0] / size[1]));
    Eigen::Vector3d       place;
    for (Eigen::Index c = 0; c < 3; ++c)
      place[c] = size[static_cast<std::size_t>(c)] == 1 ?
                   0.0 :
                   step * (static_cast<double>(low[static_cast<std::size_t>(c)]) - 1 + index[c]);
    return place;
  }

  std::size_t SplineGrid::parts() const { return (places.size() + places_per_part - 1) / places_per_part; }

  template <std::size_t Layers, std::size_t Count>
  void SplineGrid::spread_part(
    const std::size_t begin, const std::size_t end, const double *values, const double *factors, double *grid) const
  {
    using Block = KnotBlock<Layers, Count>;
    for (std::size_t k = begin, next; k < end; k = next)
      {
        Block block{};
        for (next = k; next < end && first[next] == first[k]; ++next)
          {
            const Place &place    = places[next];
            const Pack   low_rows = Pack::load_unaligned(&place.across[0]),
                       high_rows  = Pack::load_unaligned(&place.across[8]);
            for (std::size_t c = 0; c < Count; ++c)
              {
                const double value = factors[next] * values[record * next + requested.first + c];
                for (std::size_t z = 0; z < Layers; ++z)
                  {
                    const Pack share(Layers == 1 ? value : value * place.along[z]);
                    block.packs[c][2 * z]     = multiply_add(share, low_rows, block.packs[c][2 * z]);
                    block.packs[c][2 * z + 1] = multiply_add(share, high_rows, block.packs[c][2 * z + 1]);
                  }
              }
          }
        for (std::size_t c = 0; c < Count; ++c)
          {
            double sums[16 * Layers];
            for (std::size_t b = 0; b < 2 * Layers; ++b)
              block.packs[c][b].store_unaligned(&sums[pack_size * b]);
            double *column = grid + c * knot_count;
            Block::each_row(first[k], size, [&](const std::size_t from, const std::size_t to) {
              for (std::size_t x = 0; x < Block::rows; ++x)
                column[to + x] += sums[from + x];
            });
          }
      }
  }

  template <std::size_t Layers, std::size_t Count>
  void SplineGrid::take_off_part(const std::size_t begin,
                                 const std::size_t end,
                                 const double     *grid,
                                 const double     *values,
                                 const double     *factors,
                                 double           *left) const
  {
    using Block = KnotBlock<Layers, Count>;
    for (std::size_t k = begin, next; k < end; k = next)
      {
        Block block;
        for (std::size_t c = 0; c < Count; ++c)
          {
            double        around[16 * Layers];
            const double *column = grid + c * knot_count;
            Block::each_row(first[k], size, [&](const std::size_t to, const std::size_t from) {
              std::copy_n(column + from, Block::rows, &around[to]);
            });
            for (std::size_t b = 0; b < 2 * Layers; ++b)
              block.packs[c][b] = Pack::load_unaligned(&around[pack_size * b]);
          }
        for (next = k; next < end && first[next] == first[k]; ++next)
          {
            const Place &place    = places[next];
            const Pack   low_rows = Pack::load_unaligned(&place.across[0]),
                       high_rows  = Pack::load_unaligned(&place.across[8]);
            for (std::size_t c = 0; c < Count; ++c)
              {
                Pack low_sum = block.packs[c][0], high_sum = block.packs[c][1];
                if constexpr (Layers > 1)
                  {
                    low_sum *= place.along[0];
                    high_sum *= place.along[0];
                    for (std::size_t z = 1; z < Layers; ++z)
                      {
                        low_sum  = multiply_add(Pack(place.along[z]), block.packs[c][2 * z], low_sum);
                        high_sum = multiply_add(Pack(place.along[z]), block.packs[c][2 * z + 1], high_sum);
                      }
                  }
                const std::size_t at = record * next + requested.first + c;
                left[at] = factors[next] * (values[at] - sum_of(multiply_add(low_sum, low_rows, high_sum * high_rows)));
              }
          }
      }
  }

  template <typename Use>
  void SplineGrid::dispatch(Use &&use) const
  {
    const auto of_layers = [&](auto number) {
      constexpr std::size_t of = decltype(number)::value;
      switch (requested.count)
        {
        case 1:
          return use(&SplineGrid::spread_part<of, 1>, &SplineGrid::take_off_part<of, 1>);
        case 2:
          return use(&SplineGrid::spread_part<of, 2>, &SplineGrid::take_off_part<of, 2>);
        default:
          return use(&SplineGrid::spread_part<of, 3>, &SplineGrid::take_off_part<of, 3>);
        }
    };
    if (layers == 1)
      of_layers(std::integral_constant<std::size_t, 1>());
    else
      of_layers(std::integral_constant<std::size_t, 4>());
  }

  void SplineGrid::spread(const base::Column &values, const base::Column &factors, base::Column &grid) const
  {
    const std::size_t numbers = requested.count * knot_count, count = parts();
    grid.assign(numbers, 0.0);
    if (count > 1)
      of_parts.assign(numbers * (count - 1), 0.0);
    dispatch([&](const auto part, auto) {
#pragma omp parallel for schedule(static)
      for (std::size_t p = 0; p < count; ++p)
        (this->*part)(p * places_per_part, std::min((p + 1) * places_per_part, places.size()), values.data(),
                      factors.data(), p == 0 ? grid.data() : &of_parts[numbers * (p - 1)]);
    });
    for (std::size_t p = 1; p < count; ++p)
      for (std::size_t i = 0; i < numbers; ++i)
        grid[i] += of_parts[numbers * (p - 1) + i];
  }

  void SplineGrid::take_off(const base::Column &grid,
                            const base::Column &values,
                            const base::Column &factors,
                            base::Column       &left) const
  {
    left.resize(record * places.size());
    const std::size_t count = parts();
    dispatch([&](auto, const auto part) {
#pragma omp parallel for schedule(static)
      for (std::size_t p = 0; p < count; ++p)
        (this->*part)(p * places_per_part, std::min((p + 1) * places_per_part, places.size()), grid.data(),
                      values.data(), factors.data(), left.data());
    });
  }

  void SplineGrid::smooth(base::Column &columns) const
  {
    const std::size_t count = columns.size() / knot_count;
#pragma omp parallel for schedule(static)
    for (std::size_t c = 0; c < count; ++c)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (size[axis] > 1)
          smooth_along(axis, &columns[c * knot_count]);
  }

  void SplineGrid::smooth_along(const std::size_t axis, double *column) const
  {
    // Lines along the axis, side by side where they are far apart in memory: blocks of `beside` numbers follow each other.
    std::size_t beside = 1;
    for (std::size_t c = 0; c < axis; ++c)
      beside *= static_cast<std::size_t>(size[c]);
    const auto          length = static_cast<std::size_t>(size[axis]), block = beside * length;
    const std::size_t   margin = reach_of_splines * beside;
    std::vector<double> line(block + 2 * margin, 0.0);
    for (double *here = column; here < column + knot_count; here += block)
      {
        std::copy_n(here, block, line.begin() + static_cast<std::ptrdiff_t>(margin));
        for (std::size_t i = 0; i < block; ++i)
          {
            const double *middle = &line[margin + i];
            double        sum    = overlap_of_splines[0] * *middle;
            for (std::size_t away = 1; away <= reach_of_splines; ++away)
              sum += overlap_of_splines[away] * (middle[away * beside] + *(middle - away * beside));
            here[i] = sum;
          }
      }
  }
} // namespace dem
