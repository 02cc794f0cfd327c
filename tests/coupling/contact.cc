// Deformable bodies that touch each other: momentum, energy and friction of their contact.
#include "contact_fixture.h"

using namespace contact_fixture;
using Eigen::Vector3d;

namespace
{
  /** What a collision has shown. */
  struct Seen
  {
    double momentum = 0, turn = 0; ///< largest changes, over those of the start
    double made     = 0;           ///< largest energy made by the contact, over that of the start
    double left     = 0;           ///< at the end, over that of the start, minus one
    double force    = 0;           ///< the largest [N]
    bool   touching = false;       ///< at the end
  };

  template <int dim>
  Seen collide(Bodies<dim> &b, const int steps)
  {
    const coupling::Momentum start  = coupling::momentum_of(*b.participant);
    const double             energy = b.energy();
    Seen                     seen;
    for (int n = 0; n < steps; ++n)
      {
        b.both->advance(1.0);
        seen.momentum = std::max(seen.momentum, (coupling::momentum_of(*b.participant).linear - start.linear).norm() /
                                                  start.linear.norm());
        seen.turn     = std::max(seen.turn, b.contact().balance().turn.norm() / start.angular.norm());
        seen.made     = std::max(seen.made, std::fabs(b.contact().balance().spurious()) / energy);
        seen.force    = std::max(seen.force, b.contact().contacts().on_body()[0].norm());
      }
    seen.left     = b.energy() / energy - 1;
    seen.touching = b.contact().contacts().touching() > 0;
    return seen;
  }

  template <int dim>
  typename Bodies<dim>::Velocity beyond(const double x0, const dealii::Tensor<1, dim> &velocity)
  {
    return [=](const dealii::Point<dim> &x) { return x[0] > x0 ? velocity : dealii::Tensor<1, dim>(); };
  }
} // namespace

TEST_CASE("body contact: a closed system keeps its momentum, and a potential its energy", "[coupling]")
{
  const auto family   = GENERATE(fem::ElementFamily::hypercube, fem::ElementFamily::simplex);
  const auto friction = GENERATE(0.0, 0.5);
  CAPTURE(static_cast<int>(family), friction);
  Bodies<3>  b(parts<3>(cubes(), family), beyond<3>(1.05, dealii::Tensor<1, 3>({-4, 0.5, -0.8})),
               contact(coupling::bodies::BodyContactForm::potential, friction));
  const Seen seen = collide(b, 1500);
  CHECK(seen.momentum < 1e-12);
  CHECK(seen.turn < 1e-12);
  CHECK(seen.made < 0.01);
  CHECK(seen.left == Approx(0).margin(0.005));
  CHECK(seen.force > 1e4);
  CHECK_FALSE(seen.touching);
  CHECK((b.contact().balance().energy.dissipated > 0.05 * b.energy()) == (friction > 0));
}

TEST_CASE("body contact: the potential's energy error is of second order in the step", "[coupling][slow]")
{
  double before = 0;
  for (const double safety : {0.5, 0.25, 0.125})
    {
      Bodies<3>    b(parts<3>(cubes(), fem::ElementFamily::hypercube),
                     beyond<3>(1.05, dealii::Tensor<1, 3>({-4, 0.5, -0.8})),
                     contact(coupling::bodies::BodyContactForm::potential, 0), 1e7, safety);
      const double made = collide(b, static_cast<int>(1500 * 0.5 / safety)).made;
      INFO("safety " << safety << ": " << made);
      CHECK((before == 0 || before / made > 3.2));
      before = made;
    }
}

namespace
{
  /** The cubes twisted, so that no quadrilateral on them is plane. */
  fem::Mesh<3> warped_cubes()
  {
    fem::Mesh<3> mesh = parts<3>(cubes(), fem::ElementFamily::hypercube);
    dealii::GridTools::transform(
      [](const dealii::Point<3> &x) {
        const double turn = 0.9 * x[0], y = x[1] - 0.4, z = x[2] - 0.7;
        return dealii::Point<3>(x[0], 0.4 + y * std::cos(turn) - z * std::sin(turn),
                                0.7 + y * std::sin(turn) + z * std::cos(turn));
      },
      *mesh.triangulation);
    return mesh;
  }
} // namespace

TEST_CASE("body contact: faces that are not plane lie on the surface, and the contact holds what it has worked",
          "[coupling]")
{
  double before = 0;
  for (const double safety : {0.5, 0.25})
    {
      Bodies<3>   b(warped_cubes(), beyond<3>(1.1, dealii::Tensor<1, 3>({-4, 0, 0})),
                    contact(coupling::bodies::BodyContactForm::potential, 0), 1e7, safety);
      const auto &layers = b.contact().contacts().mesh();
      int         sides  = 0;
      for (const coupling::bodies::BodySimplex &simplex : layers.simplices)
        for (int side = 0; side < 4; ++side)
          if (simplex.surface >> side & 1)
            {
              ++sides;
              for (int c = 0; c < 4; ++c)
                CHECK((c == side || layers.depth[static_cast<std::size_t>(simplex.vertex[c])] == 0));
            }
      CHECK(sides == 4 * 6 * (9 + 4));
      const Seen seen = collide(b, static_cast<int>(1500 * 0.5 / safety));
      INFO("safety " << safety << ": " << seen.made);
      CHECK(seen.made < 0.01);
      CHECK((before == 0 || before / seen.made > 3.2)); // what is left is the step's
      CHECK(seen.force > 1e4);
      CHECK_FALSE(seen.touching);
      before = seen.made;
    }
}

TEST_CASE("body contact: the penalty keeps momentum, and energy to some per cent", "[coupling]")
{
  const auto family = GENERATE(fem::ElementFamily::hypercube, fem::ElementFamily::simplex);
  CAPTURE(static_cast<int>(family));
  Bodies<3>  b(parts<3>(cubes(), family), beyond<3>(1.05, dealii::Tensor<1, 3>({-4, 0.5, -0.8})),
               contact(coupling::bodies::BodyContactForm::penalty, 0.5));
  const Seen seen = collide(b, 1500);
  CHECK(seen.momentum < 1e-12);
  CHECK(seen.turn < 1e-12);
  CHECK(seen.left == Approx(0).margin(0.05));
  CHECK(seen.force > 1e4);
  CHECK_FALSE(seen.touching);
}

TEST_CASE("body contact: in the plane momentum and energy are kept as well", "[coupling]")
{
  const auto family = GENERATE(fem::ElementFamily::hypercube, fem::ElementFamily::simplex);
  CAPTURE(static_cast<int>(family));
  Bodies<2>  b(parts<2>({{{0, 0}, {1, 1}, {4, 4}, 0}, {{1.25, 0.0}, {1.85, 0.6}, {3, 3}, 0.2}}, family),
               beyond<2>(1.05, dealii::Tensor<1, 2>({-4, 0.5})),
               contact(coupling::bodies::BodyContactForm::potential, 0.3));
  const Seen seen = collide(b, 3000);
  CHECK(seen.momentum < 1e-12);
  CHECK(seen.turn < 1e-12);
  CHECK(seen.made < 0.01);
  CHECK(seen.left == Approx(0).margin(0.005));
  CHECK(seen.force > 1e4);
  CHECK_FALSE(seen.touching);
}

TEST_CASE("body contact: equal bodies that meet head-on exchange their velocities", "[coupling]")
{
  // Bars: the wave goes through both once and leaves nothing behind (Saint-Venant), but for what the mesh disperses.
  Bodies<3>    b(parts<3>({{{0, 0, 0}, {1, 0.2, 0.2}, {20, 2, 2}, 0}, {{1.01, 0, 0}, {2.01, 0.2, 0.2}, {20, 2, 2}, 0}},
                       fem::ElementFamily::hypercube),
                 beyond<3>(1.005, dealii::Tensor<1, 3>({-1, 0, 0})),
                 contact(coupling::bodies::BodyContactForm::potential, 0));
  const double before = b.velocity_of(1)[0];
  collide(b, 1200);
  CHECK(b.contact().contacts().touching() == 0);
  CHECK(b.velocity_of(0)[0] == Approx(before).epsilon(0.1));
  CHECK(std::fabs(b.velocity_of(1)[0]) < 0.1 * std::fabs(before));
}

TEST_CASE("body contact: a block slides down at the rate that Coulomb's law leaves, and rests below the friction angle",
          "[coupling][slow]")
{
  constexpr double g = 9.81, mu = 0.4;
  const double     slope = GENERATE(0.2, 0.6); // tangent of the inclination
  CAPTURE(slope);
  const double c = 1 / std::sqrt(1 + slope * slope), s = slope * c;
  // Gravity is inclined instead of the plane. The block hops on its contact a hundred times a second: measured over half a second.
  Bodies<3> b(
    parts<3>({{{0, 0, -0.5}, {4, 2, 0}, {8, 4, 1}, 0}, {{0.63, 0.6, 0}, {1.43, 1.4, 0.5}, {2, 2, 1}, 0}},
             fem::ElementFamily::hypercube),
    [](const dealii::Point<3> &) { return dealii::Tensor<1, 3>(); },
    contact(coupling::bodies::BodyContactForm::potential, mu), 1e8, 0.5, {g * s, 0, -g * c}, true);
  double       from = 0, at = 0, dt = 0;
  const double end = 0.75;
  while (b.motion->time() < end * (1 - 1e-12))
    {
      b.both->advance(end - b.motion->time());
      if (from == 0 && b.motion->time() > 0.15)
        {
          from = b.velocity_of(1)[0];
          at   = b.motion->time();
        }
    }
  dt                = b.motion->time() - at;
  const double rate = (b.velocity_of(1)[0] - from) / dt;
  if (slope > mu)
    CHECK(rate == Approx(g * (s - mu * c)).epsilon(0.03));
  else
    CHECK(std::fabs(b.velocity_of(1)[0]) < 0.02 * g * s * end);
}

TEST_CASE("body contact: a clamp that closes touches itself only where self-contact is on", "[coupling]")
{
  const bool                              self = GENERATE(false, true);
  coupling::bodies::BodyContactParameters law  = contact(coupling::bodies::BodyContactForm::potential, 0);
  law.self_contact                             = self;
  // A U of blocks, whose arms come together; a second body far away, without which there would be no contact at all.
  auto mesh = fem::make_mesh<2>(
    [](dealii::Triangulation<2> &made) {
      std::vector<dealii::Point<2>>    points;
      std::vector<dealii::CellData<2>> cells;
      const auto add_grid = [&](const double x0, const double y0, const unsigned int nx, const unsigned int ny,
                                const auto &keep) {
        std::map<std::pair<unsigned int, unsigned int>, unsigned int> number;
        const auto at = [&](const unsigned int i, const unsigned int j) {
          const auto [found, is_new] = number.emplace(std::pair(i, j), points.size());
          if (is_new)
            points.emplace_back(x0 + 0.1 * i, y0 + 0.1 * j);
          return found->second;
        };
        for (unsigned int j = 0; j < ny; ++j)
          for (unsigned int i = 0; i < nx; ++i)
            if (keep(i, j))
              {
                dealii::CellData<2> cell;
                cell.vertices = {at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)};
                cells.push_back(cell);
              }
      };
      add_grid(0, 0, 10, 7, [](const unsigned int i, const unsigned int j) { return i < 2 || j < 3 || j > 3; });
      add_grid(9, 9, 1, 1, [](unsigned int, unsigned int) { return true; });
      made.create_triangulation(points, cells, dealii::SubCellData());
    },
    fem::ElementFamily::hypercube, MPI_COMM_SELF, fem::Bodies::several);
  Bodies<2> b(
    std::move(mesh),
    [](const dealii::Point<2> &x) {
      dealii::Tensor<1, 2> v;
      if (x[0] < 2 && x[0] > 0.2)
        v[1] = (x[1] > 0.35 ? -1 : 1) * 10 * (x[0] - 0.2);
      return v;
    },
    law);
  double force = 0, overlap = 0;
  for (int n = 0; n < 400; ++n)
    {
      b.both->advance(1.0);
      overlap = std::max(overlap, b.contact().contacts().overlap());
      force   = std::max(force, b.contact().balance().energy.normal);
    }
  CHECK((force > 0) == self);
  CHECK((overlap > 0) == self);
  CHECK(b.contact().balance().momentum.norm() < 1e-9);
}

TEST_CASE("body contact: what cannot be is refused by name", "[coupling]")
{
  const auto still = [](const dealii::Point<3> &) { return dealii::Tensor<1, 3>(); };
  const auto law   = contact(coupling::bodies::BodyContactForm::potential, 0);
  CHECK_THROWS_WITH(
    (Bodies<3>(parts<3>({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, 0}, {{0.9, 0, 0}, {1.9, 1, 1}, {2, 2, 2}, 0}},
                        fem::ElementFamily::hypercube),
               still, law)),
    Catch::Contains("at the start bodies lie in each other with 0.1 m^3. Move them apart"));
  CHECK_THROWS_WITH(
    (Bodies<3>(parts<3>({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, 0}}, fem::ElementFamily::hypercube), still, law)),
    Catch::Contains("there is only one body, and self-contact is off"));
  Bodies<3> b(parts<3>(cubes(), fem::ElementFamily::hypercube), still, law);
  CHECK_THROWS_WITH(b.both->contacts().add({"other", {"steel"}, law}),
                    Catch::Contains("no body is of a material steel. There are: 0, 1"));
  auto soft      = law;
  soft.stiffness = 0;
  CHECK_THROWS_WITH(b.both->contacts().add({"other", {}, soft}), Catch::Contains("stiffness must be positive"));
}

TEST_CASE("body contact: what shares one node only is one body", "[coupling]")
{
  const auto hinged = [](dealii::Triangulation<2> &mesh) { // two squares, corner to corner
    std::vector<dealii::CellData<2>> cells(2);
    cells[0].vertices = {0, 1, 2, 3};
    cells[1].vertices = {3, 4, 5, 6};
    mesh.create_triangulation({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 1}, {1, 2}, {2, 2}}, cells, dealii::SubCellData());
  };
  const auto still = [](const dealii::Point<2> &) { return dealii::Tensor<1, 2>(); };
  CHECK_THROWS_WITH(
    (Bodies<2>(fem::make_mesh<2>(hinged, fem::ElementFamily::hypercube, MPI_COMM_SELF, fem::Bodies::several), still,
               contact(coupling::bodies::BodyContactForm::potential, 0))),
    Catch::Contains("there is only one body"));
}

TEST_CASE("body contact: a body that runs through another stops the run", "[coupling]")
{
  auto law      = contact(coupling::bodies::BodyContactForm::potential, 0);
  law.stiffness = 1; // as good as none
  Bodies<3> b(parts<3>({{{0, 0, 0}, {1, 1, 1}, {6, 6, 6}, 0}, {{1.1, 0.3, 0.3}, {1.7, 0.9, 0.9}, {2, 2, 2}, 0}},
                       fem::ElementFamily::hypercube),
              beyond<3>(1.05, dealii::Tensor<1, 3>({-4, 0, 0})), law);
  CHECK_THROWS_WITH(
    [&] {
      for (int n = 0; n < 2000; ++n)
        b.both->advance(1.0);
    }(),
    Catch::Contains("where 0 and 1 touch, they are deeper in each other than one element. Raise the stiffness"));
}

TEST_CASE("rigid bodies: a free one keeps its shape, momentum, angular momentum and energy while it tumbles",
          "[coupling]")
{
  // About the middle axis of a box, which turns over again and again.
  const Vector3d        spin(0.05, 20, 0.02);
  auto                  law = contact(coupling::bodies::BodyContactForm::potential, 0);
  Bodies<3>             b(parts<3>({{{0, 0, 0}, {0.2, 0.4, 0.8}, {2, 2, 3}, 0}, {{5, 5, 5}, {6, 6, 6}, {1, 1, 1}, 0}},
                       fem::ElementFamily::hypercube),
                          [&](const dealii::Point<3> &x) {
                if (x[0] > 2)
                  return dealii::Tensor<1, 3>();
                const Vector3d v = Vector3d(1, 0, 0) + spin.cross(Vector3d(x[0] - 0.1, x[1] - 0.2, x[2] - 0.4));
                return dealii::Tensor<1, 3>({v[0], v[1], v[2]});
              },
                          law, 1e7, 0.5, {0, 0, 0}, false, {"0"});
  const auto            start  = coupling::momentum_of(*b.participant);
  const double          energy = b.motion->energy().kinetic;
  std::vector<Vector3d> place;
  for (std::size_t i = 0; i < b.participant->carriers(); ++i)
    place.push_back(b.participant->position(i));
  double shape = 0, off_energy = 0, off_turn = 0, tilted = 1;
  for (int n = 0; n < 3000; ++n)
    {
      b.both->advance(1.0);
      for (std::size_t i = 1; i < place.size(); ++i)
        if (b.body_of.at(b.participant->displacements(i)[0]) == 0 &&
            b.body_of.at(b.participant->displacements(0)[0]) == 0)
          shape = std::max(shape, std::fabs((b.participant->position(i) - b.participant->position(0)).norm() -
                                            (place[i] - place[0]).norm()));
      off_energy          = std::max(off_energy, std::fabs(b.motion->energy().kinetic / energy - 1));
      off_turn            = std::max(off_turn, (coupling::momentum_of(*b.participant).angular - start.angular).norm() /
                                                 start.angular.norm());
      const Vector3d axis = (b.participant->position(1) - b.participant->position(0)).normalized();
      tilted              = std::min(tilted, axis.dot((place[1] - place[0]).normalized()));
    }
  CHECK((coupling::momentum_of(*b.participant).linear - start.linear).norm() < 1e-10 * start.linear.norm());
  CHECK(shape < 1e-12);
  CHECK(off_energy < 2e-3);
  CHECK(off_turn < 2e-3); // nodes move along chords, not arcs
  CHECK(tilted < -0.5);   // it has turned over
}

TEST_CASE("rigid bodies: one that hits a deformable body keeps the momentum and the energy of both", "[coupling]")
{
  Bodies<3>  b(parts<3>(cubes(), fem::ElementFamily::hypercube), beyond<3>(1.05, dealii::Tensor<1, 3>({-4, 0.5, -0.8})),
               contact(coupling::bodies::BodyContactForm::potential, 0.3), 1e7, 0.25, {0, 0, 0}, false, {"1"});
  const Seen seen = collide(b, 3000);
  CHECK(seen.momentum < 1e-10);
  CHECK(seen.made < 0.01);
  CHECK(seen.left == Approx(0).margin(0.005));
  CHECK(seen.force > 1e4);
  CHECK_FALSE(seen.touching);
}
