#include "base/errors.h"
#include "coupling/sequential/transfer.h"
#include "fem/references/concrete_points.h"
#include "field_fixture.h"
#include "tests/fem/solid_fixture.h"

using namespace fem::references;

using namespace coupling;
using Catch::Contains;

namespace
{
  /// A cube of eight elements, free of supports but for rigid motion.
  struct Cube
  {
    explicit Cube(const bool elastic_only = false)
      : solid(fem::make_mesh<3>(box<3>({0.1, 0.1, 0.1}, {2, 2, 2}), fem::ElementFamily::hypercube, MPI_COMM_SELF), {})
    {
      if (elastic_only)
        solid.assign("0", fem::make_points(elastic(30e9, 0.2), fem::Plane::strain));
      else
        solid.assign("0", fem::make_points(fem::DamagePlasticConcrete(material_m1()), fem::Plane::strain));
      fem::Loads<3> loads;
      loads.remove_rigid_motion = true;
      solid.set_loads(loads);
    }

    fem::Solid<3> solid;
  };

  ParticleField field(const double stress, const double damage, const Eigen::Vector3d &edges = {0.1, 0.1, 0.1})
  {
    return fields::box(edges, {10, 10, 10}, 0.5, fields::constant(fields::symmetric(stress, 0, 0, 0, 0, 0)),
                       fields::constant(damage * Eigen::Matrix3d::Identity()));
  }

  /// Damage tensor d 1 that the default law maps to a raw damage: raw = (2.09 * 0.5 d)^4.7.
  double isotropic_for(const double raw) { return std::pow(raw, 1 / 4.7) / (2.09 * 0.5); }
} // namespace

TEST_CASE("points without particles are counted, left virgin, and refused past the limit", "[coupling]")
{
  const ParticleField half = field(-1e6, 0.2, {0.02, 0.1, 0.1}); // particles on one side only
  Cube                cube;
  TransferOptions     options;
  options.averaging.width = 0.01;
  CHECK_THROWS_AS(transfer(half, options, cube.solid), base::InputError);
  CHECK_THROWS_WITH(transfer(half, options, cube.solid),
                    Contains("32 of 64 integration points have no particle within reach") && Contains("share of 0"));
  options.limits.empty       = 0.5;
  options.limits.mean_stress = options.limits.cut_force = 1; // half of the stress has no point to go to
  const auto report                                     = transfer(half, options, cube.solid);
  CHECK(report.count.points == 64);
  CHECK(report.count.empty == 32);
  for (const MappedPoint &p : report.points)
    if (p.average.particles == 0)
      CHECK((p.hardening == 0 && p.damage_driving == 0 && p.average.stress.norm() == 0));
}

TEST_CASE("points at or past full damage are counted, taken as 1 - 1e-6, and refused past the limit", "[coupling]")
{
  Cube            cube;
  TransferOptions options;
  CHECK_THROWS_WITH(transfer(field(0, isotropic_for(1.1)), options, cube.solid),
                    Contains("64 of 64 integration points are fully damaged"));
  options.limits.fully_damaged = 1;
  const auto report            = transfer(field(0, isotropic_for(1.1)), options, cube.solid);
  CHECK(report.count.fully_damaged == 64);
  for (const MappedPoint &p : report.points)
    CHECK(p.mapped.raw == Approx(1.1).epsilon(1e-10));
}

TEST_CASE("points at the switch of hardening are counted", "[coupling]")
{
  for (const auto &[raw, at] : {std::pair{5e-4, 64u}, {4.99e-4, 64u}, {2e-4, 0u}, {2e-3, 0u}})
    {
      Cube cube;
      CHECK(transfer(field(0, isotropic_for(raw)), {}, cube.solid).count.at_switch == at);
    }
}

TEST_CASE("stress outside the yield surface is returned to it, and the amount reported", "[coupling]")
{
  Cube       cube;
  const auto inside = transfer(field(-5e6, 0.1), {}, cube.solid);
  CHECK(inside.count.returned == 0);
  CHECK(inside.largest_return <= 1e-9 * 5e6);
  TransferOptions options;
  options.limits.outside = 1;
  const auto outside     = transfer(field(20e6, 0.1), options, cube.solid); // f_t is 3 MPa
  CHECK(outside.count.returned == 64);
  CHECK(outside.count.outside == 64);
  CHECK(outside.largest_return > 15e6);
  CHECK(outside.largest_return < 30e6);
}

TEST_CASE("a state whose stresses lie far outside the yield surface is refused", "[coupling]")
{
  Cube            cube;
  TransferOptions options;
  options.strength = 3e6;
  CHECK(transfer(field(-5e6, 0.1), options, cube.solid).count.outside == 0);
  CHECK_THROWS_WITH(transfer(field(-5e9, 0.1), options, cube.solid), // kPa taken for Pa, say
                    Contains("64 of 64 integration points have stresses so far outside the yield surface") &&
                      Contains("share of 0.2"));
  // Outside, but by less than a tenth of the strength: a return like any other. Uniaxial tension at f_t is on the surface.
  const auto little = transfer(field(3.1e6, 0), options, cube.solid);
  CHECK(little.count.returned == 64);
  CHECK(little.count.outside == 0);
}

TEST_CASE("what points and particles differ by is measured by the stress there is, but not by less than the strength",
          "[coupling]")
{
  // Particles only in the half x < 0.05 bear stress: by the nearest one the points do too, and half the cuts' particles are gone.
  const auto half = [](const double stress) {
    return fields::box(
      {0.1, 0.1, 0.1}, {10, 10, 10}, 0,
      [stress](const Eigen::Vector3d &x) -> Eigen::Matrix3d {
        return fields::symmetric(x[0] < 0.05 ? stress : 0, 0, 0, 0, 0, 0);
      },
      fields::constant(Eigen::Matrix3d::Zero()));
  };
  Cube            cube;
  TransferOptions options;
  options.averaging.width    = 0.05; // blurs the step: the cuts differ, the mean does not
  options.limits.mean_stress = 1e-3;
  options.limits.cut_force   = 0.05;
  CHECK_THROWS_WITH(transfer(half(-10e6), options, cube.solid),
                    Contains("the forces over a cut of points and particles differ by") &&
                      Contains("the scene allows 0.05"));
  options.strength = 3e6;
  CHECK_THROWS_AS(transfer(half(-10e6), options, cube.solid), base::InputError); // 10 MPa measure themselves
  const TransferReport small = transfer(half(-1e5), options, cube.solid); // 0.1 MPa left over are 3 % of the strength
  CHECK(small.cuts.points.size() == 2);
  CHECK(small.cuts.force_error(0) > 0.05);
  CHECK(small.cuts.force_error(3e6) < 0.034);
  CHECK(small.integrals.stress_error(3e6) < 1e-3);
}

TEST_CASE("a mean stress that the points do not keep is refused past the limit", "[coupling]")
{
  // Stress in one corner, of which the nearest points take a larger or smaller share than the particles had.
  const ParticleField corner = fields::box(
    {0.1, 0.1, 0.1}, {10, 10, 10}, 0,
    [](const Eigen::Vector3d &x) -> Eigen::Matrix3d {
      return fields::symmetric(x.maxCoeff() < 0.02 ? -8e6 : 0, 0, 0, 0, 0, 0);
    },
    fields::constant(Eigen::Matrix3d::Zero()));
  Cube            cube;
  TransferOptions options;
  options.averaging.kernel = Kernel::nearest;
  options.limits.cut_force = 10;
  CHECK_THROWS_WITH(transfer(corner, options, cube.solid),
                    Contains("the mean stresses of points and particles differ by") &&
                      Contains("the scene allows 0.25"));
  options.strength = 3e6; // the mean is 64 kPa: nothing beside the strength
  CHECK_NOTHROW(transfer(corner, options, cube.solid));
}

TEST_CASE("cuts through slabs that particles fill in part, or not at all, compare stresses", "[coupling]")
{
  // As of a specimen whose grips are left out: the particles end 15 mm before the solid at either end.
  ParticleField gripped = field(-5e6, 0.1);
  for (std::size_t i = gripped.size(); i-- > 0;)
    if (std::abs(gripped.place[i][0] - 0.05) > 0.035)
      for (auto *column : {&gripped.stress, &gripped.damage})
        column->erase(column->begin() + static_cast<std::ptrdiff_t>(i));
  for (std::size_t i = gripped.place.size(); i-- > 0;)
    if (std::abs(gripped.place[i][0] - 0.05) > 0.035)
      {
        gripped.volume.erase(gripped.volume.begin() + static_cast<std::ptrdiff_t>(i));
        gripped.place.erase(gripped.place.begin() + static_cast<std::ptrdiff_t>(i));
      }
  Cube       cube;
  const auto report = transfer(gripped, {}, cube.solid);
  CHECK(report.cuts.points.size() > 0);
  CHECK(report.cuts.force_error(0) < 1e-12);
  CHECK(report.cuts.section == Approx(0.01).epsilon(0.5));
}

TEST_CASE("averages of too few particles and one-sided ones are counted", "[coupling]")
{
  Cube            cube;
  TransferOptions options;
  options.averaging.width    = 0.001; // reach 3 mm, distance of particles 10 mm
  options.averaging.fewest   = 5;
  options.limits.empty       = 1;
  options.limits.sparse      = 1;
  options.limits.mean_stress = options.limits.cut_force = 1;
  const auto narrow                                     = transfer(field(-1e6, 0.2), options, cube.solid);
  CHECK(narrow.count.sparse + narrow.count.empty == 64);
  options                 = {};
  options.averaging.width = 0.03;
  CHECK(transfer(field(-1e6, 0.2), options, cube.solid).count.boundary > 0); // points 21 mm from three faces
}

TEST_CASE("a solid without history, and dimensions that differ, are refused", "[coupling]")
{
  Cube without(true), cube;
  CHECK_THROWS_WITH(transfer(field(-1e6, 0.2), {}, without.solid), Contains("no part of the solid has a history"));
  ParticleField plane = field(-1e6, 0.2);
  plane.dimension     = 2;
  CHECK_THROWS_WITH(transfer(plane, {}, cube.solid), Contains("2 dimensions to a solid in 3"));
}

TEST_CASE("a mapped state far from equilibrium is refused past the limit", "[coupling]")
{
  Cube cube;
  transfer(field(-5e6, 0.2), {}, cube.solid);
  fem::StaticSolver<3> solver(cube.solid);
  TransferLimits       limits;
  limits.imbalance = 0.01;
  CHECK_THROWS_WITH(equilibrate(cube.solid, solver, limits), Contains("out of balance by") && Contains("allows 0.01"));
}
