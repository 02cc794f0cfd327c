#include "clusters.h"
#include "dem/kernels/kinematics.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  dem::Vec<double, 3> vec(const Vector3d &v) { return {{v[0], v[1], v[2]}}; }
  Vector3d            eigen(const dem::Vec<double, 3> &v) { return {v[0], v[1], v[2]}; }

  Matrix3d rotation(const Vector3d &vector)
  {
    const double angle = vector.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix() : Matrix3d::Identity();
  }

  /** Rotation vector times tan(t/2)/(t/2). */
  Vector3d stretched(const Vector3d &theta)
  {
    const double half = 0.5 * theta.norm();
    return half > 0 ? Vector3d(theta * std::tan(half) / half) : theta;
  }

  /** Two particles and the shear strain of their link, advanced step by step from positions and rotation vectors. */
  struct Pair
  {
    Vector3d branch;
    double   reference = 1;   ///< L0
    double   first_arm = 0.5; ///< d_J/L
    Vector3d shear     = Vector3d::Zero();

    void step(const Vector3d &next, const Vector3d &theta_J, const Vector3d &theta_K)
    {
      dem::PairMotion<double> m;
      m.branch                     = vec(next);
      m.increment                  = vec(next - branch);
      m.mean_rotation              = vec(0.5 * (theta_J + theta_K));
      m.arm_rotation               = vec(first_arm * stretched(theta_J) + (1 - first_arm) * stretched(theta_K));
      dem::Vec<double, 3> stored[] = {vec(shear)};
      dem::advance_shear<true>(m, 1.0 / reference, stored);
      shear  = eigen(stored[0]);
      branch = next;
    }
  };

  /** One full turn about (1, 2, -0.7) in equal steps, the pair's first particle drifting along. */
  Pair full_turn(const Vector3d &stored, const double first_arm, const int steps)
  {
    const Vector3d axis     = Vector3d(1, 2, -0.7).normalized(), drift(0.3, -0.2, 0.5);
    const double   angle    = 2 * M_PI / steps;
    const auto     position = [&](const Vector3d &at, const int n) {
      return Vector3d(Eigen::AngleAxisd(angle * n, axis) * at + n * drift / steps);
    };
    Pair pair;
    pair.branch    = Vector3d::UnitX();
    pair.shear     = stored;
    pair.first_arm = first_arm;
    for (int n = 1; n <= steps; ++n)
      pair.step(position(Vector3d(1.2, 0.3, 0.1), n) - position(Vector3d(0.2, 0.3, 0.1), n), angle * axis,
                angle * axis);
    return pair;
  }
} // namespace

TEST_CASE("shear strain of a link turned rigidly stays zero", "[dem]")
{
  // doc/theory/shear-kinematics.md, 1; the first-order update in common use leaves 7.8e-2 and 7.6e-3.
  for (const double first_arm : {0.5, 0.2}) // equal and unequal spheres
    {
      CHECK(full_turn(Vector3d::Zero(), first_arm, 100).shear.norm() < 1e-13);
      CHECK(full_turn(Vector3d::Zero(), first_arm, 1000).shear.norm() < 1e-12);
      CHECK(full_turn(Vector3d::Zero(), first_arm, 3).shear.norm() < 1e-14); // 120 degrees in a step
    }
}

TEST_CASE("stored shear strain comes back to itself after a full rigid turn", "[dem]")
{
  const Vector3d stored(0, 1e-4, 0);
  for (const int steps : {3, 100, 1000})
    CHECK((full_turn(stored, 0.5, steps).shear - stored).norm() < 1e-15 * steps);
}

TEST_CASE("stored shear strain turns by the common twist of the pair", "[dem]")
{
  for (const int steps : {1, 7, 500})
    {
      Pair pair;
      pair.branch = Vector3d::UnitX();
      pair.shear  = Vector3d(0, 1e-4, 0);
      for (int n = 0; n < steps; ++n)
        pair.step(pair.branch, Vector3d(1.0 / steps, 0, 0), Vector3d(1.0 / steps, 0, 0));
      const Vector3d exact = 1e-4 * Vector3d(0, std::cos(1.0), std::sin(1.0));
      CHECK((pair.shear - exact).norm() < 1e-15 * steps * 1e-4 * 10);
    }
}

TEST_CASE("stored shear strain turns by the mean twist when ends twist differently", "[dem]")
{
  Pair pair;
  pair.branch = Vector3d::UnitX();
  pair.shear  = Vector3d(0, 1e-4, 0);
  for (int n = 0; n < 100; ++n)
    pair.step(pair.branch, Vector3d(0.015, 0, 0), Vector3d(0.005, 0, 0));
  CHECK((pair.shear - 1e-4 * Vector3d(0, std::cos(1.0), std::sin(1.0))).norm() < 1e-17);
}

TEST_CASE("transverse translation strains the link by its length of arc in the turning frame", "[dem]")
{
  Pair pair;
  pair.branch = Vector3d::UnitX();
  for (int n = 1; n <= 100; ++n)
    pair.step(Vector3d(1, 1e-4 * n, 0), Vector3d::Zero(), Vector3d::Zero());
  CHECK(pair.shear.norm() == Approx(0.0099998).margin(5e-8).epsilon(0)); // asinh(0.01), to the digits given
  // Exactly: integral of cos(a) dy with y = tan(a), that is asinh(0.01); second order in the steps of 1e-4.
  CHECK(pair.shear.norm() == Approx(std::asinh(0.01)).epsilon(1e-8));
}

TEST_CASE("equal spins shear a link, gears do not", "[dem]")
{
  const Vector3d spin(0, 0, 0.01);
  Pair           pair;
  pair.branch = Vector3d::UnitX();
  pair.step(pair.branch, spin, spin);
  // (0, -0.01, 0) to first order; 2 tan(0.005) is the displacement of a rigid rotation.
  CHECK((pair.shear - Vector3d(0, -0.01, 0)).norm() < 1e-6);
  // The stored vector, none here, would have turned with the spins; the link itself has not.
  CHECK((pair.shear - Vector3d(0, -2 * std::tan(0.005), 0)).norm() < 1e-17);

  Pair gears;
  gears.branch = Vector3d::UnitX();
  gears.step(gears.branch, spin, -spin);
  CHECK(gears.shear.norm() == 0);

  Pair unequal_gears; // surfaces roll: d_J theta_J = -d_K theta_K
  unequal_gears.branch    = Vector3d::UnitX();
  unequal_gears.first_arm = 0.2;
  const Vector3d fast(0, 0, 2 * std::atan(0.004)), slow(0, 0, -2 * std::atan(0.001));
  unequal_gears.step(unequal_gears.branch, fast, slow);
  CHECK(unequal_gears.shear.norm() < 1e-18);
}

TEST_CASE("spin of one end shears a link by its own arm", "[dem]")
{
  Pair pair;
  pair.branch    = Vector3d(2, 0, 0);
  pair.reference = 1.9;
  pair.first_arm = 0.3;
  pair.step(pair.branch, Vector3d(0, 0, 0.02), Vector3d::Zero());
  CHECK((pair.shear - Vector3d(0, -0.3 * 2 * 2 * std::tan(0.01) / 1.9, 0)).norm() < 1e-17);
  pair.step(pair.branch, Vector3d::Zero(), Vector3d(0, 0, 0.02));
  // The vector stored so far turns with half the spin about z and is carried back onto the normal plane: unchanged.
  CHECK((pair.shear - Vector3d(0, -2 * 2 * std::tan(0.01) / 1.9, 0)).norm() < 1e-16);
}

TEST_CASE("shear increment in a turning frame differs by second order in its turn", "[dem]")
{
  // One small motion, seen at rest and by an observer who turns by an angle during the same step, about an axis across the link.
  // Rigid motion is exact; what a motion adds is measured in the middle of the step, which leaves a part of order angle^2 of it.
  // (A turn along the link leaves half the angle: doc/theory/shear-kinematics.md, 1, does not twist the increment of the step itself.)
  dem::UniformRandom random(5);
  for (int trial = 0; trial < 20; ++trial)
    {
      const Vector3d link(0.9, 0.1, -0.4), about = link.cross(cluster::random_direction(random)).normalized();
      const Vector3d motion = 1e-6 * cluster::random_vector(random), spin = 1e-6 * cluster::random_vector(random);
      Pair           at_rest;
      at_rest.branch       = link;
      at_rest.first_arm    = 0.4;
      const Pair     start = at_rest;
      const Vector3d next  = start.branch + motion;
      at_rest.step(next, spin, spin);
      double error[2];
      for (int halved = 0; halved < 2; ++halved)
        {
          const Matrix3d          turn = rotation(0.1 / (1 << halved) * about);
          const Eigen::AngleAxisd both(turn * rotation(spin));
          Pair                    observed = start;
          observed.step(turn * next, both.angle() * both.axis(), both.angle() * both.axis());
          error[halved] = (observed.shear - turn * at_rest.shear).norm();
        }
      CHECK(error[0] < 0.1 * 0.1 * 1e-6);
      CHECK(error[0] / error[1] == Approx(4).margin(0.1));
    }
}

TEST_CASE("rotation coefficients join the exact functions where the series ends", "[dem]")
{
  for (const double angle : {1e-12, 1e-6, 1e-3, 0.00999, 0.0099999, 0.0100001, 0.011, 0.5, 3.0})
    {
      const auto        c = dem::rotation_coefficients(angle * angle);
      const long double a = angle, half = sinl(a / 2);
      INFO("angle = " << angle);
      CHECK(c.sine == Approx(static_cast<double>(sinl(a) / a)).epsilon(4e-16));
      CHECK(c.versine == Approx(static_cast<double>(2 * half * half / (a * a))).epsilon(4e-16));
      CHECK(dem::half_tangent_factor(c, angle * angle) ==
            Approx(static_cast<double>(tanl(a / 2) / (a / 2))).epsilon(angle < 1 ? 1e-15 : 2e-14)); // 1 + cos at 3 rad
    }
}

TEST_CASE("shear update in the plane is the spatial one for motion in the plane", "[dem]")
{
  dem::UniformRandom random(6);
  const auto         number = [&](const double size) { return size * (2 * random() - 1); };
  for (const double size : {1e-6, 1e-2, 0.3})
    {
      Pair pair;
      pair.branch          = Vector3d(0.8, 0.5, 0);
      pair.reference       = pair.branch.norm();
      pair.first_arm       = 0.35;
      double plane_shear   = 0;
      double largest_error = 0;
      for (int n = 0; n < 100; ++n)
        {
          const Vector3d               next = pair.branch.normalized() + Vector3d(number(size), number(size), 0);
          const Vector3d               theta_J(0, 0, number(size)), theta_K(0, 0, number(size));
          dem::PlanePairMotion<double> m;
          m.branch                     = {{next[0], next[1]}};
          m.increment                  = {{next[0] - pair.branch[0], next[1] - pair.branch[1]}};
          m.arm_rotation               = 0.35 * stretched(theta_J)[2] + 0.65 * stretched(theta_K)[2];
          dem::Vec<double, 1> stored[] = {{{plane_shear}}};
          const auto          frame    = dem::advance_shear<true>(m, 1.0 / pair.reference, stored);
          plane_shear                  = stored[0][0];
          pair.step(next, theta_J, theta_K);
          const Vector3d turned(-frame.direction[1], frame.direction[0], 0);
          largest_error = std::max(largest_error, (pair.shear - plane_shear * turned).norm());
          CHECK(frame.length == Approx(next.norm()).epsilon(1e-15));
        }
      CHECK(largest_error < 1e-15 * 100 * 5); // 100 steps, strains of order one at most
    }
}

TEST_CASE("shear update without rotations is the one with particles that do not spin", "[dem]")
{
  dem::UniformRandom      random(8);
  dem::PairMotion<double> m = {};
  for (int n = 0; n < 100; ++n)
    {
      const Vector3d branch      = Vector3d::UnitX() + 0.3 * cluster::random_vector(random);
      m.branch                   = vec(branch);
      m.increment                = vec(0.1 * cluster::random_vector(random));
      const Vector3d      n0     = (branch - eigen(m.increment)).normalized();
      const auto          start  = vec(1e-3 * n0.cross(cluster::random_vector(random)));
      dem::Vec<double, 3> with[] = {start}, without[] = {start};
      dem::advance_shear<true>(m, 1.0, with);
      dem::advance_shear<false>(m, 1.0, without);
      CHECK((eigen(with[0]) - eigen(without[0])).norm() < 1e-16);
    }
}
