#include "coupling/sequential/section_forces.h"
#include "coupling/sequential/transfer.h"
#include "fem/references/concrete_points.h"
#include "field_fixture.h"
#include "tests/fem/solid_fixture.h"

#include <Eigen/Geometry>

using namespace fem::references;

using namespace coupling;
using dealii::Point;

namespace
{
  const Eigen::Matrix3d stress = fields::symmetric(-4e6, -1e6, 0.3e6, 0.2e6, -0.4e6, 0.5e6); // inside the yield surface
  const Eigen::Matrix3d damage = fields::symmetric(0.5, 0.4, -0.1, 0.05, 0.02, -0.03);

  fem::DamagePlasticConcrete concrete()
  {
    auto p          = material_m1();
    p.element_size  = 0; // from the mesh
    p.crack_opening = 3e-4;
    return fem::DamagePlasticConcrete(p);
  }

  fem::Loads<3> statically_determinate()
  {
    fem::Loads<3> loads;
    loads.remove_rigid_motion = true;
    return loads;
  }

  struct Solids
  {
    const char        *name;
    fem::ElementFamily family;
    double             distortion;
    unsigned int       degree;
  };
  const std::vector<Solids> meshes = {{"hexahedra", fem::ElementFamily::hypercube, 0, 1},
                                      {"distorted hexahedra", fem::ElementFamily::hypercube, 0.2, 1},
                                      {"quadratic hexahedra", fem::ElementFamily::hypercube, 0, 2},
                                      {"tetrahedra", fem::ElementFamily::simplex, 0, 1}};

  std::unique_ptr<fem::Solid<3>> make_solid(const Solids &m, const std::vector<unsigned int> &elements)
  {
    fem::SolidOptions options;
    options.degree = m.degree;
    auto solid     = std::make_unique<fem::Solid<3>>(
      fem::make_mesh<3>(box<3>({0.1, 0.1, 0.1}, elements, m.distortion), m.family, MPI_COMM_SELF), options);
    const auto names = solid->mesh().materials;
    for (const auto &entry : names)
      solid->assign(entry.first, fem::make_points(concrete(), options.plane));
    solid->set_loads(statically_determinate());
    return solid;
  }

  TransferOptions options_of(const Kernel kernel)
  {
    TransferOptions options;
    options.averaging.kernel = kernel;
    return options;
  }
} // namespace

TEST_CASE("a uniform stress and damage field is transferred exactly to any mesh", "[coupling]")
{
  const ParticleField field =
    fields::box({0.1, 0.1, 0.1}, {14, 14, 14}, 0.8, fields::constant(stress), fields::constant(damage));
  const MappedDamage expected = map_damage(damage, {});
  REQUIRE(expected.damage > 0);
  for (const Solids &m : meshes)
    for (const Kernel kernel : {Kernel::gaussian, Kernel::nearest})
      {
        CAPTURE(m.name);
        const auto           made_solid = make_solid(m, {3, 3, 3});
        fem::Solid<3>       &solid      = *made_solid;
        const TransferReport report     = transfer(field, options_of(kernel), solid);
        CHECK(report.count.points == report.points.size());
        CHECK(report.count.empty == 0);
        CHECK(report.integrals.stress_error(0) <= 1e-12);
        CHECK(report.integrals.damage_error() <= 1e-12);
        fem::Vector rest = solid.make_vector();
        rest.update_ghost_values();
        solid.visit_points(rest, [&](const fem::PointView<3> &view) {
          CHECK((base::stress_tensor(view.stress) - stress).norm() <= 1e-12 * stress.norm());
        });
        for (const MappedPoint &p : report.points)
          {
            CHECK(p.mapped.damage == Approx(expected.damage).epsilon(1e-12));
            // 1 - omega = exp(-(h/w_f)(kappa_D + omega f_t/E)) holds with the point's own element size
            const double right = std::exp(-(p.size / 3e-4) * (p.damage_driving + p.mapped.damage * 3e6 / 30e9));
            CHECK(1 - p.mapped.damage == Approx(right).epsilon(1e-10));
          }
      }
}

TEST_CASE("a linear field arrives at the points exactly by the linear fit", "[coupling]")
{
  const auto linear = [](const Eigen::Vector3d &x) -> Eigen::Matrix3d { return (1 + 3 * x[0] - 2 * x[2]) * stress; };
  const ParticleField field = fields::box({0.1, 0.1, 0.1}, {14, 14, 14}, 0.8, linear, fields::constant(damage));
  for (const Solids &m : meshes)
    {
      CAPTURE(m.name);
      const auto           made_solid = make_solid(m, {4, 4, 4});
      fem::Solid<3>       &solid      = *made_solid;
      const TransferReport report     = transfer(field, options_of(Kernel::moving_least_squares), solid);
      CHECK(report.count.averaged == 0);
      for (const MappedPoint &p : report.points)
        CHECK((p.average.stress - linear(p.place)).norm() <= 1e-11 * stress.norm());
    }
}

TEST_CASE("force and moment over any cut of the mapped field are those of the particles", "[coupling]")
{
  // Bending: linear over the height. By the linear fit the mapped field is exact, and Gauss points integrate it and its moment
  // exactly; the particles' own sum is a midpoint rule, whose error of 1/n^2 of the moment is known.
  const int  n       = 14;
  const auto bending = [](const Eigen::Vector3d &x) {
    return fields::symmetric(1e6 + 4e7 * (x[1] - 0.05), 0, 0, 0, 0, 0);
  };
  const ParticleField          field = fields::box({0.1, 0.1, 0.1}, {n, n, n}, 0, bending, fields::constant(damage));
  const auto                   made_solid = make_solid(meshes[0], {4, 4, 4});
  fem::Solid<3>               &solid      = *made_solid;
  const auto                   report     = transfer(field, options_of(Kernel::moving_least_squares), solid);
  std::vector<Eigen::Vector3d> place;
  std::vector<double>          volume;
  std::vector<Eigen::Matrix3d> mapped;
  for (const MappedPoint &p : report.points)
    {
      place.push_back(p.place);
      volume.push_back(p.volume);
      mapped.push_back(p.average.stress);
    }
  Sections sections;
  sections.high   = 0.1;
  sections.centre = {0, 0.05, 0.05};
  for (const int cuts : {1, 2})
    {
      sections.count       = cuts;
      const auto particles = section_forces(sections, field.place, field.volume, field.stress);
      const auto points    = section_forces(sections, place, volume, mapped);
      for (std::size_t s = 0; s < points.size(); ++s)
        {
          CHECK(points[s].force[0] == Approx(particles[s].force[0]).epsilon(1e-11));
          CHECK(points[s].moment[2] * (1 - 1.0 / (n * n)) == Approx(particles[s].moment[2]).epsilon(1e-10));
        }
    }
}

TEST_CASE("rotating particles and mesh together rotates the result", "[coupling]")
{
  const auto linear = [](const Eigen::Vector3d &x) -> Eigen::Matrix3d { return (1 + 3 * x[0] - 2 * x[2]) * stress; };
  const ParticleField   field  = fields::box({0.1, 0.1, 0.1}, {10, 10, 10}, 0.8, linear, fields::constant(damage));
  const Eigen::Matrix3d R      = Eigen::AngleAxisd(0.8, Eigen::Vector3d(-1, 0.4, 2).normalized()).toRotationMatrix();
  ParticleField         turned = field;
  for (std::size_t i = 0; i < field.size(); ++i)
    {
      turned.place[i]  = R * field.place[i];
      turned.stress[i] = R * field.stress[i] * R.transpose();
      turned.damage[i] = R * field.damage[i] * R.transpose();
    }
  const auto turned_box = [&](dealii::Triangulation<3> &mesh) {
    box<3>({0.1, 0.1, 0.1}, {3, 3, 3})(mesh);
    dealii::GridTools::transform(
      [&](const Point<3> &x) {
        const Eigen::Vector3d y = R * Eigen::Vector3d(x[0], x[1], x[2]);
        return Point<3>(y[0], y[1], y[2]);
      },
      mesh);
  };
  fem::Solid<3> solid(fem::make_mesh<3>(turned_box, fem::ElementFamily::hypercube, MPI_COMM_SELF), {});
  solid.assign("0", fem::make_points(concrete(), fem::Plane::strain));
  solid.set_loads(statically_determinate());
  const auto     made_upright = make_solid(meshes[0], {3, 3, 3});
  fem::Solid<3> &upright      = *made_upright;

  TransferOptions options = options_of(Kernel::gaussian);
  options.averaging.width = 0.0197;
  const auto a = transfer(field, options, upright), b = transfer(turned, options, solid);
  REQUIRE(a.points.size() == b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
    {
      REQUIRE((b.points[i].place - R * a.points[i].place).norm() < 1e-12);
      CHECK((b.points[i].average.stress - R * a.points[i].average.stress * R.transpose()).norm() <=
            1e-10 * stress.norm());
      CHECK(b.points[i].mapped.damage == Approx(a.points[i].mapped.damage).epsilon(1e-10));
      CHECK(b.points[i].damage_driving == Approx(a.points[i].damage_driving).epsilon(1e-10));
    }
}

TEST_CASE(
  "the equilibrium iteration lets a uniform stress relax to the free body's zero, and says by how much it was off",
  "[coupling]")
{
  const ParticleField field =
    fields::box({0.1, 0.1, 0.1}, {14, 14, 14}, 0.8, fields::constant(stress), fields::constant(damage));
  const auto     made_solid = make_solid(meshes[1], {3, 3, 3});
  fem::Solid<3> &solid      = *made_solid;
  transfer(field, options_of(Kernel::gaussian), solid);
  fem::StaticSolver<3> solver(solid);
  const Equilibration  done = equilibrate(solid, solver, {});
  CHECK(done.before.relative() > 0.1);
  CHECK(done.after.relative() <= 1e-6 * done.before.relative());
  const double stiffness = (1 - map_damage(damage, {}).damage) * 30e9;
  CHECK(done.largest_displacement > 0.01 * 0.1 * stress.norm() / stiffness);
  CHECK(done.largest_displacement < 10 * 0.1 * stress.norm() / stiffness);
  solid.visit_points(solver.displacement(), [&](const fem::PointView<3> &view) {
    CHECK(base::stress_tensor(view.stress).norm() <= 1e-6 * stress.norm());
  });
}
