// Flat joints in the kernel and in statics against closed forms: doc/theory/flat-joint.md; names T1 to T12 are those of its list.
#include "dem/laws/flat_joint.h"

#include "clusters.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/parallel_bond.h"
#include "dem/linear/linear_solver.h"
#include "dem/network/elastic_network.h"
#include "dem/packing/lattice.h"
#include "dem/statics/quasi_static_path.h"
#include "held_joint.h"
#include "held_pair.h"
#include "same_bits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using Eigen::Vector3d;

namespace
{
  using namespace held_pair;
  using held_joint::Joint;
  using held_joint::mortar;

} // namespace

TEST_CASE("flat joint in tension breaks in all elements at once at its strength and then carries nothing (T1)",
          "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const double angle : {0.0, 2.0})
      check_tension(mortar(), dimension, angle);
}

TEST_CASE("flat joint bent about its middle cracks at the closed form, and goes on as its crack does (T3)",
          "[dem][laws]")
{
  const double published[][2] = {{2, 0.386667}, {4, 0.257778}, {8, 0.220952}};
  for (const auto &[elements, moment] : published)
    {
      const auto   law   = mortar(static_cast<int>(elements));
      const double unit  = law.tensile_strength * 2 * R / law.effective_modulus / R; // sigma_c/(k_n R)
      const double first = unit / (1 - 1 / elements);
      HeldPair     pair(2, law, 0.4);
      pair.drive(0, 0, first, 1000);
      double largest = 0;
      for (int i = 0; i < 1010; ++i)
        {
          pair.specimen.advance(1);
          largest = std::max(largest, std::abs(pair.moment()));
        }
      CHECK(largest <= moment * (1 + 1e-5));
      CHECK(largest >= moment * (1 - 2e-3));
    }
  const auto   law  = mortar(4);
  const double unit = law.tensile_strength * 2 * R / law.effective_modulus / R;
  for (const auto &[turn, force, moment] : {std::array<double, 3>{1.6, 174.0, 0.17400}, {3.0, 326.25, 0.32625}})
    {
      HeldPair pair(2, law);
      pair.drive(0, 0, turn * unit, 3000);
      pair.specimen.advance(3001);
      CHECK(pair.pull() == Approx(-force).epsilon(1e-6));
      CHECK(std::abs(pair.moment()) == Approx(moment).epsilon(1e-6));
      CHECK(pair.intact() == 1);
      CHECK(pair.specimen.energy().balance_error() < 1e-5);
    }
}

TEST_CASE("flat joint sheared at a constant normal stress breaks at c - sigma tan phi, then rubs (T2)", "[dem][laws]")
{
  const double published[][3] = {
    {-5e6, 3.8693426e6, 1.05e6}, {-1e6, 2.3578685e6, 0.21e6}, {0, 1.98e6, 0}, {0.2e6, 1.9044263e6, 0}};
  const int steps = 2000;
  for (const auto &[normal, peak, left] : published)
    {
      const auto   law    = mortar();
      const double length = 2 * R * (1 + normal / law.effective_modulus), area = section(2);
      const double slip = 1.2 * peak / (law.effective_modulus / law.stiffness_ratio) * 2 * R;
      HeldPair     pair(2, law);
      pair.drive(length - 2 * R, 0, 0, 100);
      pair.specimen.advance(101);
      // On a circle about the first disc: the distance stays.
      double largest = 0, last = 0;
      for (int i = 1; i <= steps; ++i)
        {
          const double   angle = slip / length * i / steps;
          const Vector3d place = length * Vector3d(std::cos(angle), std::sin(angle), 0),
                         across(-std::sin(angle), std::cos(angle), 0);
          pair.specimen.grips().set_velocity(
            1, (place - pair.specimen.particle(1).position) / pair.specimen.time_step(), Vector3d::Zero());
          pair.specimen.advance(1);
          last    = std::abs(pair.specimen.grips().reaction(1).dot(across)) / area;
          largest = std::max(largest, last);
        }
      INFO("normal stress " << normal);
      CHECK(largest <= peak * (1 + 1e-6));
      CHECK(largest >= peak * (1 - 2.4 / steps));
      CHECK(last == Approx(left).epsilon(1e-4).margin(1e-6 * peak));
      for (const dem::Break &b : pair.specimen.breaks())
        CHECK(b.mode == dem::BreakMode::shear);
      CHECK(pair.specimen.logged_breaks() == 4);
    }
}

TEST_CASE("flat joint bent without axial force breaks one element after the other, but for the last (T4)",
          "[dem][laws]")
{
  const std::vector<std::vector<double>> published = {{0.257778, 0.163125, 0.096667},
                                                      {0.232000, 0.167824, 0.114568, 0.072500, 0.042963}};
  for (const auto &moments : published)
    {
      const int  elements = static_cast<int>(moments.size()) + 1;
      const auto law      = mortar(elements);
      auto       how      = in(2);
      how.damping         = 0.7;
      dem::Specimen body(cluster::pair_of_spheres(R, R, 2 * R), how, law);
      const double  end   = 1.2 * 3.4e-4; // beyond the last break
      const int     steps = 60000;
      const double  spin  = end / (steps * body.time_step());
      for (const std::size_t i : {0, 1})
        {
          dem::Grip grip;
          grip.particles     = {i};
          grip.prescribed    = all;
          grip.prescribed[0] = i == 0; // the second goes where no force is along the axis
          grip.spin          = {0, 0, (i == 0 ? -0.5 : 0.5) * spin};
          body.grips().add(grip);
        }
      std::vector<double> found;
      double              before = 0;
      for (int i = 0; i < steps; ++i)
        {
          const auto logged = body.logged_breaks();
          body.advance(1);
          if (body.logged_breaks() > logged)
            found.push_back(before);
          before = std::abs(body.grips().reaction_moment(1).z());
        }
      INFO(elements << " elements");
      REQUIRE(found.size() == moments.size());
      for (std::size_t k = 0; k < found.size(); ++k)
        CHECK(found[k] == Approx(moments[k]).epsilon(3e-3));
      // M = k_n t l^3 theta/12 of the last one.
      const double l = 2 * R / elements, kn = law.effective_modulus / (2 * R);
      CHECK(before == Approx(kn * l * l * l * end / 12).epsilon(2e-2));
      CHECK(body.counts().links == 1);
    }
}

TEST_CASE("bonded flat joint is as stiff in bending as the disk or segment, however many elements it has",
          "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const int n : {1, 2, 5})
      {
        auto p    = mortar(4 * n);
        p.rings   = n;
        p.sectors = 2 + 3 * n;
        Joint joint(p, dimension);
        joint.advance(0, Vector3d::Zero(), Vector3d(0, 0, 1e-6));
        CHECK(joint.answer.moment.z() ==
              Approx(p.effective_modulus / (2 * R) * second_moment(dimension) * 1e-6).epsilon(1e-12));
      }
  // The published ratios of the centroid rule.
  for (const auto &[rings, sectors, ratio] :
       {std::array<double, 3>{1, 3, 0.6079}, {1, 6, 0.8106}, {2, 6, 0.8781}, {3, 12, 0.9603}, {4, 16, 0.9773}})
    CHECK(dem::disk_layout(int(rings), int(sectors), false).second_moment() * 4 == Approx(ratio).margin(5e-5));
}

TEST_CASE("flat joint of one slit element, partly closed, pushes off its middle (T5)", "[dem][laws]")
{
  auto p          = mortar(1);
  p.slit_fraction = 1;
  Joint joint(p, 2);
  joint.advance(-0.2e-6, Vector3d::Zero(), Vector3d(0, 0, 0.4e-6 / R));
  CHECK(joint.answer.force.x() == Approx(-2335.5).epsilon(1e-9));
  CHECK(-joint.answer.moment.z() == Approx(-1.16775).epsilon(1e-9));
}

TEST_CASE("flat joints are bonded, gapped and slit by fractions that depend on the pair alone", "[dem][laws]")
{
  auto p                = mortar();
  p.gapped_fraction     = 0.2;
  p.slit_fraction       = 0.3;
  p.mean_gap            = 1e-6;
  p.gap_deviation       = 1e-6;
  int              slit = 0, gapped = 0;
  const int        all_joints = 4000;
  std::set<double> gaps;
  for (int i = 1; i <= all_joints; ++i)
    {
      const Joint  joint(p, 2, i);
      const double state = joint.column("element_1_state"), gap = joint.column("initial_gap");
      slit += state == dem::FlatJoint::slit;
      gapped += state == dem::FlatJoint::gapped;
      CHECK((gap > 0) == (state == dem::FlatJoint::gapped));
      gaps.insert(gap);
    }
  CHECK(slit == Approx(0.3 * all_joints).margin(100));
  CHECK(gapped == Approx(0.2 * all_joints).margin(90));
  CHECK(gaps.size() == std::size_t(gapped) + 1);
}

TEST_CASE("broken flat joint that slides over its length becomes a linear contact without a jump", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    {
      auto p          = mortar();
      p.slit_fraction = 1;
      Joint        joint(p, dimension);
      const double push = 1e-7;
      joint.advance(-push, Vector3d::Zero(), Vector3d::Zero());
      const double force = joint.answer.force.x();
      CHECK(force == Approx(-p.effective_modulus / (2 * R) * section(dimension) * push));
      const int steps = 2200;
      for (int i = 0; i < steps; ++i)
        {
          joint.advance(-push, Vector3d(0, R / 1000, 0), Vector3d::Zero());
          REQUIRE(joint.answer.force.x() == Approx(force).epsilon(1e-9));
          REQUIRE(joint.answer.force.y() == Approx(-p.friction_coefficient * force).epsilon(1e-9));
        }
      CHECK(joint.column("replaced") == 1);
      CHECK(std::abs(joint.work - joint.stored() - joint.lost) < 1e-9 * joint.work);
      joint.advance(-push, Vector3d::Zero(), Vector3d(0, 0, 1e-5));
      CHECK(joint.answer.moment.norm() == 0);
    }
}

TEST_CASE("flat joint that slides over its length while it is open pushes again where it was made", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const double slid : {1.9, 2.2})
      {
        auto p          = mortar();
        p.slit_fraction = 1;
        Joint     joint(p, dimension);
        const int steps = 100;
        for (int i = 0; i < steps; ++i)
          joint.advance(1e-6, Vector3d(0, slid * R / steps, 0), Vector3d::Zero());
        INFO("dimension " << dimension << ", slid by " << slid << " R");
        CHECK(joint.column("replaced") == (slid > 2 ? 1 : 0));
        joint.advance(0.5e-6, Vector3d::Zero(), Vector3d::Zero());
        CHECK(joint.answer.force.norm() == 0);
        joint.advance(-1e-7, Vector3d::Zero(), Vector3d::Zero());
        CHECK(joint.answer.force.x() ==
              Approx(-p.effective_modulus / (2 * R) * section(dimension) * 1e-7).epsilon(1e-12));
      }
}

TEST_CASE("contact in the place of a flat joint makes no energy, however soft contacts are that form later",
          "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const double turn : {0.0, 3e-4})
      {
        auto p                      = mortar();
        p.slit_fraction             = 1;
        p.contact_effective_modulus = 0.2 * p.effective_modulus;
        p.contact_stiffness_ratio   = 1.5;
        Joint joint(p, dimension);
        joint.advance(-1e-7, Vector3d::Zero(), Vector3d(0, 0, turn));
        const Vector3d force = joint.answer.force;
        INFO("dimension " << dimension << ", turned by " << turn);
        for (int i = 0; i < 2200; ++i)
          {
            joint.advance(-1e-7, Vector3d(0, R / 1000, 0), Vector3d::Zero());
            REQUIRE(joint.answer.force.x() == Approx(force.x()).epsilon(1e-9));
            REQUIRE(joint.answer.released >= -1e-12 * joint.work);
          }
        CHECK(joint.column("replaced") == 1);
        CHECK(std::abs(joint.work - joint.stored() - joint.lost) < 1e-9 * joint.work);
        // Closed throughout it is referred to the distance at which it was made: as stiff as the joint was.
        joint.advance(-3e-7, Vector3d::Zero(), Vector3d::Zero());
        if (turn == 0)
          CHECK(joint.answer.force.x() == Approx(3 * force.x()).epsilon(1e-9));
      }
}

TEST_CASE("flat-jointed body conserves energy and momentum while it breaks, and turns with its axes", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    {
      dem::Packing            body = cluster::cubic_lattice(4, 3, dimension == 2 ? 1 : 3, R);
      dem::SpecimenParameters p    = in(dimension);
      p.step_factor                = 0.1;
      const auto run               = [&](const double angle, const double scale) {
        const Eigen::Matrix3d turn   = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
        dem::Packing          placed = body;
        for (auto &x : placed.centre)
          x = turn * x;
        dem::Specimen      specimen(placed, p, mortar());
        dem::UniformRandom random(4);
        for (std::size_t i = 0; i < body.size(); ++i)
          {
            Vector3d v = cluster::random_vector(random), w = 100 * cluster::random_vector(random);
            if (dimension == 2)
              v.z() = w.x() = w.y() = 0;
            specimen.set_velocity(i, turn * (scale * v), turn * (scale / 1e-3 * w));
          }
        specimen.advance(2000);
        return specimen;
      };
      const dem::Specimen breaking = run(0, 1e-1);
      CHECK(breaking.energy().released > 0.01 * breaking.energy().initial);
      CHECK(breaking.energy().balance_error() < 1e-2);
      const dem::Specimen straight = run(0, 1e-4), turned = run(0.9, 1e-4);
      CHECK(straight.energy().balance_error() < 2e-3);
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d::UnitZ()).toRotationMatrix();
      const auto            a = straight.particles(), b = turned.particles();
      double                difference = 0, size = 0;
      for (std::size_t i = 0; i < a.displacement.size(); ++i)
        {
          difference = std::max(difference, (turn * a.displacement[i] - b.displacement[i]).norm());
          size       = std::max(size, a.displacement[i].norm());
        }
      CHECK(difference < 1e-8 * size);
    }
}

TEST_CASE("flat-jointed body that breaks has the same bits with 1, 2 and 4 threads, and after a restart", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    {
      dem::Packing body =
        dimension == 3 ? cluster::random_cluster(11, 200, 0.7 * R, R) : cluster::cubic_lattice(20, 12, 1, R);
      dem::SpecimenParameters p = in(dimension);
      p.interaction_ratio       = 1.2;
      auto law                  = mortar();
      law.gapped_fraction = law.slit_fraction = 0.1;
      law.mean_gap                            = 1e-8;
      const auto made                         = [&] {
        dem::Specimen specimen(body, p, law);
        for (std::size_t i = 0; i < body.size(); ++i)
          {
            Vector3d v = 20.0 * body.centre[i] - 0.2 * Vector3d(body.centre[i].y(), 0, 0) / R;
            if (dimension == 2)
              v.z() = 0;
            specimen.set_velocity(i, v, Vector3d(0, 0, 10));
          }
        return specimen;
      };
      check_same_bits(made, 100, 300, 6);
    }
}
