#include "coupling/sequential/transfer.h"
#include "dem/core/errors.h"
#include "field_fixture.h"
#include "tests/fem/concrete_fixture.h"
#include "tests/fem/solid_fixture.h"

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
  CHECK_THROWS_AS(transfer(half, options, cube.solid), dem::InputError);
  CHECK_THROWS_WITH(transfer(half, options, cube.solid),
                    Contains("32 of 64 integration points have no particle within reach") && Contains("share of 0"));
  options.limits.empty = 0.5;
  const auto report    = transfer(half, options, cube.solid);
  CHECK(report.count.points == 64);
  CHECK(report.count.empty == 32);
  for (const MappedPoint &p : report.points)
    if (p.average.particles == 0)
      CHECK((p.kappa_p == 0 && p.kappa_d == 0 && p.average.stress.norm() == 0));
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

TEST_CASE("stress outside the yield surface is returned to it, and the amount told", "[coupling]")
{
  Cube       cube;
  const auto inside = transfer(field(-5e6, 0.1), {}, cube.solid);
  CHECK(inside.count.returned == 0);
  CHECK(inside.largest_return <= 1e-9 * 5e6);
  const auto outside = transfer(field(20e6, 0.1), {}, cube.solid); // f_t is 3 MPa
  CHECK(outside.count.returned == 64);
  CHECK(outside.largest_return > 15e6);
  CHECK(outside.largest_return < 30e6);
}

TEST_CASE("averages of too few particles and one-sided ones are counted", "[coupling]")
{
  Cube            cube;
  TransferOptions options;
  options.averaging.width  = 0.001; // reach 3 mm, distance of particles 10 mm
  options.averaging.fewest = 5;
  options.limits.empty     = 1;
  options.limits.sparse    = 1;
  const auto narrow        = transfer(field(-1e6, 0.2), options, cube.solid);
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
