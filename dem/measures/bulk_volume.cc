#include "dem/measures/bulk_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

    /** Solid around the middle of a ball. */
    struct Ball
    {
      Eigen::Vector3d middle;
      Eigen::Vector3d moment   = Eigen::Vector3d::Zero(); ///< of the content about the middle [m^4]
      double          content  = 0;                       ///< [m^3]
      double          weighted = 0;                       ///< by the Gaussian [m^3]
    };

    /** Which balls a place may matter to: a grid over all of them, each in the cells around its middle. */
    class BallsAround
    {
    public:
      /** reach: no place beyond it matters [m]. */
      BallsAround(const std::vector<Ball> &balls, const double reach)
      {
        constexpr double most_cells = 64; // along an edge
        Eigen::Array3d   high       = balls[0].middle;
        low                         = high;
        for (const Ball &ball : balls)
          {
            low  = low.min(ball.middle.array());
            high = high.max(ball.middle.array());
          }
        const double beyond = 1.001 * reach; // rounding moves no place past a cell in between
        edge                = ((high - low) / most_cells).max(beyond);
        low -= 1.5 * edge; // no ball lies in an outermost cell, so the cells around its own exist
        for (int d = 0; d < 3; ++d)
          cells[d] = static_cast<std::int64_t>((high[d] - low[d]) / edge[d]) + 2;
        in_cell.resize(cells[0] * cells[1] * cells[2]);
        for (std::size_t ball = 0; ball < balls.size(); ++ball)
          {
            const Index at = cell_of(balls[ball].middle);
            for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x)
              for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y)
                for (std::int64_t z = at[2] - 1; z <= at[2] + 1; ++z)
                  in_cell[number({x, y, z})].push_back(ball);
          }
      }

      const std::vector<std::size_t> &operator()(const Eigen::Vector3d &place) const
      {
        const Index at = cell_of(place);
        for (int d = 0; d < 3; ++d)
          if (at[d] < 0 || at[d] >= cells[d])
            return none;
        return in_cell[number(at)];
      }

    private:
      using Index = std::array<std::int64_t, 3>;

      Index cell_of(const Eigen::Vector3d &place) const
      {
        const Eigen::Array3d at = ((place.array() - low) / edge).floor();
        return {static_cast<std::int64_t>(at[0]), static_cast<std::int64_t>(at[1]), static_cast<std::int64_t>(at[2])};
      }

      std::size_t number(const Index &at) const { return (at[0] * cells[1] + at[1]) * cells[2] + at[2]; }

      Eigen::Array3d                        low, edge;
      Index                                 cells;
      std::vector<std::vector<std::size_t>> in_cell;
      const std::vector<std::size_t>        none;
    };

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
    std::vector<Ball> balls;
    for (std::size_t i = 0; i < n; i += stride)
      balls.push_back({centre[i]});
    const BallsAround around(balls, std::max(reach, cut * s));
    for (std::size_t i = 0; i < n; ++i)
      for (const std::size_t of_ball : around(centre[i]))
        {
          Ball                 &ball     = balls[of_ball];
          const Eigen::Vector3d offset   = centre[i] - ball.middle;
          const double          distance = offset.squaredNorm();
          if (distance < reach * reach)
            {
              ball.content += solid[i];
              ball.moment += solid[i] * offset;
            }
          if (distance < cut * cut * s * s)
            ball.weighted += solid[i] * std::exp(-0.5 * distance / (s * s));
        }
    double      inside    = 0;
    std::size_t deep_ones = 0;
    for (const Ball &ball : balls)
      if (!(ball.moment.norm() > deep * reach * ball.content))
        {
          inside += ball.weighted;
          ++deep_ones;
        }
    const double fraction = deep_ones >= fewest ? inside / (static_cast<double>(deep_ones) * kernel) : 0;
    // A lone particle, or a loose heap of few, is "deep" without being a body: its balls are then nearly empty.
    constexpr double loosest = 0.3;
    return fraction > loosest ? 1 / fraction : of_box(centre, radius, total, dimension, thickness);
  }
} // namespace dem
