#include "coupling/sequential/damage_observation.h"

#include "field_fixture.h"

#include <catch2/catch.hpp>

using namespace coupling;

namespace
{
  /// Damaged only between z = 0.07 and 0.08 of a bar of 0.1 x 0.1 x 0.2 m, layers 10 mm apart.
  ParticleField cracked()
  {
    return fields::box({0.1, 0.1, 0.2}, {10, 10, 20}, 0, fields::constant(Eigen::Matrix3d::Zero()),
                       [](const Eigen::Vector3d &x) -> Eigen::Matrix3d {
                         return (x[2] > 0.07 && x[2] < 0.08 ? 0.9 : 0.0) * Eigen::Matrix3d::Identity();
                       });
  }

  double observed(const Kernel kernel, const double width)
  {
    AveragingOptions averaging;
    averaging.kernel = kernel;
    averaging.width  = width;
    return observed_damage(cracked(), averaging, 2, 0.05)(2, 2);
  }
} // namespace

TEST_CASE(
  "the damage that decides a specimen's strength is the mean where points take the mean, else that of the weakest slab",
  "[coupling]")
{
  CHECK(observed(Kernel::specimen, 0.01) == Approx(0.9 / 20).epsilon(1e-12));
  // Slabs hold whole layers: the cracked one alone, or with one or two others.
  CHECK(observed(Kernel::nearest, 0) == Approx(0.9).epsilon(1e-12)); // as thick as a particle, 10 mm
  const double narrow = observed(Kernel::gaussian, 0.007),
               wide   = observed(Kernel::gaussian, 0.03); // 17.5 and 75 mm thick
  CHECK((narrow == Approx(0.9) || narrow == Approx(0.45)));
  CHECK(wide > 0.9 / 9);
  CHECK(wide < 0.9 / 6);
  CHECK(observed(Kernel::gaussian, 1) == Approx(0.9 / 20).epsilon(1e-12)); // wider than the specimen
}
