// Linear contact and linear parallel bond against closed forms: doc/theory/parallel-bond.md, doc/theory/linear-contact.md; names T1 to T10 are those of its list.
#include "dem/laws/parallel_bond.h"

#include "clusters.h"
#include "dem/linear/linear_solver.h"
#include "dem/network/elastic_network.h"
#include "held_pair.h"
#include "same_bits.h"

#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  using namespace held_pair;

  dem::ParallelBondParameters mortar()
  {
    auto p           = bond_of_mortar<dem::ParallelBondParameters>();
    p.friction_angle = 20.7;
    return p;
  }
} // namespace

TEST_CASE("parallel bond in tension breaks at its strength and then carries nothing (T1)", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const double angle : {0.0, 0.7})
      check_tension(mortar(), dimension, angle);
  CHECK(mortar().tensile_strength * section(2) == Approx(580));
}

TEST_CASE("parallel bond in bending breaks at sigma_c I/R, without moment contribution never (T3)", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    {
      const auto   law    = mortar();
      const double moment = law.tensile_strength * second_moment(dimension) / R;
      const double angle  = law.tensile_strength * 2 * R / law.effective_modulus / R;
      HeldPair     pair(dimension, law, 0.4);
      pair.drive(0, 0, angle, 1000);
      const Peak peak = break_it(pair, 1100);
      CHECK(peak.moment <= moment * (1 + 1e-6));
      CHECK(peak.moment >= moment * (1 - 2e-3));
      CHECK(std::abs(peak.pull) < 1e-6 * law.tensile_strength * section(dimension));
      CHECK(pair.moment() == 0);

      auto blind                = law;
      blind.moment_contribution = 0;
      HeldPair unbreakable(dimension, blind);
      unbreakable.drive(0, 0, 3 * angle, 1000);
      unbreakable.specimen.advance(1000);
      CHECK(unbreakable.intact() == 1);
      CHECK(std::abs(unbreakable.moment()) == Approx(3 * moment).epsilon(2e-3));
    }
  CHECK(mortar().tensile_strength * second_moment(2) / R == Approx(0.193333).epsilon(1e-5));
}

TEST_CASE("parallel bond twisted breaks at the cohesion on its rim, J = 2 I", "[dem][laws]")
{
  const auto   law   = mortar();
  const double shear = law.effective_modulus / law.stiffness_ratio;
  const double angle = law.cohesion * 2 * R / shear / R, moment = law.cohesion * 2 * second_moment(3) / R;
  HeldPair     pair(3, law);
  const double time = 1000 * pair.specimen.time_step();
  pair.specimen.grips().set_velocity(0, Vector3d::Zero(), Vector3d(-0.5 * angle / time, 0, 0));
  pair.specimen.grips().set_velocity(1, Vector3d::Zero(), Vector3d(0.5 * angle / time, 0, 0));
  pair.specimen.advance(501);
  CHECK(std::abs(pair.specimen.grips().reaction_moment(1).x()) == Approx(0.5 * moment).epsilon(1e-6));
  break_it(pair, 600);
}

TEST_CASE("parallel bond in shear breaks at c - sigma tan phi and then slides at mu |F_n|", "[dem][laws]")
{
  for (const double pressure : {0.0, 1e6, 5e6})
    {
      const auto law = mortar();
      HeldPair   pair(2, law);
      // Press first: bond and linear contact share the approach, equally stiff.
      if (pressure > 0)
        {
          pair.drive(-pressure * 2 * R / law.effective_modulus, 0, 0, 1000);
          pair.specimen.advance(1000);
        }
      const double limit = law.cohesion + pressure * std::tan(law.friction_angle * pi / 180);
      pair.drive(0, 1.2 * limit * 2 * R / (law.effective_modulus / law.stiffness_ratio), 0, 2000);
      double peak = 0, normal = 0;
      for (int i = 0; i < 2000 && pair.intact() > 0; ++i)
        {
          pair.specimen.advance(1);
          if (pair.intact() > 0)
            {
              peak   = pair.specimen.links().shear_force.at(0);
              normal = pair.specimen.links().normal_force.at(0);
            }
        }
      REQUIRE(pair.intact() == 0);
      // Bond and linear contact share the normal force; beside the bond the contact holds what friction allows it.
      const double area = section(2), share = -0.5 * normal / area;
      CHECK(share == Approx(pressure).epsilon(5e-3).margin(1e3));
      CHECK(peak == Approx(area * (law.cohesion + share * std::tan(law.friction_angle * pi / 180) +
                                   law.friction_coefficient * share))
                      .epsilon(1.5e-3));
      pair.specimen.advance(1);
      if (pressure > 0)
        {
          const dem::LinkOutput links = pair.specimen.links();
          CHECK(links.normal_force.at(0) == Approx(0.5 * normal).epsilon(2e-3)); // it pushes on without a jump
          CHECK(links.shear_force.at(0) == Approx(-law.friction_coefficient * links.normal_force.at(0)).epsilon(1e-9));
          CHECK(links.kind.at(0) == dem::LinkOutput::contact);
        }
    }
}

TEST_CASE("parallel bond under eccentric tension breaks at sigma_c A/(1 + 3 e/R), in space 4 e/R (T6)", "[dem][laws]")
{
  auto law             = mortar();
  law.tensile_strength = 10e6;
  law.cohesion         = 1e9;
  const double e       = 0.5e-3;
  for (const int dimension : {2, 3})
    {
      const double factor = dimension == 2 ? 3 : 4, load = 10e6 * section(dimension) / (1 + factor * e / R);
      // M = P e: bend/opening = e A/I
      const double opening = load / section(dimension) * 2 * R / law.effective_modulus;
      HeldPair     pair(dimension, law);
      pair.drive(opening, 0, opening * e * section(dimension) / second_moment(dimension), 2000);
      const Peak peak = break_it(pair, 2100);
      CHECK(peak.pull <= load * (1 + 1e-4)); // the branch turns a little with the bond
      CHECK(peak.pull >= load * (1 - 2e-3));
      CHECK(peak.moment == Approx(peak.pull * e).epsilon(1e-4));
    }
}

TEST_CASE("static cantilever of parallel bonds deflects as n shear and bending springs in a row (T7)",
          "[dem][laws][statics]")
{
  auto law              = mortar();
  law.effective_modulus = 10e9;
  const int    n        = 10;
  const double F        = 1;
  dem::Packing chain    = cluster::cubic_lattice(n + 1, 1, 1, R);
  for (const int dimension : {2, 3})
    {
      dem::NetworkParameters links;
      links.dimension                   = dimension;
      links.interaction_ratio           = 1.1;
      links.thickness                   = thickness;
      const dem::ElasticNetwork network = dem::make_network(chain, links, law);
      REQUIRE(network.links.size() == std::size_t(n));
      std::vector<dem::HeldMotions> held(n + 1, 0);
      held[0] = dem::HeldMotions(~0u);
      const dem::StiffnessOperator stiffness(network, held);
      dem::Fields                  b(dem::motions * dem::load_lanes * (n + 1), 0.0), x(b);
      std::size_t                  tip = 0;
      while (stiffness.order()[tip] != n)
        ++tip;
      b[(dem::motions * tip + 1) * dem::load_lanes] = F;
      dem::LaneStrains none;
      none.fill(base::Vector6::Zero());
      const dem::SolverReport report = dem::solve_linear(stiffness, b, x, none, false, {});
      REQUIRE(report.converged);
      const double k_s        = law.effective_modulus / law.stiffness_ratio / (2 * R) * section(dimension);
      const double k_b        = law.effective_modulus / (2 * R) * second_moment(dimension);
      const double deflection = F * n / k_s + F * 4 * R * R * n * (4.0 * n * n - 1) / (12 * k_b);
      CHECK(x[(dem::motions * tip + 1) * dem::load_lanes] == Approx(deflection).epsilon(1e-8));
      if (dimension == 2)
        CHECK(deflection == Approx(4.0150e-7).epsilon(1e-4));
    }
}

TEST_CASE("two balls in linear contact part after pi sqrt(m_eff/k_n) with the energy they had (T9)", "[dem][laws]")
{
  dem::LinearContactParameters law;
  law.effective_modulus = 10e9;
  for (const int dimension : {2, 3})
    {
      double error[2];
      for (int refinement = 0; refinement < 2; ++refinement)
        {
          dem::SpecimenParameters p = in(dimension);
          p.step_factor             = refinement == 0 ? 0.04 : 0.01;
          dem::Specimen pair(cluster::pair_of_spheres(R, R, 2 * R + 1e-9), p, law);
          const double  v = 1e-3;
          pair.set_velocity(0, {v, 0, 0}, Vector3d::Zero());
          pair.set_velocity(1, {-v, 0, 0}, Vector3d::Zero());
          const double mass     = dimension == 2 ? 2500 * pi * R * R * thickness : 2500 * 4.0 / 3 * pi * R * R * R;
          const double k_n      = section(dimension) * law.effective_modulus / (2 * R);
          const double duration = pi * std::sqrt(mass / 2 / k_n);
          double       touched = -1, parted = -1;
          for (int i = 0; i < 4000 && parted < 0; ++i)
            {
              pair.advance(1);
              const std::size_t contacts = pair.counts().contacts;
              if (contacts > 0 && touched < 0)
                touched = pair.time();
              if (contacts == 0 && touched >= 0)
                parted = pair.time();
            }
          REQUIRE(parted > 0);
          CHECK(parted - touched == Approx(duration).margin(2.5 * pair.time_step()));
          const dem::EnergyAccount e    = pair.energy();
          error[refinement]             = std::abs(e.kinetic / e.initial - 1);
          const dem::ParticleOutput out = pair.particles();
          CHECK((out.velocity[0] + out.velocity[1]).norm() < 1e-12 * v);
        }
      CHECK(error[0] < 1e-3);
      CHECK(error[1] < 1e-4); // of second order in the step: the contact begins and ends within one
    }
}

TEST_CASE("local damping reduces the amplitude by sqrt((1 - D)/(1 + D)) per half cycle (T10)", "[dem][laws]")
{
  auto law             = mortar();
  law.tensile_strength = law.cohesion = 1e12;
  dem::SpecimenParameters p           = in(3);
  p.damping                           = 0.7;
  p.step_factor                       = 0.005;
  p.physics.rotations                 = false;
  dem::Specimen pair(cluster::pair_of_spheres(R, R, 2 * R), p, law);
  dem::Grip     foot;
  foot.particles  = {0};
  foot.prescribed = all;
  pair.grips().add(foot);
  pair.set_velocity(1, {0, 1e-3, 0}, Vector3d::Zero()); // across: the same stiffness both ways
  std::vector<double> extremes;
  double              before = 0, last = 0;
  for (int i = 0; i < 200000 && extremes.size() < 6; ++i)
    {
      pair.advance(1);
      const double now = pair.particles().displacement[1].y();
      if (i > 1 && (last - before) * (now - last) < 0)
        extremes.push_back(std::abs(last));
      before = last;
      last   = now;
    }
  REQUIRE(extremes.size() == 6);
  for (std::size_t i = 1; i < extremes.size(); ++i)
    CHECK(extremes[i] / extremes[i - 1] == Approx(std::sqrt(0.3 / 1.7)).epsilon(0.01));
}

TEST_CASE("parallel-bonded body conserves energy and momentum, and turns with its axes", "[dem][laws]")
{
  auto law             = mortar();
  law.tensile_strength = law.cohesion = 1e12;
  for (const int dimension : {2, 3})
    {
      dem::Packing            body = cluster::cubic_lattice(4, 3, dimension == 2 ? 1 : 3, R);
      dem::SpecimenParameters p    = in(dimension);
      p.step_factor                = 0.3;
      const auto run               = [&](const double angle) {
        const Eigen::Matrix3d turn   = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
        dem::Packing          placed = body;
        for (auto &x : placed.centre)
          x = turn * x;
        dem::Specimen      specimen(placed, p, law);
        dem::UniformRandom random(4);
        for (std::size_t i = 0; i < body.size(); ++i)
          {
            Vector3d v = cluster::random_vector(random), w = 100 * cluster::random_vector(random);
            if (dimension == 2)
              v.z() = w.x() = w.y() = 0;
            specimen.set_velocity(i, turn * (1e-3 * v), turn * w);
          }
        specimen.advance(2000);
        return specimen;
      };
      const dem::Specimen straight = run(0), turned = run(0.9);
      CHECK(straight.energy().balance_error() < 2e-3);
      CHECK(straight.energy().elastic > 0.005 * straight.energy().initial);
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

TEST_CASE("parallel-bonded body that breaks has the same bits with 1, 2 and 4 threads, and after a restart",
          "[dem][laws]")
{
  const dem::Packing      body = cluster::random_cluster(11, 200, 0.7 * R, R);
  dem::SpecimenParameters p    = cluster::bonded(1.2);
  const auto              made = [&] {
    dem::Specimen specimen(body, p, mortar());
    for (std::size_t i = 0; i < body.size(); ++i)
      specimen.set_velocity(i, 40.0 * body.centre[i], Vector3d(30, -20, 10));
    return specimen;
  };
  check_same_bits(made, 300, 300, 11);
}
