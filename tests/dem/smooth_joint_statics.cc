// Joints through networks in equilibrium, against closed forms and specimens in motion: doc/theory/smooth-joint.md, 6 and 7.
#include "base/errors.h"
#include "clusters.h"
#include "dem/joints/joint_cuts.h"
#include "dem/laws/smooth_joint.h"
#include "laboratory_fixture.h"
#include "quasi_static_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

using laboratory::R;

namespace
{
  dem::SmoothJointParameters rough_joint(const double friction)
  {
    dem::SmoothJointParameters p;
    p.normal_stiffness     = 4e12;
    p.shear_stiffness      = 3.6e12;
    p.friction_coefficient = friction;
    return p;
  }

  /** Bonds that nothing breaks, and that hold particles from rolling. */
  dem::FlatJointParameters unbreakable_rock(const double modulus)
  {
    dem::FlatJointParameters p = laboratory::strong();
    p.effective_modulus        = modulus;
    p.tensile_strength = p.cohesion = 1e18;
    return p;
  }

  /** A joint through the middle of a packing. @param joint receives the plane @param dip [degrees] */
  dem::CutFigures cut(dem::Packing &packing, const int dimension, const double dip, dem::SmoothJointParameters &joint)
  {
    dem::JointPlane plane;
    for (const Eigen::Vector3d &each : packing.centre)
      plane.centre += each / static_cast<double>(packing.size());
    plane.normal = joint.plane = dem::normal_of_dip(dip, 0, dimension);
    const dem::JointCuts found = dem::find_cuts(packing, {dimension, 1.0, 1.1, 0, packing.size()}, {plane});
    packing.cuts               = found.cuts;
    return found.of_joint.front();
  }

  /** A packing between grips at its ends. */
  struct Column
  {
    dem::LinkMaterials law;
    dem::LoadedNetwork loaded;
    double             length; ///< between the grips [m]

    /** @param rough its grips hold their particles sideways, too */
    Column(const dem::Packing &packing, const dem::LinkMaterials &materials, const int dimension, const bool rough)
      : law(materials)
    {
      dem::NetworkParameters links;
      links.dimension         = dimension;
      links.thickness         = 1;
      links.interaction_ratio = 1.1;
      dem::GripPair grips;
      grips.axis            = dimension - 1;
      grips.lateral_blocked = grips.spin_blocked = rough;
      dem::GripParameters ends;
      ends.thickness = 0.5 * R;
      grips.layers   = dem::find_grip_layers({packing.centre, packing.radius, dimension, 1}, grips.axis, ends);
      length         = grips.layers.distance;
      loaded         = dem::load_grips(dem::make_network(packing, links, law), grips);
    }

    /** Both grips' way towards each other, in equal steps; below zero: apart. */
    struct Followed
    {
      dem::QuasiStaticPoint end;
      double                force = 0, largest = 0; ///< that presses the column, at the end and at most [N]
    };
    Followed press(const double approach, const int steps = 50) const
    {
      dem::QuasiStaticParameters p;
      p.sign        = approach > 0 ? -1 : 1;
      p.end_strain  = std::fabs(approach) / length;
      p.strain_step = p.end_strain / steps;
      p.tolerance   = 1e-8;
      dem::QuasiStaticPath path(loaded, law, p);
      Followed             found;
      while (!path.finished())
        {
          found.end     = path.advance();
          found.force   = -found.end.stress[loaded.driven] * loaded.volume / length;
          found.largest = std::max(found.largest, found.force);
        }
      return found;
    }
  };

  /** Blocks so stiff that the joint alone gives way. */
  constexpr double rigid = 1e16;

  constexpr double degree = M_PI / 180;
} // namespace

TEST_CASE("joint in equilibrium: a column is as soft as its rock and its joint in a row",
          "[dem][laws][statics]")
{
  const int    across = 4, along = 9;
  dem::Packing column = cluster::cubic_lattice(across, across, along + 1, R);
  auto         joint  = rough_joint(0.6);
  joint.cohesion = joint.tensile_strength = 1e12;
  const double modulus = 20e9, approach = 1e-6;
  const auto   figures = cut(column, 3, 0, joint);
  const Column body(column, dem::LinkMaterials(unbreakable_rock(modulus)).with_joints(std::vector{joint}), 3, false);
  REQUIRE(figures.links == across * across);
  const double springs  = across * across * modulus * M_PI * R * R / (2 * R);
  const double expected = approach / ((along - 1) / springs + 1 / (joint.normal_stiffness * figures.area));
  CHECK(body.press(approach, 10).force == Approx(expected).epsilon(1e-8));
  CHECK(body.press(-approach, 10).force == Approx(-expected).epsilon(1e-8));
}

TEST_CASE("joint in equilibrium: stiff blocks stick, slide at the Coulomb limit and dilate as the closed form says",
          "[dem][laws][statics]")
{
  const double dip = 50, approach = 1e-6, normal = approach * std::cos(dip * degree),
               slip = approach * std::sin(dip * degree);
  for (const double friction : {0.3, 0.6, 1.5}) // the last sticks: k_s tan(dip) < mu k_n
    for (const double dilation : {0.0, 12.0})
      {
        INFO("friction " << friction << ", dilation " << dilation);
        dem::Packing column  = laboratory::crystal(10, 14);
        auto         joint   = rough_joint(friction);
        joint.dilation_angle = dilation;
        const auto   figures = cut(column, 2, dip, joint);
        const Column body(column, dem::LinkMaterials(unbreakable_rock(rigid)).with_joints(std::vector{joint}), 2, true);
        const double k_n = joint.normal_stiffness, k_s = joint.shear_stiffness, tan_psi = std::tan(dilation * degree);
        const double slid = std::max(0.0, (k_s * slip - friction * k_n * normal) / (k_s + friction * k_n * tan_psi));
        const double pressure = k_n * (normal + tan_psi * slid), shear = k_s * (slip - slid);
        const double expected = figures.area * (pressure * std::cos(dip * degree) + shear * std::sin(dip * degree));
        CHECK((slid == 0) == (friction > 1));
        const Column::Followed found = body.press(approach, 20);
        CHECK(found.force == Approx(expected).epsilon(1e-3));
        // What is slid under a pressure that grows with it: half of mu times the pressure at the end, less what dilation has lifted.
        CHECK(found.end.friction ==
              Approx(figures.area * 0.5 * (friction - tan_psi) * pressure * slid).epsilon(2e-3).margin(1e-12));
        CHECK(found.end.balance_error() < 1e-3);
      }
}

TEST_CASE("joint in equilibrium: a bonded joint tears at its tensile strength and carries nothing then",
          "[dem][laws][statics]")
{
  dem::Packing column    = laboratory::crystal(8, 12);
  auto         joint     = rough_joint(0.6);
  joint.tensile_strength = 2e6;
  joint.cohesion         = 1e12;
  const auto   figures   = cut(column, 2, 0, joint);
  const Column body(column, dem::LinkMaterials(unbreakable_rock(rigid)).with_joints(std::vector{joint}), 2, true);
  const Column::Followed found = body.press(-1e-6); // torn at half of it
  const double           force = joint.tensile_strength * figures.area;
  CHECK(std::fabs(found.force) < 1e-3 * force);
  const double stored = 0.5 * force * joint.tensile_strength / joint.normal_stiffness;
  CHECK(found.end.external_work == Approx(stored).epsilon(0.05)); // it breaks within a step of the strain
}

namespace
{
  struct Rested
  {
    double force = 0, friction = 0; ///< that presses the column [N], dissipated [J]
  };

  /** The column in motion: its ends approach in so many steps, and then it comes to rest. */
  Rested rested(const dem::Packing &column, const dem::LinkMaterials &law, const double approach, const int steps)
  {
    dem::Specimen       body(column, laboratory::discs(), law);
    dem::GripParameters ends;
    ends.thickness    = 0.5 * R;
    const auto layers = dem::find_grip_layers({column.centre, column.radius, 2, 1}, 1, ends);
    for (const std::vector<std::size_t> &particles : {layers.low, layers.high})
      {
        dem::Grip grip;
        grip.particles = particles;
        grip.prescribed.fill(true);
        body.grips().add(grip);
      }
    const Eigen::Vector3d still = Eigen::Vector3d::Zero();
    body.grips().set_velocity(1, Eigen::Vector3d(0, -approach / (steps * body.time_step()), 0), still);
    body.advance(steps);
    body.grips().set_velocity(1, still, still);
    body.advance(2000);
    return {-body.grips().reaction(1).y(), body.energy().friction};
  }
} // namespace

TEST_CASE("joint in equilibrium: a jointed column bears what it bears in motion, the nearer the slower",
          "[dem][laws][statics]")
{
  dem::Packing column  = laboratory::crystal(6, 11, 0.05);
  auto         joint   = rough_joint(0.4);
  joint.dilation_angle = 6;
  cut(column, 2, 40, joint);
  const Column     body(column, dem::LinkMaterials(unbreakable_rock(20e9)).with_joints(std::vector{joint}), 2, true);
  constexpr double approach    = 2e-6;
  const Column::Followed still = body.press(approach);
  CHECK(still.end.friction > 0);
  const Rested fast = rested(column, body.law, approach, 6000), slow = rested(column, body.law, approach, 12000);
  // What the speed adds falls in proportion to it.
  CHECK(2 * slow.force - fast.force == Approx(still.force).epsilon(1e-3));
  CHECK(2 * slow.friction - fast.friction == Approx(still.end.friction).epsilon(3e-3));
  CHECK(slow.force == Approx(still.force).epsilon(5e-3));
}

TEST_CASE("joint in equilibrium: contacts that wait are refused beside joints", "[dem][laws][statics]")
{
  dem::Packing column = laboratory::crystal(4, 6);
  auto         joint  = rough_joint(0.4);
  cut(column, 2, 0, joint);
  dem::NetworkParameters links;
  links.dimension         = 2;
  links.thickness         = 1;
  links.interaction_ratio = 1.1;
  links.contact_reach     = 0.5;
  CHECK_THROWS_AS(
    dem::make_network(column, links, dem::LinkMaterials(unbreakable_rock(1e9)).with_joints(std::vector{joint})),
    base::InputError);
}
