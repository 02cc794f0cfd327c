// Vectors of links with moments while the pair moves and turns: doc/theory/shear-kinematics.md, 4.
#include "dem/kernels/moment_kinematics.h"

#include "clusters.h"
#include "dem/kernels/half_records.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  dem::Vec<double, 3> vec(const Vector3d &v) { return {{v[0], v[1], v[2]}}; }
  Vector3d            eigen(const dem::Vec<double, 3> &v) { return {v[0], v[1], v[2]}; }

  /** Rotation vector times tan(t/2)/(t/2). */
  Vector3d stretched(const Vector3d &theta)
  {
    const double half = 0.5 * theta.norm();
    return half > 0 ? Vector3d(theta * std::tan(half) / half) : theta;
  }

  /** Two particles whose link carries shear, bending and twist; and the shear of a link without moments between the same two. */
  struct Pair
  {
    Vector3d branch;
    double   first_arm = 0.5; ///< d_J/L
    Vector3d shear = Vector3d::Zero(), bending = Vector3d::Zero(), alone = Vector3d::Zero();
    double   twist = 0;

    void step(const Vector3d &next, const Vector3d &theta_J, const Vector3d &theta_K)
    {
      const Vector3d J = stretched(theta_J), K = stretched(theta_K), arms = first_arm * J + (1 - first_arm) * K;
      const dem::MomentPairMotion<double> m{vec(next), vec(next - branch), vec(arms), vec(0.5 * (J + K)),
                                            vec(theta_K - theta_J)};
      const dem::TurningLink<double>      link(m, 1.0);
      shear   = eigen(link.carried(vec(shear), link.slip));
      bending = eigen(link.carried(vec(bending), m.turned));
      twist += link.along(m.turned);
      dem::Vec<double, 3> stored[] = {vec(alone)};
      dem::advance_shear<true>(
        dem::PairMotion<double>{m.branch, m.increment, vec(0.5 * (theta_J + theta_K)), m.arm_rotation}, 1.0, stored);
      alone  = eigen(stored[0]);
      branch = next;
    }
  };

  /** A smooth motion over one unit of time in so many steps: the branch bends, stretches and turns, the ends spin differently. */
  Pair driven(const int steps)
  {
    const auto place = [](const double t) {
      return Vector3d((1 + 0.1 * std::sin(3 * t)) * std::cos(t), std::sin(t) + 0.2 * t * t,
                      0.3 + 0.5 * std::sin(2 * t));
    };
    Pair pair;
    pair.branch    = place(0);
    pair.first_arm = 0.4;
    pair.shear = pair.bending = pair.alone = pair.branch.cross(Vector3d(0, 0.3, 0.2));
    const double dt                        = 1.0 / steps;
    for (int n = 0; n < steps; ++n)
      {
        const double t = (n + 0.5) * dt;
        pair.step(place((n + 1) * dt), dt * Vector3d(0.7 * std::cos(t), 0.5, 1 + 0.2 * std::sin(5 * t)),
                  dt * Vector3d(0.2, -0.5 * std::cos(2 * t), 0.6 + 0.3 * std::sin(4 * t)));
      }
    return pair;
  }
} // namespace

TEST_CASE("vectors of a link with moments come back to themselves after a full rigid turn, and nothing is added",
          "[dem]")
{
  const Vector3d axis = Vector3d(1, 2, -0.7).normalized(), start = Vector3d::UnitX();
  for (const double first_arm : {0.5, 0.2})
    for (const int steps : {3, 100, 1000}) // the first: 120 degrees in a step
      {
        const double   angle = 2 * M_PI / steps;
        const Vector3d shear(0, 1e-4, 2e-4), bending(0, -3e-4, 1e-4);
        Pair           pair, empty;
        pair.branch = empty.branch = start;
        pair.first_arm = empty.first_arm = first_arm;
        pair.shear                       = shear;
        pair.bending                     = bending;
        for (int n = 1; n <= steps; ++n)
          {
            const Vector3d next = Eigen::AngleAxisd(angle * n, axis) * start;
            pair.step(next, angle * axis, angle * axis);
            empty.step(next, angle * axis, angle * axis);
          }
        CHECK((pair.shear - shear).norm() < 1e-15 * steps);
        CHECK((pair.bending - bending).norm() < 1e-15 * steps * 1e-4);
        CHECK(pair.twist == 0);
        CHECK(empty.shear.norm() < 1e-12);
        CHECK(empty.bending.norm() == 0);
      }
}

TEST_CASE("a pair that stretches while it turns rigidly does not shear", "[dem]")
{
  const Vector3d axis = Vector3d(0.2, -0.4, 1).normalized(), start = axis.unitOrthogonal();
  Pair           pair;
  pair.branch = start;
  for (int n = 1; n <= 10; ++n)
    pair.step((1 + 0.05 * n) * (Eigen::AngleAxisd(0.1 * n, axis) * start), 0.1 * axis, 0.1 * axis);
  CHECK(pair.shear.norm() < 1e-15);
  CHECK(pair.bending.norm() == 0);
}

TEST_CASE("vectors of a link with moments turn by the mean twist of its ends, and lie across it", "[dem]")
{
  Pair pair;
  pair.branch = Vector3d::UnitX();
  pair.shear = pair.bending = Vector3d(0, 1e-4, 0);
  for (int n = 0; n < 100; ++n)
    pair.step(pair.branch, Vector3d(0.01, 0, 0), Vector3d(0.01, 0, 0));
  const Vector3d turned = 1e-4 * Vector3d(0, std::cos(1.0), std::sin(1.0));
  CHECK((pair.shear - turned).norm() < 1e-17);
  CHECK((pair.bending - turned).norm() < 1e-17);
  for (int n = 0; n < 100; ++n) // back again, the ends differently: they twist the link
    pair.step(pair.branch, Vector3d(-0.015, 0, 0), Vector3d(-0.005, 0, 0));
  CHECK((pair.shear - Vector3d(0, 1e-4, 0)).norm() < 1e-4 * 100 * std::pow(0.015, 3)); // of third order in the step
  CHECK(pair.twist == Approx(1).epsilon(1e-12));
  const Pair moved = driven(50);
  CHECK(std::abs(moved.branch.dot(moved.shear)) < 1e-15);
  CHECK(std::abs(moved.branch.dot(moved.bending)) < 1e-15);
}

TEST_CASE("a link with moments shears as one without, to second order in the step", "[dem]")
{
  double     apart[2], error[2];
  const Pair exact = driven(12800);
  for (int halved = 0; halved < 2; ++halved)
    {
      const Pair pair = driven(100 << halved);
      apart[halved]   = (pair.shear - pair.alone).norm();
      error[halved]   = (pair.shear - exact.shear).norm() + (pair.bending - exact.bending).norm();
    }
  CHECK(apart[0] < 1e-4);
  CHECK(apart[0] / apart[1] == Approx(4).margin(0.2));
  // Both converge in the first order: a step's own slip is not twisted with the half of the step that it lasts.
  CHECK(error[0] < 5e-3);
  CHECK(error[0] / error[1] == Approx(2).margin(0.1));
}

TEST_CASE("half records hold the moments of eight links in their order", "[dem]")
{
  dem::Pack quantities[3];
  for (int i = 0; i < 3; ++i)
    quantities[i] = dem::pack_of([&](const int lane) { return 10.0 * (i + 1) + lane; });
  alignas(64) double record[dem::half_record_size * dem::pack_size];
  dem::store_half_records(quantities, record);
  for (int lane = 0; lane < dem::pack_size; ++lane)
    {
      const double *half = record + dem::half_record_size * lane;
      for (int i = 0; i < 3; ++i)
        CHECK(half[i] == 10.0 * (i + 1) + lane);
      CHECK(half[3] == 0);
      const dem::Pack placed = dem::at_rotations(dem::load_half(half));
      for (int c = 0; c < dem::record_size; ++c)
        CHECK(placed[c] == (c >= 3 && c < 6 ? half[c - 3] : 0.0));
    }
}

TEST_CASE("the moment of a link in the plane goes from the end of its record to the rotation about z", "[dem]")
{
  const dem::Pack record = dem::pack_of([](const int lane) { return 10.0 + lane; });
  const dem::Pack placed = dem::last_at_rotations(record);
  for (int c = 0; c < dem::record_size; ++c)
    CHECK(placed[c] == (c == 5 ? 17.0 : 0.0));
}
