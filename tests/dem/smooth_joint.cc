// Smooth joints against closed forms: doc/theory/smooth-joint.md.
#include "dem/laws/smooth_joint.h"

#include "base/errors.h"
#include "clusters.h"
#include "dem/joints/joint_cuts.h"
#include "dem/laws/contact_bond.h"
#include "held_pair.h"
#include "same_bits.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  using namespace held_pair;

  dem::SmoothJointParameters joint_of(const Vector3d &normal)
  {
    dem::SmoothJointParameters p;
    p.normal_stiffness     = 4e12;
    p.shear_stiffness      = 1.5e12;
    p.friction_coefficient = 0.6;
    p.plane                = normal.normalized();
    return p;
  }

  dem::ContactBondParameters rock()
  {
    dem::ContactBondParameters p;
    p.effective_modulus = 20e9;
    p.stiffness_ratio   = 2;
    p.tensile_strength  = 5e6;
    p.cohesion          = 20e6;
    return p;
  }

  /** The joint's normal from the first particle to the second. */
  Vector3d towards_second(const dem::SmoothJointParameters &joint, const double link_angle)
  {
    const Vector3d link(std::cos(link_angle), std::sin(link_angle), 0);
    return joint.plane.dot(link) < 0 ? Vector3d(-joint.plane) : joint.plane;
  }

  /** Unit vector on the plane; in the plane of x and y where the normal lies there. */
  Vector3d along_plane(const Vector3d &normal)
  {
    const Vector3d up = normal.z() == 0 ? Vector3d(0, 0, 1) : Vector3d(0.3, -0.5, 0.7);
    return up.cross(normal).normalized();
  }

  constexpr double area = 3e-6; // of the link, [m^2]

  dem::Packing cut_pair(const double link_angle)
  {
    dem::Packing packing = HeldPair::turned(link_angle);
    packing.cuts         = {{0, 1, 0, area}};
    return packing;
  }

  dem::Specimen
  jointed(const dem::Packing &packing, const dem::SpecimenParameters &p, const dem::SmoothJointParameters &joint)
  {
    return dem::Specimen(packing, p, dem::LinkMaterials(rock()).with_joints(std::vector{joint}));
  }

  void hold(dem::Specimen &specimen, const std::size_t particle)
  {
    dem::Grip grip;
    grip.particles  = {particle};
    grip.prescribed = all;
    specimen.grips().add(grip);
  }

  /** Two particles that do not turn: the second is moved by so much in that many steps; what pulls it is the stress on the joint. */
  struct JointedPair
  {
    JointedPair(const int dimension, const dem::SmoothJointParameters &joint, const double link_angle)
      : specimen(jointed(cut_pair(link_angle), in(dimension), joint))
    {
      hold(specimen, 0);
      hold(specimen, 1);
    }
    void move(const Vector3d &by, const int steps)
    {
      specimen.grips().set_velocity(1, by / (steps * specimen.time_step()), Vector3d::Zero());
      specimen.advance(steps);
      specimen.grips().set_velocity(1, Vector3d::Zero(), Vector3d::Zero());
      specimen.advance(1); // forces are those of the place from which a step leads
    }
    Vector3d      stress() const { return specimen.grips().reaction(1) / area; }
    bool          intact() const { return specimen.counts().links == 1; }
    dem::Specimen specimen;
  };

  /** Normals in the plane, and in space. */
  std::vector<Vector3d> normals(const int dimension)
  {
    if (dimension == 2)
      return {{0.77, 0.64, 0}, {0.26, 0.97, 0}, {-0.64, 0.77, 0}, {-0.34, -0.94, 0}};
    return {{0.77, 0.64, 0}, {0.2, 0.9, 0.6}, {-0.5, 0.6, -0.7}};
  }

  constexpr int    steps = 500;
  constexpr double angle = 0.7; // of the link, radians
} // namespace

TEST_CASE("smooth joint: closing and opening press and pull along its normal alone, whatever the direction of the link",
          "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const Vector3d &normal : normals(dimension))
      {
        auto law             = joint_of(normal);
        law.tensile_strength = 2e6;
        law.cohesion         = 5e6;
        const Vector3d n = towards_second(law, angle), t = along_plane(n);
        JointedPair    pair(dimension, law, angle);
        const double   d = 0.8 * law.tensile_strength / law.normal_stiffness;
        for (const double by : {-d, 2 * d})
          {
            pair.move(by * n, steps);
            const double expected = by < 0 ? -0.8 * law.tensile_strength : 0.8 * law.tensile_strength;
            CHECK((pair.stress() - expected * n).norm() < 1e-6 * law.tensile_strength);
          }
        CHECK(pair.intact());
        pair.move(d * t, steps); // an elastic slip changes the normal stress by nothing
        CHECK(pair.stress().dot(n) == Approx(0.8 * law.tensile_strength).epsilon(1e-6));
        CHECK(pair.stress().dot(t) == Approx(law.shear_stiffness * d).epsilon(1e-6));
        pair.move(0.3 * d * n, steps);
        CHECK_FALSE(pair.intact());
        CHECK(pair.stress().norm() < 1e-9 * law.tensile_strength);
        const double stored =
          0.5 * area *
          (law.tensile_strength * law.tensile_strength / law.normal_stiffness + law.shear_stiffness * d * d);
        CHECK(pair.specimen.energy().released == Approx(stored).epsilon(2e-3));
        pair.move(-1.4 * d * n, steps); // it closes where it was when it was made
        CHECK(pair.stress().dot(n) == Approx(-0.1 * law.normal_stiffness * d).epsilon(1e-5));
        CHECK(pair.specimen.energy().balance_error() < 1e-3);
      }
}

TEST_CASE("smooth joint: sliding with dilation under a held opening follows the closed form", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const Vector3d &normal : normals(dimension))
      for (const double dilation : {0.0, 12.0})
        {
          auto law           = joint_of(normal);
          law.dilation_angle = dilation;
          const Vector3d n = towards_second(law, angle), t = along_plane(n);
          JointedPair    pair(dimension, law, angle);
          const double   k_n = law.normal_stiffness, k_s = law.shear_stiffness, mu = law.friction_coefficient;
          const double   tan_psi = std::tan(dilation * pi / 180), closed = 1e-6, moved = 2e-5;
          pair.move(-closed * n, steps);
          pair.move(moved * t, 10 * steps);
          const double slid     = (k_s * moved - mu * k_n * closed) / (k_s + mu * k_n * tan_psi);
          const double pressure = k_n * (closed + tan_psi * slid);
          CHECK((pair.stress() + pressure * n - mu * pressure * t).norm() < 1e-6 * pressure);
          const double dissipated = (mu - tan_psi) * (k_n * closed * slid + 0.5 * k_n * tan_psi * slid * slid);
          CHECK(pair.specimen.energy().friction == Approx(area * dissipated).epsilon(1e-5));
          CHECK(pair.specimen.energy().balance_error() < 1e-6);
        }
}

TEST_CASE("smooth joint: the bonded joint breaks in shear at c - mu sigma, and then keeps friction", "[dem][laws]")
{
  for (const double pressure : {0.0, 1e6, 4e6})
    {
      auto law             = joint_of({0.26, 0.97, 0});
      law.tensile_strength = 1e6;
      law.cohesion         = 2e6;
      const Vector3d n = towards_second(law, angle), t = along_plane(n);
      JointedPair    pair(2, law, angle);
      pair.move(-pressure / law.normal_stiffness * n, steps);
      const double strength = law.cohesion + law.friction_coefficient * pressure;
      pair.move(0.999 * strength / law.shear_stiffness * t, steps);
      CHECK(pair.intact());
      CHECK(pair.stress().dot(t) == Approx(0.999 * strength).epsilon(1e-6));
      pair.move(0.002 * strength / law.shear_stiffness * t, steps);
      CHECK_FALSE(pair.intact());
      CHECK(pair.stress().dot(t) == Approx(law.friction_coefficient * pressure).epsilon(1e-6).margin(1e-3));
      CHECK(pair.stress().dot(n) == Approx(-pressure).epsilon(1e-6).margin(1e-3));
      CHECK(pair.specimen.energy().balance_error() < 1e-3);
    }
}

namespace
{
  /** A block on a held base, a joint at a dip between them, under its weight from the start. */
  struct Block
  {
    Block(const double dip, const dem::SmoothJointParameters &joint, const double link_angle)
      : down(-std::cos(dip), -std::sin(dip), 0)
      , specimen(jointed(cut_pair(link_angle), under_weight(), joint))
    {
      hold(specimen, 0);
    }
    static dem::SpecimenParameters under_weight()
    {
      dem::SpecimenParameters p = in(2);
      p.physics.rotations       = false;
      p.gravity                 = {0, -g, 0};
      p.step_factor             = 3e-3;
      return p;
    }
    double swing(const double stiffness) const { return std::sqrt(stiffness * area / specimen.particle(1).mass); }

    static constexpr double g = 9.81;
    Vector3d                down;
    dem::Specimen           specimen;
  };

  Vector3d normal_at(const double dip) { return {-std::sin(dip), std::cos(dip), 0}; }
} // namespace

TEST_CASE("smooth joint: a block slides down an inclined joint with g (sin - mu cos), whatever its link's direction",
          "[dem][laws]")
{
  // Normal to the plane the block swings about its weight, p = m g cos (1 - cos wt); it slides from the start, as k_s tan > mu k_n.
  for (const double degrees : {25.0, 40.0, 60.0})
    for (const double side : {1.0, -1.0}) // of the joint's normal, which may point to either
      {
        const double dip         = degrees * pi / 180;
        auto         law         = joint_of(side * normal_at(dip));
        law.friction_coefficient = 0.3;
        law.shear_stiffness      = 2 * law.normal_stiffness;
        Block        block(dip, law, 1.2);
        const int    n_steps = 16000;
        const double w       = block.swing(law.normal_stiffness);
        block.specimen.advance(n_steps);
        // At rest half a step before the start, with velocities of half a step before the end.
        const double time     = n_steps * block.specimen.time_step();
        const double expected = Block::g * (std::sin(dip) * time -
                                            law.friction_coefficient * std::cos(dip) * (time - std::sin(w * time) / w));
        CHECK(block.specimen.particle(1).velocity.dot(block.down) == Approx(expected).epsilon(1e-6));
        CHECK(block.specimen.energy().balance_error() < 1e-6);
      }
}

TEST_CASE("smooth joint: below the angle of friction a block stays, pressed by its weight's part along the normal",
          "[dem][laws]")
{
  // Of equal stiffnesses the block swings straight along its weight and back, shear over pressure being tan of the dip throughout.
  for (const double degrees : {10.0, 25.0, 30.9})
    {
      const double dip    = degrees * pi / 180;
      auto         law    = joint_of(normal_at(dip));
      law.shear_stiffness = law.normal_stiffness; // mu = 0.6 = tan 30.96
      Block        block(dip, law, 1.2);
      const double w = block.swing(law.normal_stiffness), mass = block.specimen.particle(1).mass;
      block.specimen.advance(static_cast<std::int64_t>(7 * pi / w / block.specimen.time_step()));
      const Vector3d moved = block.specimen.particle(1).position - 2 * R * Vector3d(std::cos(1.2), std::sin(1.2), 0);
      const double   time  = static_cast<double>(block.specimen.steps()) * block.specimen.time_step();
      const double   sunk  = mass * Block::g / (law.normal_stiffness * area) * (1 - std::cos(w * time));
      CHECK((moved + Vector3d(0, sunk, 0)).norm() < 1e-5 * sunk);
      CHECK(block.specimen.energy().friction < 1e-9 * mass * Block::g * sunk);
      CHECK(block.specimen.energy().balance_error() < 1e-6);
    }
}

TEST_CASE("smooth joint tangent: it is the derivative of the update, bonded, closed, sliding and open", "[dem][laws]")
{
  auto p           = joint_of({-0.2, 0.9, 0.6});
  p.dilation_angle = 10;
  const double   L = 2e-3;
  const Vector3d n(1, 0, 0), N = -p.plane, t = along_plane(N);
  for (const double bond : {0.0, 1e9})
    for (const Vector3d &moved : {Vector3d(-2e-7 * N + 1e-8 * t), Vector3d(-2e-7 * N + 9e-7 * t), Vector3d(2e-7 * N)})
      {
        p.cohesion = p.tensile_strength = bond;
        const auto   law                = dem::SmoothJointLaw::bonds({p}, dem::Physics(), 3);
        dem::NewLink fresh;
        fresh.distance  = L;
        fresh.area      = area;
        fresh.direction = n;
        std::vector<double> begun(law->columns().size(), 0.0);
        law->begin(0, fresh, begun.data());
        dem::LinkStep step;
        bool          slides   = false;
        const auto    stressed = [&](const Vector3d &by, std::vector<double> &history) {
          const Vector3d strain = by / L;
          step.geometry         = {strain.dot(n), L * (1 + strain.dot(n)), L, area};
          step.direction        = n;
          step.shear_increment  = strain - strain.dot(n) * n;
          const auto answer     = law->update(0, step, begun.data(), history.data());
          slides                = answer.slides;
          return Vector3d(answer.force / area);
        };
        Eigen::Matrix3d numeric;
        const double    h = 1e-12;
        for (int c = 0; c < 3; ++c)
          {
            std::vector<double> other = begun;
            numeric.col(c) =
              (stressed(moved + h * Vector3d::Unit(c), other) - stressed(moved - h * Vector3d::Unit(c), other)) /
              (2 * h) * L;
          }
        std::vector<double> history = begun;
        stressed(moved, history);
        if (moved.dot(N) < 0)
          CHECK(slides == (bond == 0 && moved.dot(t) > 5e-7));
        dem::LinkTangent kind;
        kind.slides                   = slides;
        const Eigen::Matrix3d tangent = law->tangent(0, step, begun.data(), history.data(), kind).topLeftCorner<3, 3>();
        // What a turned link adds is of the order of the strain.
        CHECK((tangent - numeric).norm() < 1e-3 * p.normal_stiffness * L);
      }
}

TEST_CASE("smooth joint: no motion is met by more than the stiffness along and across the link", "[dem][laws]")
{
  const auto            p   = joint_of({0.2, 0.9, 0.6});
  const auto            law = dem::SmoothJointLaw::bonds({p}, dem::Physics(), 3);
  const Eigen::Matrix3d nn  = p.plane * p.plane.transpose(),
                        K   = p.normal_stiffness * nn + p.shear_stiffness * (Eigen::Matrix3d::Identity() - nn);
  for (const Vector3d &n : {p.plane, along_plane(p.plane), Vector3d(1, 0, 0), Vector3d(0.6, 0, 0.8)})
    {
      dem::NewLink fresh;
      fresh.distance  = 2e-3;
      fresh.direction = n;
      std::vector<double> history(law->columns().size(), 0.0);
      law->begin(0, fresh, history.data());
      const auto            s = law->stiffness(0, {0, 2e-3, 2e-3, area}, history.data());
      const Eigen::Matrix3d bound =
        (s.normal * n * n.transpose() + s.shear * (Eigen::Matrix3d::Identity() - n * n.transpose())) / 2e-3;
      const Eigen::Vector3d spare = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(bound - K).eigenvalues();
      CHECK(spare.minCoeff() > -1e-9 * p.normal_stiffness);
      CHECK(std::max(s.normal, s.shear) < 1.21 * 2e-3 * p.normal_stiffness);
    }
  std::vector<double> along(law->columns().size(), 0.0);
  dem::NewLink        fresh;
  fresh.distance  = 2e-3;
  fresh.direction = p.plane;
  law->begin(0, fresh, along.data());
  CHECK(law->stiffness(0, {0, 2e-3, 2e-3, area}, along.data()).normal == Approx(2e-3 * p.normal_stiffness));
  CHECK(law->stiffness(0, {0, 2e-3, 2e-3, area}, along.data()).shear == Approx(2e-3 * p.shear_stiffness));
}

TEST_CASE("smooth joint: a jointed body has the same bits for any threads, and closes its account", "[dem][laws]")
{
  dem::Packing body         = cluster::random_cluster(11, 300, 0.7 * R, R);
  auto         law          = joint_of({0.3, 0.2, 0.9});
  law.normal_stiffness      = 5e12;
  law.tensile_strength      = 1e6;
  law.cohesion              = 2e6;
  law.dilation_angle        = 5;
  dem::SpecimenParameters p = cluster::bonded(1.2);
  p.step_factor             = 0.1;
  Vector3d middle           = Vector3d::Zero();
  for (const Vector3d &each : body.centre)
    middle += each / static_cast<double>(body.size());
  dem::JointPlane plane;
  plane.centre              = middle;
  plane.normal              = law.plane;
  const dem::JointCuts cuts = dem::find_cuts(body, {3, 0, 1.2, 0, body.size()}, {plane});
  body.cuts                 = cuts.cuts;
  REQUIRE(cuts.of_joint[0].links > 20);
  const auto made = [&] {
    dem::Specimen specimen = jointed(body, p, law);
    for (std::size_t i = 0; i < body.size(); ++i)
      {
        const double side = plane.normal.dot(body.centre[i] - middle) > 0 ? 1 : -1;
        specimen.set_velocity(i, side * (0.5 * along_plane(law.plane) - 0.3 * law.plane), Vector3d(3, -2, 1));
      }
    return specimen;
  };
  check_same_bits(made, 300, 300, cuts.of_joint[0].links / 2);
  dem::Specimen one = made();
  one.advance(600);
  CHECK(one.energy().friction > 0);
  CHECK(one.energy().balance_error() < 1e-2);
}

TEST_CASE("smooth joint refuses constants without meaning, by name", "[dem][laws]")
{
  const auto refused = [](const dem::SmoothJointParameters &p) {
    try
      {
        dem::SmoothJointLaw::check(p);
      }
    catch (const base::InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  auto p             = joint_of({0, 1, 0});
  p.normal_stiffness = 0;
  CHECK(refused(p).find("smooth-joint/Normal stiffness") != std::string::npos);
  p                = joint_of({0, 1, 0});
  p.dilation_angle = 35; // tan 35 deg = 0.70 > 0.6
  CHECK(refused(p).find("smooth-joint/Dilation angle") != std::string::npos);
  p          = joint_of({0, 1, 0});
  p.cohesion = -1;
  CHECK(refused(p).find("smooth-joint/Cohesion") != std::string::npos);
  CHECK(refused(joint_of({1, 1, 0})).empty());
}
