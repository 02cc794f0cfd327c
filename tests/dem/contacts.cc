#include "closed_system.h"
#include "dem/specimen/specimen.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, area = M_PI * r * r, E = 25e9, friction = 0.8;

  /** Two spheres, each in a grip: moved at will. */
  struct HeldPair
  {
    dem::Specimen specimen;
    double        distance;

    explicit HeldPair(const double start, const double first_radius = r, const double second_radius = r)
      : specimen(
          cluster::pair_of_spheres(first_radius, second_radius, start), cluster::bonded(1.5), cluster::concrete())
      , distance(start)
    {
      omp_set_num_threads(1);
      for (std::size_t i = 0; i < 2; ++i)
        {
          dem::Grip grip;
          grip.particles = {i};
          grip.prescribed.fill(true);
          specimen.grips().add(grip);
        }
    }

    /** One step in which the second sphere moves; then forces are those of where it stands after the next call. */
    void move(const Vector3d &by)
    {
      specimen.grips().set_velocity(1, by / specimen.time_step(), Vector3d::Zero());
      specimen.advance(1);
      distance += by.x();
    }

    /** Pull until the link is gone. */
    void tear()
    {
      while (specimen.counts().links > 0)
        move({0.002 * distance, 0, 0});
    }

    /** Move along the axis to a distance, in the given number of steps. */
    void go_to(const double target, const int steps)
    {
      const double by = (target - distance) / steps;
      for (int n = 0; n < steps; ++n)
        move({by, 0, 0});
    }
  };
} // namespace

TEST_CASE("pair whose link has broken touches at the sum of radii, pushes and never pulls", "[dem]")
{
  HeldPair pair(2.4 * r);
  pair.tear();
  CHECK(pair.specimen.counts().broken == 1);
  CHECK(pair.specimen.counts().contacts == 0);

  const double step = 1e-4 * r;
  while (pair.distance - step >= 2 * r)
    {
      pair.move({-step, 0, 0});
      REQUIRE(pair.specimen.counts().contacts == 0);
      REQUIRE(pair.specimen.grips().reaction(0).norm() == 0);
    }
  pair.move({-step, 0, 0});
  REQUIRE(pair.specimen.counts().contacts == 1);
  const double reference = pair.distance; // first overlap: within a step of 2 r
  CHECK(reference < 2 * r);
  CHECK(reference >= 2 * r - step * (1 + 1e-9));

  pair.move(Vector3d::Zero());
  REQUIRE(pair.specimen.counts().contacts == 1);
  for (int n = 0; n < 50; ++n) // in
    {
      pair.move({-step, 0, 0});
      pair.move(Vector3d::Zero()); // forces of this position
      const double force = E * area * (reference - pair.distance) / reference;
      CHECK(pair.specimen.grips().reaction(0).x() == Approx(force).epsilon(1e-9));
      CHECK(pair.specimen.grips().reaction(1).x() == Approx(-force).epsilon(1e-9));
    }
  for (int n = 0; n < 60; ++n) // and out again
    {
      pair.move({+step, 0, 0});
      pair.move(Vector3d::Zero());
      CHECK(pair.specimen.grips().reaction(0).x() >= 0); // pushes or nothing
    }
  CHECK(pair.distance > 2 * r);
  CHECK(pair.specimen.counts().contacts == 0);
  CHECK(pair.specimen.counts().broken == 1);
}

TEST_CASE("contact of unequal spheres has the smaller one's cross-section", "[dem]")
{
  HeldPair pair(1.8 * r, r, 0.5 * r);
  pair.tear();
  pair.go_to(1.5 * r - 1e-9 * r, 200);
  REQUIRE(pair.specimen.counts().contacts == 1);
  const double reference = pair.distance, by = 1e-3 * r;
  pair.move({-by, 0, 0});
  pair.move(Vector3d::Zero());
  CHECK(pair.specimen.grips().reaction(0).x() == Approx(E * 0.25 * area * by / reference).epsilon(1e-5));
}

TEST_CASE("contact slides at friction times its compression, without cohesion", "[dem]")
{
  HeldPair pair(2.4 * r);
  pair.tear();
  pair.go_to(2 * r, 400);
  pair.go_to(1.999 * r, 10);
  REQUIRE(pair.specimen.counts().contacts == 1);
  const double shear_stiffness = 0.2 * E * area / (2 * r), increment = 1e-6 * r;
  pair.move({0, increment, 0});
  pair.move(Vector3d::Zero());
  CHECK(pair.specimen.links().shear_force.front() == Approx(shear_stiffness * increment).epsilon(1e-3)); // sticks
  for (int n = 0; n < 100; ++n)
    pair.move({0, 60 * increment, 0});
  pair.move(Vector3d::Zero());
  const auto links = pair.specimen.links();
  REQUIRE(links.kind.front() == dem::LinkOutput::contact);
  CHECK(links.normal_force.front() < 0);
  CHECK(links.shear_force.front() == Approx(-friction * links.normal_force.front()).epsilon(1e-12));
  CHECK(pair.specimen.energy().friction > 0);
  CHECK(links.damage.front() == 1);
}

TEST_CASE("pair still overlapping when its link breaks touches at once, at its present distance", "[dem]")
{
  HeldPair pair(1.8 * r); // overlapping from the start, as in a compacted packing
  pair.tear();
  const double torn = pair.distance;
  REQUIRE(torn < 2 * r);
  CHECK(pair.specimen.counts().contacts == 1);
  pair.move({-1e-3 * r, 0, 0});
  pair.move(Vector3d::Zero());
  CHECK(pair.specimen.grips().reaction(0).x() ==
        Approx(E * area * 1e-3 * r / torn).epsilon(1e-2)); // from where it was torn
}

TEST_CASE("contacts of colliding fragments are found in the step of their first overlap, searching rarely", "[dem]")
{
  omp_set_num_threads(1);
  dem::Specimen specimen(cluster::colliding_clusters(50), cluster::bonded(1.3), cluster::concrete());
  cluster::set_colliding_velocities(specimen, 10);
  using Pair = std::pair<std::size_t, std::size_t>;
  std::set<Pair> ever;
  int            missed = 0;
  const int      steps  = 3000;
  for (int n = 0; n < steps; ++n)
    {
      specimen.advance(1);
      const auto     body  = specimen.particles();
      const auto     links = specimen.links();
      std::set<Pair> joined;
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        if (links.kind[l] != dem::LinkOutput::broken)
          {
            const Pair pair = std::minmax(links.ends[l][0], links.ends[l][1]);
            joined.insert(pair);
            if (links.kind[l] == dem::LinkOutput::contact)
              ever.insert(pair);
          }
      for (std::size_t i = 0; i < body.position.size(); ++i)
        for (std::size_t j = i + 1; j < body.position.size(); ++j)
          {
            const double gap = (body.position[j] - body.position[i]).norm() - body.radius[i] - body.radius[j];
            missed += gap < -1e-15 && joined.count({i, j}) == 0; // round-off of 5e-3 m
          }
    }
  CHECK(missed == 0);
  CHECK(ever.size() > 30); // pairs that have met
  CHECK(specimen.counts().neighbour_searches > 0);
  CHECK(specimen.counts().neighbour_searches < steps / 20);
}

TEST_CASE("specimen that has hardly moved never searches for neighbours", "[dem]")
{
  omp_set_num_threads(1);
  dem::Specimen      specimen(cluster::cubic_lattice(4, 4, 4, r), cluster::bonded(1.5), cluster::concrete());
  dem::UniformRandom random(4);
  for (std::size_t i = 0; i < specimen.counts().particles; ++i)
    specimen.set_velocity(i, 0.5 * cluster::random_vector(random), Vector3d::Zero());
  specimen.advance(
    2000); // 0.5 m/s for 3e-4 s is 1.5e-4 m at most, and pairs without a link are 2 r (1.5 - 1) = 1e-3 m apart
  CHECK(specimen.counts().neighbour_searches == 0);
  CHECK(specimen.time() < 8e-4);
}

TEST_CASE("no contact is made where the scene has none", "[dem]")
{
  auto p             = cluster::bonded(1.3);
  p.physics.contacts = false;
  dem::Specimen specimen(cluster::colliding_clusters(30), p, cluster::concrete());
  cluster::set_colliding_velocities(specimen, 20);
  specimen.advance(2000);
  CHECK(specimen.counts().broken > 0);
  CHECK(specimen.counts().contacts == 0);
  CHECK(specimen.counts().neighbour_searches == 0);
}
