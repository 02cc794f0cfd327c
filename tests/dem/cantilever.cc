// Static deflection of cantilevers of N equal bonded spheres (or discs), reached by damped motion.
//
// A link carries a normal force N and a shear force S but no moment, so a single row of spheres is a mechanism in bending; the
// slenderest beam that bends is a ladder of two rows:
//
//      o--o--o--o--o  F/2        columns 0..n, column 0 held; h: spacing of rows and columns
//      |  |  |  |  |   |
//      o--o--o--o--o  F/2
//
// It is statically determinate. By symmetry each row carries S = F/2 in every bay, and +N, -N along it. Moments about a particle of
// column j vanish: h/2 (S + S) of its two bays and h/2 T_j of its rung, so T_j = F inside and F/2 in the last column. Forces along
// the row: N of the bay grows by T_j from column to column, N = F/2 in the last bay, 3F/2 in the one before, and so on. From the
// energy (2 N^2 / (2 k_N) and 2 S^2 / (2 k_T) of each bay, T^2 / (2 k_T) of each rung) and F delta/2:
//
//      delta/F = n (4 n^2 - 1)/(6 k_N) + (6 n - 3)/(4 k_T).
//
// Without rotations a row is a chain of shear springs, delta/F = n/k_T for one row.

#include "clusters.h"
#include "dem/specimen/specimen.h"
#include "dense_stiffness.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <string>
#include <vector>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, h = 2 * r, E = 25e9, G = 5e9;

  constexpr std::array<bool, 6> all = {true, true, true, true, true, true}, sideways = {false, true};

  /** Hold some particles, move others by a small deflection along y, relax; the stiffness F/delta. */
  double stiffness(const dem::Packing             &packing,
                   dem::SpecimenParameters         p,
                   const std::vector<std::size_t> &held,
                   const std::vector<std::size_t> &moved,
                   const int                       passes = 200)
  {
    omp_set_num_threads(1);
    p         = cluster::elastic(p);
    p.damping = 0.8;
    dem::Specimen specimen(packing, p, cluster::concrete());
    dem::Grip     foot, tip;
    foot.particles  = held;
    foot.prescribed = all;
    tip.particles   = moved;
    tip.prescribed  = sideways;
    specimen.grips().add(foot);
    const std::size_t load  = specimen.grips().add(tip);
    const int         ramp  = 2000;
    const double      speed = 1e-6 * h / (ramp * specimen.time_step());
    specimen.grips().set_velocity(load, {0, speed, 0}, Vector3d::Zero());
    specimen.advance(ramp);
    specimen.grips().set_velocity(load, Vector3d::Zero(), Vector3d::Zero());
    double before = 0, force = 1;
    for (int pass = 0; pass < passes && std::abs(force - before) > 1e-9 * std::abs(force); ++pass)
      {
        before = force;
        specimen.advance(2000);
        force = specimen.grips().reaction(load).y();
      }
    return force / specimen.particles().displacement[moved[0]].y();
  }

  /** Deflection 1e-6 h: its square is what the straight geometry neglects; round-off of strains 1e-16 in 1e-7. */
  constexpr double small_deflection = 2e-6;
} // namespace

TEST_CASE("cantilever ladder of bonded spheres deflects by its closed form", "[dem]")
{
  for (const int dimension : {3, 2})
    for (const int n : {1, 2, 4})
      {
        auto p              = cluster::next_neighbours();
        p.physics.dimension = dimension;
        p.thickness         = 1.5e-3;
        const double area = dimension == 3 ? M_PI * r * r : 2 * r * p.thickness, k_N = E * area / h, k_T = G * area / h;
        const auto   column = [&](const int i) {
          return std::vector<std::size_t>{static_cast<std::size_t>(i), static_cast<std::size_t>(i + n + 1)};
        };
        const double found = stiffness(cluster::cubic_lattice(n + 1, 2, 1, r), p, column(0), column(n));
        INFO(dimension << "D, " << n << " bays");
        CHECK(1 / found ==
              Approx(n * (4.0 * n * n - 1) / (6 * k_N) + (6.0 * n - 3) / (4 * k_T)).epsilon(small_deflection));
      }
}

TEST_CASE("cantilever row of spheres that do not spin deflects as a chain of shear springs", "[dem]")
{
  for (const int n : {1, 5})
    {
      auto p              = cluster::next_neighbours();
      p.physics.rotations = false;
      const double found  = stiffness(cluster::cubic_lattice(n + 1, 1, 1, r), p, {0}, {static_cast<std::size_t>(n)});
      CHECK(1 / found == Approx(n / (G * M_PI * r * r / h)).epsilon(small_deflection));
    }
}

TEST_CASE("single row of spinning bonded spheres is a mechanism in bending", "[dem]")
{
  const double k_T = G * M_PI * r * r / h;
  CHECK(std::abs(stiffness(cluster::cubic_lattice(4, 1, 1, r), cluster::next_neighbours(), {0}, {3}, 10)) < 1e-6 * k_T);
}

namespace
{
  /** Stiffness of a small bonded body against moving one particle along y while another is held, by a dense solve. */
  double
  dense_stiffness(const dem::Packing &packing, const double iota, const std::size_t held, const std::size_t moved)
  {
    const std::size_t n = packing.size();
    Eigen::MatrixXd   K = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        {
          const Vector3d branch = packing.centre[j] - packing.centre[i];
          const double   L = branch.norm(), r_i = packing.radius[i], r_j = packing.radius[j];
          const double   area = M_PI * std::pow(std::min(r_i, r_j), 2);
          if (L < iota * (r_i + r_j))
            dense::add(K, {i, j, branch, r_i + 0.5 * (L - r_i - r_j), E * area / L, G * area / L});
        }
    std::vector<Eigen::Index> free;
    const auto                prescribed = static_cast<Eigen::Index>(6 * moved + 1);
    for (Eigen::Index i = 0; i < K.rows(); ++i)
      if (i / 6 != static_cast<Eigen::Index>(held) && i != prescribed)
        free.push_back(i);
    const auto      m = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd reduced(m, m);
    Eigen::VectorXd coupling(m);
    for (Eigen::Index i = 0; i < m; ++i)
      {
        coupling[i] = K(free[i], prescribed);
        for (Eigen::Index j = 0; j < m; ++j)
          reduced(i, j) = K(free[i], free[j]);
      }
    return K(prescribed, prescribed) - coupling.dot(reduced.ldlt().solve(coupling));
  }
} // namespace

TEST_CASE("static stiffness of a cluster of unequal spheres is that of its assembled matrix", "[dem]")
{
  for (const double smallest : {0.4 * r, r})
    {
      const dem::Packing packing = cluster::random_cluster(51, 12, smallest, r);
      std::size_t        far     = 0;
      for (std::size_t i = 0; i < packing.size(); ++i)
        if (packing.centre[i].norm() > packing.centre[far].norm())
          far = i;
      const double iota = 1.8; // enough links that nothing rattles
      CHECK(
        stiffness(packing, cluster::bonded(iota), {0}, {far}) ==
        Approx(dense_stiffness(packing, iota, 0, far)).epsilon(1e-5)); // deflection over the distance to the next link
    }
}
