#include "coupling/sequential/averaging.h"

#include "coupling/sequential/section_forces.h"
#include "field_fixture.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using namespace coupling;

namespace
{
  const Eigen::Matrix3d uniform = fields::symmetric(-3e6, 1e6, 2e6, 0.3e6, -0.7e6, 0.5e6);
  const Eigen::Matrix3d slope   = fields::symmetric(2e7, -1e7, 4e7, 3e7, 1e7, -2e7);

  Eigen::Matrix3d linear(const Eigen::Vector3d &x) { return uniform + (x[0] - 2 * x[1] + 0.5 * x[2]) * slope; }

  const std::vector<Eigen::Vector3d> probes = {{0.05, 0.05, 0.05}, {0, 0, 0}, {0.1, 0.05, 0.02}, {0.03, 0.1, 0.1}};

  AveragingOptions by(const Kernel kernel, const double width = 0)
  {
    AveragingOptions options;
    options.kernel = kernel;
    options.width  = width;
    return options;
  }
} // namespace

TEST_CASE("every kernel returns a uniform field, also at faces, edges and corners", "[coupling]")
{
  const ParticleField field =
    fields::box({0.1, 0.1, 0.1}, {12, 12, 12}, 0.8, fields::constant(uniform), fields::constant(1e-7 * slope));
  for (const Kernel kernel :
       {Kernel::nearest, Kernel::ball, Kernel::gaussian, Kernel::moving_least_squares, Kernel::specimen})
    for (const Eigen::Vector3d &x : probes)
      {
        const coupling::Average a = Averaging(field, by(kernel)).at(x, 0.03);
        // Weights sum to one to rounding; a linear fit at a corner magnifies it about tenfold.
        CHECK((a.stress - uniform).norm() <= 1e-13 * uniform.norm());
        CHECK((a.damage - 1e-7 * slope).norm() <= 1e-13 * 1e-7 * slope.norm());
      }
}

TEST_CASE("moving least squares returns a linear field from disordered particles, boundaries included", "[coupling]")
{
  const ParticleField field = fields::box({0.1, 0.1, 0.1}, {12, 12, 12}, 0.8, linear, linear);
  const Averaging     averaging(field, by(Kernel::moving_least_squares));
  for (const Eigen::Vector3d &x : probes)
    {
      const coupling::Average a = averaging.at(x, 0.03);
      CHECK(a.linear);
      CHECK((a.stress - linear(x)).norm() <= 1e-12 * uniform.norm());
    }
}

TEST_CASE("a smooth field is averaged with second order in the width", "[coupling]")
{
  // Ratio of widths to particle spacing kept large and fixed, so that the disorder of the particles does not show.
  const auto smooth = [](const Eigen::Vector3d &x) -> Eigen::Matrix3d {
    return std::sin(8 * x[0] + 5 * x[1]) * uniform;
  };
  const auto error = [&](const Kernel kernel, const int n, const std::vector<Eigen::Vector3d> &places) {
    const ParticleField field = fields::box({0.1, 0.1, 0.1}, {n, n, n}, 0, smooth, fields::constant(uniform));
    const Averaging     averaging(field, by(kernel, 0.15 / n));
    double              largest = 0;
    for (const Eigen::Vector3d &x : places)
      largest = std::max(largest, (averaging.at(x, 0.01).stress - smooth(x)).norm() / uniform.norm());
    return largest;
  };
  const std::vector<Eigen::Vector3d> inside = {{0.05, 0.05, 0.05}, {0.055, 0.045, 0.05}};
  for (const Kernel kernel : {Kernel::gaussian, Kernel::moving_least_squares})
    {
      const double order = std::log2(error(kernel, 16, inside) / error(kernel, 32, inside));
      CAPTURE(static_cast<int>(kernel));
      CHECK(order > 1.8);
      CHECK(order < 2.2);
    }
  const double at_boundary =
    std::log2(error(Kernel::moving_least_squares, 16, probes) / error(Kernel::moving_least_squares, 32, probes));
  CHECK(at_boundary > 1.7);
  CHECK(at_boundary < 2.3);
  const double one_sided = std::log2(error(Kernel::gaussian, 16, probes) / error(Kernel::gaussian, 32, probes));
  CHECK(one_sided > 0.8); // the plain average is of first order at a boundary
  CHECK(one_sided < 1.2);
}

TEST_CASE("the offset distinguishes a boundary from the inside", "[coupling]")
{
  const ParticleField field =
    fields::box({0.1, 0.1, 0.1}, {30, 30, 30}, 0, fields::constant(uniform), fields::constant(uniform));
  const Averaging averaging(field, by(Kernel::gaussian, 0.008));
  CHECK(averaging.at({0.05, 0.05, 0.05}, 0.01).offset < 0.02);
  // Centre of half a Gaussian: sqrt(2/pi); the cut at three widths and the grid change the second decimal.
  CHECK(averaging.at({0.0, 0.05, 0.05}, 0.01).offset == Approx(std::sqrt(2 / M_PI)).epsilon(0.05));
}

TEST_CASE("rotating the particles and the point rotates the tensors", "[coupling]")
{
  const Eigen::Matrix3d R      = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.7).normalized()).toRotationMatrix();
  const ParticleField   field  = fields::box({0.1, 0.1, 0.1}, {9, 9, 9}, 0.8, linear, linear);
  ParticleField         turned = field;
  for (std::size_t i = 0; i < field.size(); ++i)
    {
      turned.place[i]  = R * field.place[i];
      turned.stress[i] = R * field.stress[i] * R.transpose();
      turned.damage[i] = R * field.damage[i] * R.transpose();
    }
  for (const Kernel kernel :
       {Kernel::nearest, Kernel::ball, Kernel::gaussian, Kernel::moving_least_squares, Kernel::specimen})
    for (const Eigen::Vector3d &x : probes)
      {
        const coupling::Average a = Averaging(field, by(kernel, 0.0213)).at(x, 0.03),
                                b = Averaging(turned, by(kernel, 0.0213)).at(R * x, 0.03);
        CHECK(a.particles == b.particles);
        CHECK((b.stress - R * a.stress * R.transpose()).norm() <= 1e-10 * a.stress.norm());
        CHECK((b.damage - R * a.damage * R.transpose()).norm() <= 1e-10 * a.damage.norm());
      }
}

TEST_CASE("a point out of reach is undetermined, and marked so", "[coupling]")
{
  const ParticleField     field = fields::box({0.1, 0.1, 0.1}, {9, 9, 9}, 0, linear, linear);
  const coupling::Average far   = Averaging(field, by(Kernel::gaussian)).at({1, 1, 1}, 0.01);
  CHECK(far.particles == 0);
  CHECK(far.stress.norm() == 0);
  CHECK(Averaging(field, by(Kernel::nearest)).at({1, 1, 1}, 0.01).particles == 1);
}

TEST_CASE("moving least squares falls back to the average where particles determine no plane", "[coupling]")
{
  const ParticleField     field = fields::box({0.1, 0.1, 0.1}, {20, 20, 1}, 0, linear, linear); // a sheet
  const coupling::Average a     = Averaging(field, by(Kernel::moving_least_squares)).at({0.05, 0.05, 0.05}, 0.01);
  CHECK_FALSE(a.linear);
  CHECK((a.stress - linear({0.05, 0.05, 0.05})).norm() <= 1e-10 * uniform.norm()); // symmetric about the point
}

TEST_CASE("in the plane the linear fit leaves the third direction alone", "[coupling]")
{
  ParticleField field = fields::box({0.1, 0.1, 0.01}, {20, 20, 1}, 0.8, linear, linear);
  field.dimension     = 2;
  const auto in_plane = [](const Eigen::Vector3d &x) { return linear({x[0], x[1], 0}); };
  for (std::size_t i = 0; i < field.size(); ++i)
    {
      field.place[i][2] = 0;
      field.stress[i]   = in_plane(field.place[i]);
    }
  const coupling::Average a = Averaging(field, by(Kernel::moving_least_squares)).at({0, 0.05, 0}, 0.02);
  CHECK(a.linear);
  CHECK((a.stress - in_plane({0, 0.05, 0})).norm() <= 1e-12 * uniform.norm());
}

TEST_CASE("section forces of a beam in bending are its normal force and moments", "[coupling]")
{
  // sigma_xx = n + m y over a section b x h: N = n b h, and the moment r x f about z is -m b h^3/12 (lever y, force x).
  const double n = 1e6, m = 5e7, b = 0.04, h = 0.06;
  const auto   bending = [&](const Eigen::Vector3d &x) {
    return fields::symmetric(n + m * (x[1] - 0.5 * h), 0, 0, 0, 0, 0);
  };
  const ParticleField field = fields::box({0.2, h, b}, {40, 24, 8}, 0, bending, fields::constant(uniform));
  Sections            sections;
  sections.high   = 0.2;
  sections.count  = 5;
  sections.centre = {0, 0.5 * h, 0.5 * b};
  for (const SectionForce &s : section_forces(sections, field.place, field.volume, field.stress))
    {
      CHECK(s.force[0] == Approx(n * b * h).epsilon(1e-12));
      // 24 particles over the height: the midpoint rule loses 1/24^2 of the moment of inertia, exactly.
      CHECK(s.moment[2] == Approx(-m * b * h * h * h / 12 * (1 - 1.0 / (24 * 24))).epsilon(1e-12));
      CHECK(std::abs(s.moment[1]) <= 1e-12 * std::abs(s.moment[2]));
    }
}
