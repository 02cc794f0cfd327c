// A path that goes on in another network than it began in.
#include "clusters.h"
#include "dem/statics/quasi_static_path.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using cluster::concrete;

namespace
{
  constexpr double spacing = 1e-3;

  /** A row of particles, its first held, its last driven. */
  dem::LoadedNetwork row(const std::size_t particles)
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
    dem::drive(loaded, {particles - 1}, 0, 1);
    return loaded;
  }

  dem::QuasiStaticParameters led_to(const double end)
  {
    dem::QuasiStaticParameters p;
    p.strain_step = 1e-8;
    p.end_strain  = end;
    p.end_stress  = 0;
    return p;
  }

  std::vector<std::optional<std::size_t>> the_same(const std::size_t links)
  {
    std::vector<std::optional<std::size_t>> before(links);
    for (std::size_t l = 0; l < links; ++l)
      before[l] = l;
    return before;
  }
} // namespace

TEST_CASE("changed network: a damaged path that goes on in the same network goes on as if nothing had been",
          "[dem][statics][quasi_static]")
{
  const dem::LoadedNetwork         first = row(3), second = row(3);
  const dem::QuasiStaticParameters p = led_to(1e-6);
  dem::QuasiStaticPath whole(first, concrete(), p), before(first, concrete(), p), after(second, concrete(), p);
  for (int i = 0; i < 40; ++i)
    {
      whole.advance();
      before.advance();
    }
  REQUIRE(before.points().back().mean_damage > 0);
  const dem::QuasiStaticPoint &changed =
    after.go_on_from(before, before.motion(), the_same(first.network.links.size()));
  CHECK(changed.control == dem::StepControl::changed);
  CHECK(std::fabs(changed.changed) < 1e-12 * changed.external_work);
  CHECK(changed.damage == before.points().back().damage);
  CHECK(after.points().size() == before.points().size() + 1);
  while (!whole.finished())
    whole.advance();
  while (!after.finished())
    after.advance();
  CHECK(after.points().back().stress[0] == Approx(whole.points().back().stress[0]).epsilon(1e-6));
  CHECK(after.points().back().damage == Approx(whole.points().back().damage).epsilon(1e-4));
  CHECK(after.points().back().balance_error() < 1e-3);
}

TEST_CASE("changed network: the energy of new bonds is reported, and old ones keep their damage",
          "[dem][statics][quasi_static]")
{
  // Three particles between grips; the change adds a fourth one between the last and its grip, so that the row is half as stiff again less.
  const dem::LoadedNetwork         first = row(3), second = row(4);
  const dem::QuasiStaticParameters p = led_to(1e-6);
  dem::QuasiStaticPath             before(first, concrete(), p), after(second, concrete(), p);
  for (int i = 0; i < 5; ++i)
    before.advance();
  const dem::QuasiStaticPoint old = before.points().back();
  REQUIRE(old.mean_damage == 0);
  dem::LoadedMotion start(second.held.size());
  start.loads = before.motion().loads;
  // The old ones stay where they were; the new bond has the last particle's motion to bear alone, before equilibrium.
  start.particles.leftCols(2)               = before.motion().particles.leftCols(2);
  const dem::QuasiStaticPoint &now          = after.go_on_from(before, start, {0, 1, std::nullopt});
  const double                 displacement = now.strain[0];
  // Bonds of E A / L in a row: 2 of them, then 3.
  const double area = M_PI * 0.25 * spacing * spacing, one = concrete().normal_modulus * area / spacing;
  CHECK(old.stored == Approx(0.5 * one / 2 * displacement * displacement).epsilon(1e-9));
  CHECK(now.stored == Approx(0.5 * one / 3 * displacement * displacement).epsilon(1e-9));
  CHECK(now.changed == Approx(now.stored - old.stored).epsilon(1e-9));
  CHECK(now.external_work == old.external_work);
  CHECK(std::fabs(now.energy_residual() - old.energy_residual()) < 1e-9 * old.external_work);
}
