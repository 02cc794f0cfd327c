// Quasi-static paths whose linear systems are solved by iteration: against factors, and by several ranks with the same bits.
#include "base/flat_state.h"
#include "dem/network/turning_grips.h"
#include "iterated_paths.h"
#include "tests/dem/quasi_static_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace quasi_static_fixture;
using namespace iterated_paths;

namespace
{
  const dem::CpmParameters law = concrete();

  dem::Packing spheres(const std::size_t count) { return millimetres(random_spheres(count, 5)); }

  dem::LoadedNetwork cell_of(const std::size_t count)
  {
    return dem::load_cell(network_of(spheres(count), 1.5, law), 0, true);
  }

  dem::LoadedNetwork box_of(const std::size_t count, const bool rough = false)
  {
    dem::Packing packing = spheres(count);
    packing.periodic_cell.reset();
    dem::GripPair grips;
    grips.lateral_blocked = grips.spin_blocked = rough;
    grips.layers                               = cluster_grips(packing, 2, 2.5e-3);
    return dem::load_grips(network_of(packing, 1.5, law), grips);
  }

  /** Grips that hold their particles sideways and turn about their middles. */
  dem::LoadedNetwork turning_box_of(const std::size_t count)
  {
    dem::Packing packing = spheres(count);
    packing.periodic_cell.reset();
    dem::GripPair grips;
    grips.lateral_blocked     = true;
    grips.layers              = cluster_grips(packing, 2, 2.5e-3);
    dem::LoadedNetwork loaded = dem::load_grips(network_of(packing, 1.5, law), grips);
    dem::let_grips_turn(loaded, grips);
    return loaded;
  }

  dem::QuasiStaticParameters pulled(const double end_strain, const dem::SolverMethod method)
  {
    dem::QuasiStaticParameters p = steps(end_strain);
    p.solver                     = method;
    return p;
  }

  /** A few points, in the last of which links are damaged. */
  dem::QuasiStaticParameters shortly_pulled()
  {
    dem::QuasiStaticParameters p = pulled(1.2e-4, dem::SolverMethod::iterative);
    p.strain_step                = 3e-5;
    return p;
  }

  /** Links that have lost more than half of their stiffness, in the order in which they did. */
  struct Breaks
  {
    std::vector<std::size_t> order;
    std::vector<char>        lost;

    void note(const dem::DamagingLinks &links)
    {
      lost.resize(links.size(), 0);
      for (std::size_t i = 0; i < links.size(); ++i)
        if (!lost[i] && links.damage_of(i).stiffness > 0.5)
          {
            lost[i] = 1;
            order.push_back(i);
          }
    }
  };

  struct BrokenCourse
  {
    std::vector<dem::QuasiStaticPoint> points;
    Breaks                             breaks;
  };

  BrokenCourse broken_course_of(const dem::LoadedNetwork &loaded, const dem::QuasiStaticParameters &p)
  {
    dem::QuasiStaticPath path(loaded, law, p);
    BrokenCourse         course;
    while (!path.finished())
      {
        path.advance();
        course.breaks.note(path.links());
      }
    course.points = path.points();
    return course;
  }

  /** Of stresses over the largest: a hundred times what residuals may be, as softening enlarges it. */
  constexpr double enough = 1e-5;

  double difference(const dem::QuasiStaticPoint &a, const dem::QuasiStaticPoint &b)
  {
    return (a.stress - b.stress).norm();
  }

  void same_on_ranks(const dem::LoadedNetwork &loaded, const dem::QuasiStaticParameters &p)
  {
    iterated_paths::same_on_ranks(loaded, law, p, {1, 2, 3, 5}); // three bricks
  }
} // namespace

TEST_CASE("an iterated path of tension has the forces and the breaks of one by factors", "[dem][statics][ranks][slow]")
{
  omp_set_num_threads(1);
  const bool               cell    = GENERATE(false, true);
  const dem::LoadedNetwork loaded  = cell ? cell_of(150) : box_of(300);
  const BrokenCourse       factors = broken_course_of(loaded, pulled(3e-4, dem::SolverMethod::direct));
  const BrokenCourse       course  = broken_course_of(loaded, pulled(3e-4, dem::SolverMethod::iterative));
  REQUIRE(factors.breaks.order.size() > 10);
  CHECK(course.breaks.order == factors.breaks.order);
  REQUIRE(course.points.size() == factors.points.size());
  const double borne = peak(factors.points, loaded.driven);
  for (std::size_t i = 0; i < course.points.size(); ++i)
    {
      INFO("point " << i);
      CHECK(course.points[i].control == factors.points[i].control);
      // Dynamics, where a crack runs away, enlarges what differs before it: the next test compares those from the same start.
      if (course.points[i].control != dem::StepControl::relaxed)
        CHECK(difference(course.points[i], factors.points[i]) < enough * borne);
    }
}

TEST_CASE("an iterated path goes from each point of one by factors to the next one", "[dem][statics][ranks][slow]")
{
  omp_set_num_threads(1);
  const std::string        what   = GENERATE("cell", "box", "box between grips that turn");
  const bool               cell   = what == "cell";
  const dem::LoadedNetwork loaded = cell ? cell_of(150) : what == "box" ? box_of(300) : turning_box_of(300);
  INFO(what);
  dem::QuasiStaticPath factors(loaded, law, pulled(3e-4, dem::SolverMethod::direct)),
    iterated(loaded, law, pulled(3e-4, dem::SolverMethod::iterative));
  std::vector<double> differences;
  std::size_t         relaxed = 0;
  while (!factors.finished())
    {
      INFO("point " << factors.points().size());
      const dem::QuasiStaticPoint &expected = factors.advance(), &found = iterated.advance();
      CHECK(found.control == expected.control);
      relaxed += expected.control == dem::StepControl::relaxed;
      differences.push_back(difference(found, expected));
      go_on_from(iterated, factors);
    }
  CHECK((relaxed > 0) == (what != "box")); // there cracks run away
  CHECK(*std::max_element(differences.begin(), differences.end()) < 1e-6 * peak(factors.points(), loaded.driven));
}

TEST_CASE("an iterated path of a chain with a weak link snaps back along the closed form", "[dem][statics][ranks]")
{
  // As of factors (statics_quasi_static.cc): seven links and a weak one of 0.8 times their section, softening strain 3 eps_0.
  const dem::CpmParameters brittle = concrete(3);
  dem::LoadedNetwork       loaded  = row(9, brittle);
  dem::ElasticLink        &weak    = loaded.network.links[3];
  weak.area *= 0.8;
  weak.stiffness *= 0.8;
  dem::QuasiStaticParameters p = steps(10e-4);
  p.tolerance                  = 1e-10;
  p.growth_step                = 0.05;
  p.end_stress                 = 0.1;
  p.solver                     = dem::SolverMethod::iterative;
  const auto   path            = follow(loaded, brittle, p);
  const double section = loaded.volume / 16e-3, area = M_PI * 1e-6, onset = brittle.limit_elastic_strain;
  double       least = 1; // strain past the peak
  for (const auto &point : path)
    {
      const double stress = point.stress[0] * section / area; // of the seven
      const double kappa  = point.mean_damage > 0 ?
                              onset - 3 * onset * std::log(stress / (0.8 * brittle.normal_modulus * onset)) :
                              stress / (0.8 * brittle.normal_modulus);
      CHECK(point.strain[0] == Approx((kappa + 7 * stress / brittle.normal_modulus) / 8).epsilon(1e-7).margin(1e-12));
      CHECK(point.control != dem::StepControl::relaxed);
      least = point.mean_damage > 0 ? std::min(least, point.strain[0]) : 1.0;
    }
  CHECK(path.back().stress[0] < 0.15 * peak(path));
  CHECK(least == Approx(0.734e-4).epsilon(0.001)); // it has come back from 0.825e-4
}

TEST_CASE("an iterated path on ranks: every point has the bits of one", "[dem][statics][ranks][slow]")
{
  const dem::QuasiStaticParameters p = shortly_pulled();
  SECTION("a specimen between grips that leave its particles free sideways") { same_on_ranks(box_of(600), p); }
  SECTION("between rough grips") { same_on_ranks(box_of(600, true), p); }
  SECTION("between grips that turn") { same_on_ranks(turning_box_of(600), p); }
  SECTION("a cell, all its strains moving") { same_on_ranks(cell_of(600), p); }
}

TEST_CASE("an iterated path goes on after a restart on other ranks with the bits of one without",
          "[dem][statics][ranks][slow][S13]")
{
  const dem::LoadedNetwork         loaded = box_of(600);
  const dem::QuasiStaticParameters p      = shortly_pulled();
  omp_set_num_threads(1);
  const Course alone = course_of(loaded, law, p);
  const auto   stop  = alone.points.size() / 2;
  base::Column half; // MemoryState asserts, which Catch2 cannot in several threads
  rank_threads::run(3, [&](const std::shared_ptr<dem::Ranks> &team) {
    omp_set_num_threads(1);
    dem::QuasiStaticParameters shared = p;
    shared.ranks                      = team.get();
    dem::QuasiStaticPath path(loaded, law, shared);
    while (path.points().size() < stop)
      path.advance();
    if (team->rank() == 0)
      {
        base::FlatStateWriter writer(half);
        path.visit_state(writer);
      }
  });
  for (const std::size_t ranks : {1, 2})
    {
      std::vector<char> same(ranks, 0);
      rank_threads::run(ranks, [&](const std::shared_ptr<dem::Ranks> &team) {
        omp_set_num_threads(1);
        dem::QuasiStaticParameters shared = p;
        shared.ranks                      = team.get();
        dem::QuasiStaticPath  path(loaded, law, shared);
        base::FlatStateReader reader(half);
        path.visit_state(reader);
        while (!path.finished())
          path.advance();
        same[team->rank()] = same_bits({path.points(), path.motion()}, alone);
      });
      CHECK(std::count(same.begin(), same.end(), 1) == static_cast<std::ptrdiff_t>(ranks));
    }
}

TEST_CASE("an iterated path of particles that nothing holds, and of more ranks than bricks",
          "[dem][statics][ranks][slow]")
{
  dem::LoadedNetwork loaded = box_of(300); // two bricks
  const auto         ends   = [](const dem::ElasticLink &l) { return l.first == 150 || l.second == 150; };
  for (std::size_t l = loaded.network.links.size(); l-- > 0;)
    if (ends(loaded.network.links[l]))
      {
        loaded.network.links.erase(loaded.network.links.begin() + static_cast<std::ptrdiff_t>(l));
        loaded.load_slip.erase(loaded.load_slip.begin() + static_cast<std::ptrdiff_t>(l));
      }
  same_on_ranks(loaded, shortly_pulled());
}
