// Particles and solids as participants of preCICE, against a double of its interface that holds them to its rules.
#include "base/errors.h"
#include "coupling/participants/particle_participant.h"
#include "coupling/participants/solid_participant.h"
#include "coupling/precice/exchange.h"
#include "tests/coupling/precice_double.h"
#include "tests/dem/clusters.h"
#include "tests/fem/solid_fixture.h"

#include <catch2/catch.hpp>

using coupling::PreciceExchange;
using coupling::PreciceMesh;
using Eigen::Vector3d;
using namespace precice_double;

namespace
{
  PreciceExchange couple(coupling::Participant &body, const PreciceMesh &mesh, Course &course)
  {
    return {body, mesh, [&course] { return std::make_unique<Double>(course); }};
  }

  void to_the_end(PreciceExchange &exchange)
  {
    while (!exchange.is_over())
      exchange.advance();
  }

  /** Forces are read, motion is written. */
  PreciceMesh pushed(const std::vector<std::size_t> &carriers)
  {
    return {"Mesh", carriers, {"Force", "", ""}, {"", "Displacement", "Velocity"}};
  }

  /** A block of linked particles that nothing holds. */
  struct WholeBlock
  {
    WholeBlock()
      : specimen(cluster::cubic_lattice(3, 2, 2, 1e-3), cluster::elastic(cluster::bonded(1.5)), cluster::concrete())
      , side(specimen)
    {
    }
    dem::Specimen                 specimen;
    coupling::ParticleParticipant side;
  };

  constexpr double young = 200e9, density = 7850, length = 0.5, side_of_rod = 0.02; // [Pa, kg/m^3, m]

  /** A rod of steel along x that nothing holds, without lateral strain by inertia: waves run at sqrt(E / rho). */
  struct Rod
  {
    Rod()
      : solid(fem::make_mesh<3>(
                box<3>({length, side_of_rod, side_of_rod}, {100, 1, 1}), fem::ElementFamily::hypercube, MPI_COMM_SELF),
              {})
    {
      solid.assign("0", fem::make_points(elastic(young, 0), fem::Plane::strain));
      fem::Loads<3> loads;
      loads.may_move_freely = true;
      solid.set_loads(loads);
      fem::ExplicitOptions options;
      options.density = {{"0", density}};
      motion          = std::make_unique<fem::ExplicitSolver<3>>(solid, options);
      side            = std::make_unique<coupling::SolidParticipant<3>>(solid, *motion);
      for (std::size_t i = 0; i < side->carriers(); ++i)
        if (side->place(i).x() > length * (1 - 1e-9))
          end.push_back(i);
    }

    fem::Solid<3>                                  solid;
    std::unique_ptr<fem::ExplicitSolver<3>>        motion;
    std::unique_ptr<coupling::SolidParticipant<3>> side;
    std::vector<std::size_t>                       end; ///< nodes of the face x = length
  };

  /** Two linked particles at 0.3 m/s along x, each on a spring of another code: half a period, in which they keep their distance. */
  struct Swing
  {
    Swing(const int windows_in_a_period, const int iterations)
      : specimen(cluster::cubic_lattice(2, 1, 1, 1e-3), cluster::elastic(cluster::bonded(1.5)), cluster::concrete())
      , side(specimen)
    {
      const double longest = side.stable_step();
      period               = 100 * longest;
      const double omega = 2 * M_PI / period, stiffness = side.mass(0) * omega * omega;
      for (const std::size_t particle : {0, 1})
        side.apply_impulse(particle, {0.3, 0, 0});
      course.answer = [stiffness](const Values &data, double) {
        std::vector<double> forces = data.at("Displacement");
        for (double &force : forces)
          force *= -stiffness;
        return Values{{"Force", forces}};
      };
      course.readable          = {{"Force", std::vector<double>(6, 0.0)}};
      course.window            = period / windows_in_a_period;
      course.end               = 0.5 * period;
      course.iterations        = iterations;
      PreciceExchange exchange = couple(side, pushed({0, 1}), course);
      to_the_end(exchange);
      CHECK(exchange.windows() == windows_in_a_period / 2);
      CHECK(exchange.iterations() == iterations * exchange.windows());
      for (std::size_t k = 0; k < course.windows.size(); ++k)
        {
          const double time  = course.window * static_cast<double>(k + 1);
          const double found = at(course.windows[k].written.at("Displacement"), 0).x();
          error              = std::max(error, std::fabs(found - 0.3 / omega * std::sin(omega * time)) * omega / 0.3);
        }
    }

    dem::Specimen                 specimen;
    coupling::ParticleParticipant side;
    Course                        course;
    double                        period = 0, error = 0;
  };
} // namespace

TEST_CASE("particles on springs of another code swing as in closed form, to second order", "[coupling]")
{
  const Swing coarse(400, 1), fine(800, 1);
  CHECK(fine.error < 1e-4);
  CHECK(coarse.error / fine.error == Approx(4).margin(0.1)); // a step a window: central differences
  CHECK(fine.course.finalized);
}

TEST_CASE("impulse that was read from preCICE is the momentum a body has gained", "[coupling]")
{
  const auto gained = [](coupling::Participant &body, const std::vector<std::size_t> &carriers) {
    Course course;
    course.window  = 7.3 * body.stable_step();
    course.end     = 10 * course.window;
    Vector3d given = Vector3d::Zero();
    int      count = 0;
    course.answer  = [&](const Values &, double) {
      std::vector<double> forces;
      for (std::size_t k = 0; k < carriers.size(); ++k)
        forces.insert(forces.end(), {std::sin(1.0 + count), 0.5 * static_cast<double>(k), std::cos(2.0 * count)});
      ++count;
      return Values{{"Force", forces}};
    };
    course.readable          = course.answer({}, 0);
    PreciceExchange exchange = couple(body, pushed(carriers), course);
    to_the_end(exchange);
    Vector3d momentum = Vector3d::Zero();
    for (std::size_t i = 0; i < body.carriers(); ++i)
      momentum += body.mass(i) * body.velocity(i);
    for (const Window &window : course.windows)
      for (std::size_t k = 0; k < carriers.size(); ++k)
        given += course.window * at(window.read.at("Force"), k);
    return (momentum - given).norm() / given.norm();
  };
  WholeBlock block;
  Rod        rod;
  // Velocities are half a step behind: the first step is pushed for half its length.
  CHECK(gained(block.side, {0, 4, 7}) < 0.02);
  CHECK(gained(*rod.side, rod.end) < 0.02);
}

TEST_CASE("windows that an implicit coupling takes back leave no trace, to the last bit", "[coupling]")
{
  const auto with = [](coupling::Participant &body, const std::vector<std::size_t> &carriers, const int iterations,
                       const std::vector<Values> *forces) {
    Course course;
    course.window     = 4.6 * body.stable_step();
    course.end        = 8 * course.window;
    course.iterations = iterations;
    std::size_t next  = 0;
    course.answer     = [&, forces](const Values &written, double) {
      if (forces)
        return (*forces)[std::min(++next, forces->size() - 1)];
      std::vector<double> back = written.at("Displacement");
      for (double &value : back)
        value = 1 - 1e5 * value;
      return Values{{"Force", back}};
    };
    course.readable = forces ? forces->front() : Values{{"Force", std::vector<double>(3 * carriers.size(), 1.0)}};
    PreciceExchange exchange = couple(body, pushed(carriers), course);
    to_the_end(exchange);
    return course.windows;
  };
  const auto check = [&](const auto &make, const auto &body_of, const std::vector<std::size_t> &carriers) {
    const auto                implicit = make();
    const std::vector<Window> kept     = with(body_of(*implicit), carriers, 4, nullptr);
    std::vector<Values>       forces;
    for (const Window &window : kept)
      forces.push_back(window.read);
    const auto                plain = make(); // the same forces, without any iteration
    const std::vector<Window> once  = with(body_of(*plain), carriers, 1, &forces);
    REQUIRE(once.size() == kept.size());
    for (std::size_t k = 0; k < once.size(); ++k)
      CHECK(once[k].written == kept[k].written);
    CHECK(kept.front().written != kept.back().written);
  };
  check([] { return std::make_unique<WholeBlock>(); }, [](WholeBlock &b) -> coupling::Participant & { return b.side; },
        {0, 5});
  check([] { return std::make_unique<Rod>(); }, [](Rod &r) -> coupling::Participant & { return *r.side; }, {0, 5});
}

TEST_CASE("end of a rod that another code leads takes rho c v A", "[coupling]")
{
  const double speed = std::sqrt(young / density), lead = 2.0;
  for (const bool by_velocity : {true, false})
    {
      Rod    rod;
      Course course;
      course.window     = 2e-6;
      course.end        = 60e-6; // the wave has not yet come to the other end
      const auto motion = [&](const double time) {
        std::vector<double> values;
        for (std::size_t k = 0; k < rod.end.size(); ++k)
          values.insert(values.end(), {by_velocity ? lead : lead * time, 0, 0});
        return Values{{"Motion", values}};
      };
      course.answer   = [&](const Values &, const double time) { return motion(time + course.window); };
      course.readable = motion(course.window);
      course.initial  = true;
      PreciceMesh mesh{"Mesh", rod.end, {}, {"Force", "", ""}};
      (by_velocity ? mesh.reads.velocity : mesh.reads.displacement) = "Motion";
      PreciceExchange exchange                                      = couple(*rod.side, mesh, course);
      to_the_end(exchange);
      double mean = 0;
      for (std::size_t w = 10; w < course.windows.size(); ++w)
        for (std::size_t k = 0; k < rod.end.size(); ++k)
          mean += at(course.windows[w].written.at("Force"), k).x() / static_cast<double>(course.windows.size() - 10);
      CHECK(mean == Approx(-density * speed * lead * side_of_rod * side_of_rod).epsilon(0.01));
      CHECK(rod.side->position(rod.end.front()).x() - length == Approx(lead * course.end).epsilon(1e-9));
      CHECK(at(course.first.at("Force"), 0) == Vector3d::Zero());
      CHECK(at(course.places, 0) == rod.side->place(rod.end.front()));
    }
}

TEST_CASE("mesh of two dimensions exchanges x and y alone", "[coupling]")
{
  WholeBlock block;
  Course     course;
  course.dimensions        = 2;
  course.window            = block.side.stable_step();
  course.end               = 3 * course.window;
  course.answer            = [](const Values &, double) { return Values{{"Force", {1, 2, 3, 4}}}; };
  course.readable          = {{"Force", {1, 2, 3, 4}}};
  PreciceExchange exchange = couple(block.side, pushed({1, 2}), course);
  to_the_end(exchange);
  const Vector3d second = block.side.velocity(2);
  CHECK(course.places.size() == 4);
  CHECK(course.windows.back().written.at("Velocity") ==
        std::vector<double>{block.side.velocity(1).x(), block.side.velocity(1).y(), second.x(), second.y()});
  CHECK(second.x() > 0);
}

TEST_CASE("data that cannot be exchanged are refused by the name of the mesh", "[coupling]")
{
  WholeBlock block;
  Course     course;
  const auto refused = [&](const PreciceMesh &mesh) {
    try
      {
        couple(block.side, mesh, course);
      }
    catch (const base::InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  CHECK(refused(pushed({})) == "preCICE: mesh Mesh has no vertices.");
  CHECK_THAT(refused({"Mesh", {0}, {}, {"F", "", ""}}), Catch::Contains("reads nothing"));
  CHECK_THAT(refused({"Mesh", {0}, {"F", "", ""}, {"G", "", ""}}), Catch::Contains("reads force: then"));
  CHECK_THAT(refused({"Mesh", {0}, {"F", "U", ""}, {}}), Catch::Contains("reads force: then"));
  CHECK_THAT(refused({"Mesh", {0}, {"", "U", "V"}, {}}), Catch::Contains("One of them leads"));
  CHECK_THAT(refused({"Mesh", {0}, {"", "U", ""}, {"", "", "V"}}), Catch::Contains("reads motion: then"));
  CHECK(refused(pushed({0})).empty());
}
