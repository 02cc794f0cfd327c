// Weight that is put on before something is driven, and stays.
#include "base/errors.h"
#include "clusters.h"
#include "dem/network/loaded_hinges.h"
#include "dem/statics/quasi_static_path.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using cluster::concrete;
using Eigen::Vector3d;

namespace
{
  constexpr double spacing = 1e-3;

  /** A row of particles that hangs from its first one, each of a weight of its own along it; the last one is driven, if at all. */
  dem::LoadedNetwork hanging_row(const std::size_t particles, const double newtons, const bool driven)
  {
    dem::Packing packing;
    for (std::size_t i = 0; i < particles; ++i)
      {
        packing.centre.emplace_back(static_cast<double>(i) * spacing, 0, 0);
        packing.radius.push_back(0.5 * spacing);
      }
    dem::NetworkParameters p;
    p.interaction_ratio       = 1.2;
    p.rotations               = false;
    dem::LoadedNetwork loaded = dem::unloaded(dem::make_network(packing, p, concrete()));
    for (const int across : {1, 2})
      {
        std::vector<std::size_t> all(particles);
        std::iota(all.begin(), all.end(), 0u);
        dem::drive(loaded, all, across, 0);
      }
    dem::drive(loaded, {0}, 0, 0);
    if (driven)
      dem::drive(loaded, {particles - 1}, 0, 1);
    std::vector<Vector3d> weight;
    for (std::size_t i = 0; i < particles; ++i)
      weight.emplace_back(newtons * static_cast<double>(i + 1), 0, 0);
    dem::weigh_down(loaded, weight);
    return loaded;
  }

  double stiffness() { return concrete().normal_modulus * M_PI * std::pow(0.5 * spacing, 2) / spacing; }

  dem::QuasiStaticParameters at_once()
  {
    dem::QuasiStaticParameters p;
    p.strain_step = p.end_strain = 1;
    p.end_stress                 = 0;
    p.tolerance                  = 1e-11;
    return p;
  }

  dem::QuasiStaticParameters led_to(const double end)
  {
    dem::QuasiStaticParameters p;
    p.strain_step = 1e-8;
    p.end_strain  = end;
    p.end_stress  = 0;
    p.tolerance   = 1e-11;
    return p;
  }
} // namespace

TEST_CASE("dead load: each link of a hanging row bears what hangs below it, and what its weight has done is stored",
          "[dem][statics][quasi_static]")
{
  const std::size_t        n      = 6;
  const double             weight = 1e-3;
  const dem::LoadedNetwork loaded = dem::with_load_put_on(hanging_row(n, weight, false), false);
  dem::QuasiStaticPath     path(loaded, concrete(), at_once());
  path.advance();
  REQUIRE(path.finished());
  REQUIRE(path.points().size() == 2); // nothing is damaged: all at once
  double moved = 0;
  for (std::size_t l = 0; l + 1 < n; ++l)
    {
      double below = 0;
      for (std::size_t i = l + 1; i < n; ++i)
        below += weight * static_cast<double>(i + 1);
      CHECK(path.links().forces()[l].x() == Approx(below).epsilon(1e-9));
      moved += below / stiffness();
      CHECK(path.motion().particles(0, static_cast<Eigen::Index>(l + 1)) == Approx(moved).epsilon(1e-9));
    }
  const dem::QuasiStaticPoint &on = path.points().back();
  CHECK(on.external_work == Approx(-0.5 * on.stress[1]).epsilon(1e-12)); // half of force times way
  CHECK(on.stored == Approx(on.external_work).epsilon(1e-9));
}

TEST_CASE("dead load: what is driven afterwards bears nothing at first, and then what it would without a weight",
          "[dem][statics][quasi_static]")
{
  const std::size_t        n      = 4;
  const dem::LoadedNetwork loaded = hanging_row(n, 1e-3, true), put_on = dem::with_load_put_on(loaded, true);
  dem::QuasiStaticPath     weight(put_on, concrete(), at_once()), path(loaded, concrete(), led_to(4e-6));
  while (!weight.finished())
    weight.advance();
  CHECK(std::fabs(weight.points().back().stress[0]) < 1e-9 * 1e-3);
  CHECK(weight.points().back().strain[0] > 0);
  path.go_on_where(weight);
  CHECK(path.driven_since_start() == 0);
  CHECK_FALSE(path.finished());
  const double stiff = stiffness() / static_cast<double>(n - 1);
  for (int i = 0; i < 5; ++i)
    {
      const dem::QuasiStaticPoint &point = path.advance();
      CHECK(point.stress[0] == Approx(stiff * path.driven_since_start()).epsilon(1e-9));
      CHECK(std::fabs(point.energy_residual()) <= 1e-9 * point.external_work);
    }
  // With a crack, too; the uppermost bond bears most of the weight, and is the one that goes.
  while (!path.finished())
    path.advance();
  CHECK(path.points().back().damage > 0);
  CHECK(path.points().back().balance_error() < 1e-3);
  CHECK(path.links().damage_of(0).stiffness > 0);
  CHECK(path.links().damage_of(1).stiffness == 0);
}

TEST_CASE("dead load: a row that its weight breaks goes back along the part of the weight that it bears",
          "[dem][statics][quasi_static]")
{
  // Twice what the first link can bear.
  const double             strength = stiffness() * spacing * concrete().limit_elastic_strain;
  const dem::LoadedNetwork loaded   = dem::with_load_put_on(hanging_row(3, 2 * strength / 5, false), false);
  dem::QuasiStaticPath     path(loaded, concrete(), at_once());
  double                   most = 0;
  bool                     fell = false;
  for (int i = 0; i < 12 && !fell; ++i)
    {
      const double part = path.advance().strain[1];
      fell              = part < most;
      most              = std::max(most, part);
    }
  CHECK(fell);
  CHECK(most == Approx(0.5).epsilon(0.03)); // growth of the damaging strain by up to a fifth at once
}

TEST_CASE("dead load: it is taken off particles that would swing under it, and off those without a link",
          "[dem][statics][quasi_static]")
{
  // The first is held, the second hangs on it, the third on nothing.
  dem::Packing packing;
  for (const double x : {0.0, 1.0, 5.0})
    {
      packing.centre.emplace_back(x * spacing, 0, 0);
      packing.radius.push_back(0.5 * spacing);
    }
  dem::NetworkParameters p;
  p.interaction_ratio       = 1.2;
  dem::LoadedNetwork loaded = dem::unloaded(dem::make_network(packing, p, concrete()));
  for (int motion = 0; motion < dem::motions; ++motion)
    dem::drive(loaded, {0}, motion, 0);
  const auto unloaded_under = [&loaded](const Vector3d &weight) {
    dem::weigh_down(loaded, std::vector<Vector3d>(3, weight));
    std::vector<std::int32_t> found;
    for (const dem::Mechanism &hinge : dem::unload_hinges(loaded))
      found.push_back(hinge.particles.front());
    return found;
  };
  CHECK(unloaded_under({1, 0, 0}) == std::vector<std::int32_t>{2}); // the link pulls
  CHECK(loaded.dead->force.topRows(3).rowwise().sum().isApprox(Vector3d(2, 0, 0)));
  CHECK(unloaded_under({0, 1, 0}) == std::vector<std::int32_t>{1, 2}); // about the link's middle
  CHECK(loaded.dead->force.topRows(3).rowwise().sum().isApprox(Vector3d(0, 1, 0)));
}

TEST_CASE("led opening: a chain that snaps back opens in equal steps, and follows its closed form",
          "[dem][statics][quasi_static]")
{
  // Particles of a chain of twelve, of which the fifth link has 0.8 of the section of the others.
  const std::size_t  n = 12, weak = 4;
  dem::LoadedNetwork loaded = hanging_row(n, 0, true);
  loaded.network.links[weak].area *= 0.8;
  loaded.network.links[weak].stiffness *= 0.8;
  dem::CpmParameters law            = concrete();
  law.relative_ductility            = 3;
  const double               area   = M_PI * std::pow(0.5 * spacing, 2);
  const double               onset  = law.limit_elastic_strain * spacing;
  dem::QuasiStaticParameters by_way = led_to(1e-4), by_opening = by_way;
  by_way.end_strain = 0.7 * onset * static_cast<double>(n - 1);
  by_opening.leading.emplace();
  by_opening.leading->group = {weak + 1};
  by_opening.leading->other = {weak};
  by_opening.leading->step  = 0.2 * onset;
  by_opening.leading->end   = 10 * onset;
  by_opening.strain_step    = 0.1 * onset * static_cast<double>(n);
  dem::QuasiStaticPath led(loaded, law, by_opening), driven(loaded, law, by_way);
  double               highest = 0;
  bool                 back    = false;
  while (!led.finished())
    {
      const dem::QuasiStaticPoint &point = led.advance();
      const double                 open  = by_opening.leading->of(loaded, led.motion());
      CHECK(point.control == dem::StepControl::leading);
      CHECK(open == Approx(0.2 * onset * static_cast<double>(led.points().size() - 1)).epsilon(1e-9));
      const double e = open / spacing, e0 = law.limit_elastic_strain;
      const double force =
        0.8 * area * law.normal_modulus * (e <= e0 ? e : e0 * std::exp(-(e - e0) / (law.relative_ductility * e0)));
      CHECK(point.stress[0] == Approx(force).epsilon(1e-6));
      CHECK(point.strain[0] == Approx(open + static_cast<double>(n - 2) * force / stiffness()).epsilon(1e-6));
      back    = back || point.strain[0] < highest;
      highest = std::max(highest, point.strain[0]);
    }
  CHECK(led.points().size() == 51);
  CHECK(back);
  while (!driven.finished())
    driven.advance();
  const dem::QuasiStaticPoint &before_peak = driven.points().back(), &first = led.points()[1];
  CHECK(before_peak.stress[0] / before_peak.strain[0] == Approx(first.stress[0] / first.strain[0]).epsilon(1e-6));
}
