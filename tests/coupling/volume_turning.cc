// Particles inside a solid that turns as far as it likes, and what every method keeps of every motion.
#include "tests/coupling/volume_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace volume;

namespace
{
  /** Of what a motion of a free bar keeps, the largest changes over its course. */
  struct Kept
  {
    double momentum = 0, turning = 0; ///< over the sum of their parts' sizes
    double energy  = 0;               ///< over that of the start
    double kinetic = 0;               ///< at the end, over that of the start
  };

  template <int dim>
  struct Motion
  {
    std::string                               name;
    std::function<Vector3d(const Vector3d &)> velocity;
    Vector3d                                  spin = Vector3d::Zero();
    double                                    time = 0; ///< that it is followed for [s]
  };

  template <int dim>
  double kinetic(const Bar<dim> &bar)
  {
    return coupling::ParticleParticipant(const_cast<dem::Specimen &>(bar.particles)).energy().kinetic +
           bar.participant->energy().kinetic;
  }

  template <int dim>
  Kept keeps(const coupling::VolumeCouplingParameters &method, const Motion<dim> &what, const double step_factor)
  {
    BarOptions<dim> options;
    options.step_factor = step_factor;
    options.turns       = true;
    options.velocity    = what.velocity;
    options.spin        = what.spin;
    Bar<dim> bar(method, options);
    bar.advance(1); // constrained particles start at rest, and take their velocities from the solid
    double size = 0, turn = 0;
    for (std::size_t i = 0; i < bar.particles.counts().particles; ++i)
      {
        const dem::ParticleState p = bar.particles.particle(i);
        size += p.mass * p.velocity.norm() + p.inertia * p.spin.norm() / spacing;
        turn += p.position.norm() * p.mass * p.velocity.norm() + p.inertia * p.spin.norm();
      }
    for (std::size_t i = 0; i < bar.participant->carriers(); ++i)
      {
        size += bar.participant->mass(i) * bar.participant->velocity(i).norm();
        turn += bar.participant->mass(i) * bar.participant->velocity(i).norm() * bar.participant->position(i).norm();
      }
    const Vector3d momentum = bar.momentum(), turning = bar.angular_momentum();
    const auto     whole = [&] {
      return bar.energy() + bar.coupled->balance().absorbed - bar.coupled->balance().spurious();
    };
    const double energy = whole(), moving = kinetic(bar);
    Kept         kept;
    while (bar.particles.time() < what.time)
      {
        bar.advance(1);
        kept.momentum = std::max(kept.momentum, (bar.momentum() - momentum).norm() / size);
        kept.turning  = std::max(kept.turning, (bar.angular_momentum() - turning).norm() / turn);
        kept.energy   = std::max(kept.energy, std::fabs(whole() - energy) / energy);
      }
    kept.kinetic = kinetic(bar) / moving;
    return kept;
  }

  constexpr double turns_per_second = 100;

  template <int dim>
  Motion<dim> rotation(const double turns)
  {
    const Vector3d spin =
      2 * M_PI * turns_per_second * Vector3d(dim == 3 ? 0.3 : 0.0, dim == 3 ? -0.8 : 0.0, 1.0).normalized();
    const Vector3d middle(0.13, 0.02, dim == 3 ? 0.02 : 0.0);
    return {"rotation", [=](const Vector3d &x) -> Vector3d { return spin.cross(x - middle); }, spin,
            turns / turns_per_second};
  }

  template <int dim>
  void check_that_it_turns()
  {
    for (const auto &[name, method] : methods())
      {
        const Kept kept = keeps<dim>(method, rotation<dim>(0.25), 0.5);
        INFO(name << " in " << dim << " dimensions: angular momentum " << kept.turning << ", energy " << kept.energy
                  << ", kinetic " << kept.kinetic);
        CHECK(kept.momentum < 1e-12);
        CHECK(kept.turning < 1e-12);
        CHECK(kept.energy < 1e-4);
        CHECK(kept.kinetic == Approx(1).epsilon(0.01)); // the rest strains it
      }
  }
} // namespace

TEST_CASE("volume coupling: a bar that turns freely goes on to turn as fast, with all of its energy, by every method",
          "[coupling][volume][slow]")
{
  check_that_it_turns<2>();
  check_that_it_turns<3>();
}

namespace
{
  /** Of everything a free bar can do: how it begins. */
  std::vector<Motion<2>> all_motions()
  {
    constexpr double time = 2e-4; // waves run through all of the bar and come back
    const auto       rest = [](const Vector3d &) { return Vector3d(0, 0, 0); };
    return {
      {"translation", [](const Vector3d &) { return Vector3d(3, -1, 0); }, Vector3d::Zero(), time},
      rotation<2>(time * turns_per_second),
      {"spin", rest, Vector3d(0, 0, 100), time},
      {"pulse",
       [](const Vector3d &x) -> Vector3d {
         const double away = (x.x() - 0.05) / 0.02;
         return Vector3d(0.1, 0.03, 0) * std::exp(-away * away);
       },
       Vector3d::Zero(), time},
      {"impact", [](const Vector3d &x) { return Vector3d(x.x() < spacing ? 1 : 0, 0, 0); }, Vector3d::Zero(), time}};
  }
} // namespace

TEST_CASE(
  "volume coupling: every method keeps the momenta of every motion, and its energy the better the smaller the step",
  "[coupling][volume][slow]")
{
  for (const Motion<2> &motion : all_motions())
    for (const auto &[name, method] : methods())
      {
        const Kept coarse = keeps<2>(method, motion, 0.4), fine = keeps<2>(method, motion, 0.2);
        INFO(motion.name << ", " << name << ": momentum " << coarse.momentum << ", angular momentum " << coarse.turning
                         << ", energy " << coarse.energy << ", at half the step " << fine.energy);
        CHECK(coarse.momentum < 1e-12);
        CHECK(coarse.turning < 1e-12);
        CHECK(fine.energy < std::max(0.6 * coarse.energy, 1e-9));
      }
}

TEST_CASE("volume coupling: what bonds bear in elements is the slope of an energy that a turn does not change",
          "[coupling][volume]")
{
  coupling::BondEnd end;
  end.from = Vector3d(0.1, 0.2, -0.1);
  end.to   = Vector3d(0.4, 0.5, 0.3);
  end.arm  = 0.21;
  Eigen::Matrix3d some;
  some << 3, 1, -0.5, 1, 2, 0.3, -0.5, 0.3, 4;
  end.stiffness = some;
  end.turning   = 0.1 * some + 0.2 * Eigen::Matrix3d::Identity();
  // A cube of eight nodes, trilinear.
  struct Entry
  {
    std::size_t row, node;
    double      weight;
    Vector3d    gradient;
  };
  std::vector<Entry> entries;
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t node = 0; node < 8; ++node)
      {
        const Vector3d x     = row == 0 ? end.from : end.to, at(node & 1, (node >> 1) & 1, (node >> 2) & 1);
        const auto     one   = [&](const int d) { return at[d] > 0 ? x[d] : 1 - x[d]; };
        const auto     slope = [&](const int d) { return at[d] > 0 ? 1.0 : -1.0; };
        entries.push_back(
          {row, node, one(0) * one(1) * one(2),
           Vector3d(slope(0) * one(1) * one(2), one(0) * slope(1) * one(2), one(0) * one(1) * slope(2))});
      }
  coupling::CarrierRows nodes(8, 3);
  for (int k = 0; k < 8; ++k)
    nodes.row(k) << (k & 1) + 0.1 * std::sin(3 * k), ((k >> 1) & 1) + 0.08 * std::cos(5 * k + 1),
      ((k >> 2) & 1) + 0.06 * std::sin(7 * k + 2);
  const auto energy = [&](const coupling::CarrierRows &at) {
    const coupling::PlacesNow now = coupling::places_now(entries, 2, at, 3);
    return coupling::pulls_of(end, {now.place[0], now.place[1], now.turn[0].rotation, now.turn[1].rotation}).energy;
  };
  const Eigen::Matrix3d       turn   = Eigen::AngleAxisd(2.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const coupling::CarrierRows turned = nodes * turn.transpose();
  CHECK(energy(turned) == Approx(energy(nodes)).epsilon(1e-12));
  const coupling::CarrierRows slopes = coupling::slopes_of({end}, entries, turned, 3);
  Vector3d                    moment = Vector3d::Zero();
  for (int k = 0; k < 8; ++k)
    {
      moment += Vector3d(turned.row(k)).cross(Vector3d(slopes.row(k)));
      for (int c = 0; c < 3; ++c)
        {
          constexpr double      by   = 1e-6;
          coupling::CarrierRows more = turned, less = turned;
          more(k, c) += by;
          less(k, c) -= by;
          CHECK(slopes(k, c) == Approx((energy(more) - energy(less)) / (2 * by)).margin(1e-8));
        }
    }
  CHECK(slopes.colwise().sum().norm() < 1e-14);
  CHECK(moment.norm() < 1e-14);
  // Small motions: as the linear link.
  coupling::CarrierRows rest(8, 3), small(8, 3);
  for (int k = 0; k < 8; ++k)
    rest.row(k) << (k & 1), (k >> 1) & 1, (k >> 2) & 1;
  small = 1e-7 * (nodes - rest);
  const auto linear =
    coupling::stiffness_of(std::vector<coupling::BondEnd>{end}, entries, 8, [](const Entry &e) { return e.node; });
  coupling::CarrierRows wanted(8, 3);
  wanted.reshaped<Eigen::RowMajor>() = linear * small.reshaped<Eigen::RowMajor>();
  CHECK((coupling::slopes_of({end}, entries, rest + small, 3) - wanted).norm() < 1e-5 * wanted.norm());
}

TEST_CASE("volume coupling: an overlap that particles do not fill is refused, and where", "[coupling][volume]")
{
  const auto without = [](const double from, const double to) {
    dem::Packing kept;
    const auto   all = Bar<2>::packing();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all.centre[i].x() < from || all.centre[i].x() > to)
        {
          kept.centre.push_back(all.centre[i]);
          kept.radius.push_back(all.radius[i]);
        }
    return kept;
  };
  for (const auto &[name, method] : methods())
    {
      INFO(name);
      const auto made = [&, &tied_by = method](const double from, const double to) {
        BarOptions<2> options;
        options.packing = without(from, to);
        Bar<2> bar(tied_by, options);
      };
      const double side = Bar<2>::own_length;
      const auto   gap  = Catch::Contains("have no particles: places there are up to");
      CHECK_THROWS_WITH(made(side - 0.025, side + 0.035), gap); // beside the region
      CHECK_THROWS_WITH(made(side - 0.055, side - 0.005), gap); // what is in the overlap is not bonded to the region
      CHECK_THROWS_WITH(made(-1, side - 0.001), Catch::Contains("no bond joins"));
      if (method.method == VolumeMethod::multipliers) // constrained particles that deep only ride along
        CHECK_THROWS_WITH(made(side + 0.02, 1), gap);
      CHECK_NOTHROW(made(1, 2));
    }
}

TEST_CASE(
  "volume coupling: a region that its particles do not fill is refused, and where, unless it is meant to be empty",
  "[coupling][volume]")
{
  using Wide       = Bar<2>;
  const double end = Wide::own_length, high = Wide::across * spacing, element = Wide::element;
  const auto   made = [&](const coupling::VolumeCouplingParameters &tied_by, const auto &is_left, const bool is_notch) {
    BarOptions<2> options;
    const auto    all = Wide::packing();
    options.packing.emplace();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (is_left(all.centre[i]))
        {
          options.packing->centre.push_back(all.centre[i]);
          options.packing->radius.push_back(all.radius[i]);
        }
    coupling::VolumeCouplingParameters p = tied_by;
    for (double x = 0; x < end - 0.5 * element; x += element)
      for (double y = 0; y < high - 0.5 * element; y += element)
        p.taken.emplace_back(Vector3d(x, y, 0), Vector3d(x + element, y + element, 0));
    if (is_notch)
      p.empty = [&](const Vector3d &place) { return !is_left(place); };
    Wide bar(p, options);
  };
  for (const auto &[name, method] : methods())
    {
      INFO(name);
      const auto short_of_its_end = [&](const Vector3d &x) { return x.x() > 3.5 * element; };
      CHECK_NOTHROW(made(
        method, [](const Vector3d &) { return true; }, false));
      CHECK_THROWS_WITH(made(method, short_of_its_end, false),
                        Catch::Contains("between (0, 0, 0) and") && Catch::Contains("there are no particles"));
      CHECK_NOTHROW(made(method, short_of_its_end, true));
      // Two rows of particles that are missing are no hole as large as an element, and yet no bond goes across.
      const auto cut = [&](const Vector3d &x) { return x.x() < 2 * element || x.x() > 3 * element; };
      CHECK_THROWS_WITH(made(method, cut, false),
                        Catch::Contains("across a gap of 0.03 m between the centres (0.035, "));
    }
}

TEST_CASE("volume coupling: constrained mass moves with the solid from the start, and its energy is counted",
          "[coupling][volume]")
{
  BarOptions<2> options;
  options.velocity = [](const Vector3d &) { return Vector3d(3, -1, 0); };
  for (const auto &[name, method] : methods())
    {
      INFO(name);
      Bar<2> bar(method, options);
      bar.advance(5);
      const fem::ExplicitEnergy e = bar.motion->energy();
      CHECK(e.start + e.external - e.kinetic - e.internal == Approx(0).margin(1e-10 * e.kinetic));
    }
}

TEST_CASE(
  "volume coupling: quadratic elements have positive masses where they share, and are refused where they cannot",
  "[coupling][volume]")
{
  for (const auto &[name, method] : methods())
    {
      if (method.absorbs)
        continue;
      INFO(name);
      BarOptions<2> options;
      options.degree   = 2;
      options.velocity = Bar<2>::noise;
      if (method.lumped || method.method != VolumeMethod::multipliers)
        {
          CHECK_THROWS_WITH(Bar<2>(method, options), Catch::Contains("elements of order 1"));
          continue;
        }
      Bar<2> bar(method, options);
      for (std::size_t i = 0; i < bar.participant->carriers(); ++i)
        CHECK(bar.participant->mass(i) > 0);
      bar.advance(5);
      const double energy = bar.energy();
      bar.advance(2000);
      CHECK(bar.energy() <= 1.1 * energy); // leapfrog has it to second order of the step
      CHECK(bar.energy() >= 0.9 * energy);
    }
}
