// Regular particles whose links are not all as stiff: spec/coupling.md, 3.6, and doc/theory/volume-coupling.md, 6.
#include "apps/runs/transmission/methods.h"
#include "coupling/transmission/wave_case.h"

#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace
{
  using Eigen::Matrix2d;
  using Eigen::Vector2d;
  using Eigen::VectorXd;

  coupling::WaveMedium scattered_strip(const double scatter, const std::int64_t seed)
  {
    coupling::WaveMedium medium;
    medium.lattice = coupling::WaveMedium::Lattice::strip;
    medium.scatter = scatter;
    medium.seed    = seed;
    return medium;
  }

  /**
   * Energy of a periodic cell of n x n particles under an even strain, at rest, over that of links that are all of the average stiffness: central springs
   * of the stiffness that the medium has at their middle, and nothing of the program beside it.
   */
  double stiffness_of_cell(const coupling::WaveMedium &medium, const int n, const Matrix2d &strain)
  {
    const Vector2d                          along(1, 0), inclined(0.5, coupling::hexagonal_row_pitch);
    const std::array<Vector2d, 3>           axes{along, inclined, inclined - along};
    const std::array<std::array<int, 2>, 3> steps{{{1, 0}, {0, 1}, {-1, 1}}};
    const auto number = [n](const int i, const int j) { return n * ((j + n) % n) + (i + n) % n; };
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd                            pull = VectorXd::Zero(2 * n * n);
    double                              held = 0, even = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (std::size_t a = 0; a < 3; ++a)
          {
            const Vector2d middle = i * along + j * inclined + 0.5 * axes[a];
            const double k = medium.stiffness_at({middle.x(), middle.y(), 0}), stretch = axes[a].dot(strain * axes[a]);
            const Matrix2d           K = k * axes[a] * axes[a].transpose();
            const std::array<int, 2> ends{number(i, j), number(i + steps[a][0], j + steps[a][1])};
            held += 0.5 * k * stretch * stretch;
            even += 0.5 * stretch * stretch;
            for (int one = 0; one < 2; ++one)
              {
                pull.segment<2>(2 * ends[one]) += (one == 0 ? k : -k) * stretch * axes[a];
                for (int other = 0; other < 2; ++other)
                  for (int r = 0; r < 2; ++r)
                    for (int c = 0; c < 2; ++c)
                      entries.emplace_back(2 * ends[one] + r, 2 * ends[other] + c, one == other ? K(r, c) : -K(r, c));
              }
          }
    Eigen::SparseMatrix<double> K(2 * n * n, 2 * n * n);
    K.setFromTriplets(entries.begin(), entries.end());
    const int                                                freely    = 2 * n * n - 2; // one particle is held
    const Eigen::SparseMatrix<double>                        free_part = K.bottomRightCorner(freely, freely);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(free_part);
    const VectorXd                                           moved = solver.solve(pull.tail(freely));
    return (held - 0.5 * pull.tail(freely).dot(moved)) / even;
  }
} // namespace

TEST_CASE("scattered links: a plane of them is as stiff in the mean as links that are all of the effective modulus",
          "[verification][volume]")
{
  for (const double scatter : {0.3, 0.6})
    for (const Matrix2d &strain : {Matrix2d(Matrix2d::Identity()), Matrix2d((Matrix2d() << 0, 1, 1, 0).finished()),
                                   Matrix2d((Matrix2d() << 1, 0, 0, 0).finished())})
      {
        INFO("scatter " << scatter << ", strain " << strain);
        constexpr int cells = 4;
        double        mean  = 0;
        for (int seed = 1; seed <= cells; ++seed)
          mean += stiffness_of_cell(scattered_strip(scatter, seed), 60, strain) / cells;
        CHECK(mean == Approx(scattered_strip(scatter, 1).effective_modulus()).epsilon(0.002));
      }
}

TEST_CASE("scattered links: elements of the effective modulus carry on 95 % of a wave that gets to them",
          "[verification][volume][slow]")
{
  for (const double wavelength : {20.0, 24.0})
    {
      INFO("wavelength " << wavelength << " spacings");
      coupling::WaveCase wave;
      wave.medium      = scattered_strip(0.3, 1);
      wave.medium.rows = 48;
      wave.element     = 4;
      wave.wavelength  = wavelength;
      wave.step_factor = 0.69;
      wave.method      = apps::wave_methods().front();
      REQUIRE(wave.method.absorbs);
      const auto answer = coupling::transmit(wave);
      // Particles without elements throw back as much as this themselves, from where there are elements now.
      CHECK(answer.reflected <= 0.02);
      CHECK(answer.transmitted >= 0.95 * answer.unhindered);
      CHECK(answer.transmitted >= (wavelength > 20 ? 0.94 : 0.88));
    }
}
