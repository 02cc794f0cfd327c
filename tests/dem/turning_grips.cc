// Grips that turn, against bars side by side: doc/theory/laboratory-test.md, 1.
#include "dem/network/turning_grips.h"

#include "base/errors.h"
#include "dem/observation/path_output.h"
#include "laboratory_fixture.h"
#include "quasi_static_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

using laboratory::R;

namespace
{
  constexpr int    links_of_bar = 6;
  constexpr double apart = 10 * R, strain = 1e-5;

  /** Bars of spheres (discs) along an axis, at places across it, each of a material of its own. */
  dem::Packing bars(const int axis, const std::vector<Eigen::Vector2d> &places)
  {
    dem::Packing packing;
    for (std::size_t b = 0; b < places.size(); ++b)
      for (int i = 0; i <= links_of_bar; ++i)
        {
          Eigen::Vector3d x = Eigen::Vector3d::Zero();
          x[axis]           = 2 * R * i;
          x[(axis + 1) % 3] = places[b].x();
          x[(axis + 2) % 3] = places[b].y();
          packing.centre.push_back(x);
          packing.radius.push_back(R);
          packing.material.push_back(static_cast<std::int32_t>(b));
        }
    return packing;
  }

  /** Moduli of the bars, over that of the first. */
  const std::vector<double> softer = {1, 0.6, 0.8};

  dem::LinkMaterials materials()
  {
    std::vector<dem::Material<dem::FlatJointParameters>> list;
    for (const double each : softer)
      {
        list.push_back({"", laboratory::strong(), 0});
        list.back().parameters.effective_modulus *= each;
      }
    return dem::Materials<dem::FlatJointParameters>(list);
  }

  struct Pulled
  {
    double                       force = 0;
    std::vector<Eigen::Vector3d> moved;
  };

  Pulled
  pulled(const dem::Packing &packing, const int dimension, const int axis, const bool turn, const bool spin_blocked)
  {
    dem::NetworkParameters links;
    links.dimension         = dimension;
    links.thickness         = 1;
    links.interaction_ratio = 1.1;
    dem::GripPair grips;
    grips.axis            = axis;
    grips.lateral_blocked = true;
    grips.spin_blocked    = spin_blocked;
    dem::GripParameters ends;
    ends.thickness                  = 0.5 * R;
    grips.layers                    = dem::find_grip_layers({packing.centre, packing.radius, dimension, 1}, axis, ends);
    const dem::LinkMaterials law    = materials();
    dem::LoadedNetwork       loaded = dem::load_grips(dem::make_network(packing, links, law), grips);
    if (turn)
      dem::let_grips_turn(loaded, grips);
    dem::QuasiStaticParameters p;
    p.strain_step = p.end_strain = strain;
    p.tolerance                  = 1e-11;
    dem::QuasiStaticPath path(loaded, law, p);
    while (!path.finished())
      path.advance();
    return {path.points().back().stress[loaded.driven] * grips.layers.section,
            dem::displacements_of(loaded, path.motion())};
  }

  /** Of a bar [N/m]. */
  double stiffness(const int dimension, const std::size_t bar)
  {
    const double area = dimension == 2 ? 2 * R : M_PI * R * R;
    return laboratory::modulus * softer[bar] * area / (2 * R) / links_of_bar;
  }

  constexpr double way = strain * 2 * R * links_of_bar;
} // namespace

TEST_CASE("grips that turn find two bars of unequal stiffness as soft as their hinges say, parallel ones their sum",
          "[dem][statics]")
{
  for (const int axis : {0, 1})
    {
      const std::vector<Eigen::Vector2d> places =
        axis == 0 ? std::vector<Eigen::Vector2d>{{0, 0}, {apart, 0}} : std::vector<Eigen::Vector2d>{{0, 0}, {0, apart}};
      const dem::Packing packing = bars(axis, places);
      const double       k_1 = stiffness(2, 0), k_2 = stiffness(2, 1);
      CHECK(pulled(packing, 2, axis, false, false).force == Approx((k_1 + k_2) * way).epsilon(1e-9));
      const Pulled turned = pulled(packing, 2, axis, true, false);
      CHECK(turned.force == Approx(4 * k_1 * k_2 / (k_1 + k_2) * way).epsilon(1e-9));
      // Each bar bears half, and is stretched by it.
      CHECK(turned.moved[links_of_bar][axis] == Approx(0.25 * turned.force / k_1).epsilon(1e-6));
      // Bars that are clamped to their grips bend with them, and resist.
      const double clamped = pulled(packing, 2, axis, true, true).force;
      CHECK(clamped > (1 + 1e-6) * turned.force);
      CHECK(clamped < (1 - 1e-6) * (k_1 + k_2) * way);
    }
}

TEST_CASE("grips that turn find three bars in space loaded alike, whatever their stiffness", "[dem][statics]")
{
  const std::vector<Eigen::Vector2d> places = {{0, 0}, {apart, 0}, {0.3 * apart, 0.9 * apart}};
  for (const int axis : {0, 1, 2})
    {
      double softness = 0;
      for (std::size_t bar = 0; bar < places.size(); ++bar)
        softness += 1 / (9 * stiffness(3, bar)); // a third of the force each, and a third of its way in the mean
      CHECK(pulled(bars(axis, places), 3, axis, true, false).force == Approx(way / softness).epsilon(1e-9));
    }
}

TEST_CASE("grips that turn refuse a specimen that would fall over, and one without a face", "[dem][statics]")
{
  const dem::Packing one = bars(2, {{0, 0}});
  CHECK_THROWS_AS(pulled(one, 3, 2, true, false), base::InputError);
  dem::GripPair grips;
  grips.layers.low  = {0};
  grips.layers.high = {links_of_bar};
  dem::LoadedNetwork loaded;
  CHECK_THROWS_AS(dem::let_grips_turn(loaded, grips), base::InputError);
}
