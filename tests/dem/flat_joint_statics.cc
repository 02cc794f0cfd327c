// Flat joints and other bonds in statics against closed forms: doc/theory/flat-joint.md; names T7 and T8 are those of its list.
#include "clusters.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/flat_joint.h"
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

TEST_CASE("static cantilever of flat joints deflects as n shear and bending springs in a row (T7)",
          "[dem][laws][statics]")
{
  const int    n     = 10;
  const double F     = 1;
  dem::Packing chain = cluster::cubic_lattice(n + 1, 1, 1, R);
  for (const int elements : {1, 3, 8})
    {
      auto law              = mortar(elements);
      law.effective_modulus = 10e9;
      dem::NetworkParameters links;
      links.dimension                       = 2;
      links.interaction_ratio               = 1.1;
      links.thickness                       = thickness;
      const dem::ElasticNetwork     network = dem::make_network(chain, links, law);
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
      REQUIRE(dem::solve_linear(stiffness, b, x, none, false, {}).converged);
      CHECK(x[(dem::motions * tip + 1) * dem::load_lanes] == Approx(4.0150e-7).epsilon(1e-4));
    }
}

TEST_CASE("static solver pulls bonds to their strength, and past it", "[dem][laws][statics]")
{
  const auto peak_of = [](const dem::LinkMaterials &law, const double failure) {
    dem::NetworkParameters links;
    links.interaction_ratio     = 1.1;
    dem::ElasticNetwork network = dem::make_network(cluster::pair_of_spheres(R, R, 2 * R), links, law);
    dem::GripPair       grips;
    grips.axis                        = 0;
    grips.layers.low                  = {0};
    grips.layers.high                 = {1};
    grips.layers.high_face            = 2 * R;
    grips.layers.distance             = 2 * R;
    grips.layers.gauge_length         = 2 * R;
    grips.layers.section              = section(3);
    grips.spin_blocked                = true;
    const dem::LoadedNetwork   loaded = dem::load_grips(std::move(network), grips);
    dem::QuasiStaticParameters p;
    p.strain_step = failure / 100;
    p.end_strain  = 2 * failure;
    p.tolerance   = 1e-9;
    dem::QuasiStaticPath path(loaded, law, p);
    while (!path.finished())
      path.advance();
    CHECK(path.points().back().stress[0] == Approx(0).margin(1e-6));
    CHECK(path.points().back().damage == Approx(0.5 * failure * failure * 10.38e9 * section(3) * 2 * R).epsilon(0.03));
    double peak = 0;
    for (const dem::QuasiStaticPoint &point : path.points())
      peak = std::max(peak, point.stress[0]);
    return peak;
  };
  const auto                  joint = mortar();
  const double                limit = joint.tensile_strength, failure = limit / joint.effective_modulus;
  dem::ParallelBondParameters cement;
  cement.effective_modulus = joint.effective_modulus;
  cement.tensile_strength  = limit;
  cement.cohesion          = 1e9;
  dem::ContactBondParameters glue;
  glue.effective_modulus = joint.effective_modulus;
  glue.tensile_strength  = limit;
  glue.cohesion          = 1e9;
  for (const dem::LinkMaterials &law :
       {dem::LinkMaterials(joint), dem::LinkMaterials(cement), dem::LinkMaterials(glue)})
    CHECK(peak_of(law, failure) == Approx(limit).epsilon(0.011));
}

TEST_CASE("static path of a chain goes on when the chain has broken in two and bears nothing any more",
          "[dem][laws][statics]")
{
  const int  n         = 7;
  const auto points_of = [](const dem::LinkMaterials &law, const double failure) {
    dem::Packing chain = cluster::cubic_lattice(n, 1, 1, R);
    for (std::size_t i = 1; i < n; i += 2) // so that what is left of forces after the break is rounding, not zero
      chain.centre[i].y() += 0.05 * R;
    chain.radius[3] = 0.9 * R; // here it breaks
    dem::NetworkParameters links;
    links.interaction_ratio = 1.2;
    dem::GripPair grips;
    grips.axis                        = 0;
    grips.layers.low                  = {0};
    grips.layers.high                 = {n - 1};
    grips.layers.high_face            = 2 * R * (n - 1);
    grips.layers.distance             = 2 * R * (n - 1);
    grips.layers.gauge_length         = 2 * R * (n - 1);
    grips.layers.section              = section(3);
    grips.lateral_blocked             = true;
    grips.spin_blocked                = true;
    const dem::LoadedNetwork   loaded = dem::load_grips(dem::make_network(chain, links, law), grips);
    dem::QuasiStaticParameters p;
    p.strain_step = failure / 20;
    p.end_strain  = 3 * failure;
    p.end_stress  = 0;
    dem::QuasiStaticPath path(loaded, law, p);
    while (!path.finished())
      path.advance();
    return path.points();
  };
  const auto                  joint   = mortar();
  const double                failure = joint.tensile_strength / joint.effective_modulus;
  dem::ParallelBondParameters cement;
  cement.effective_modulus = joint.effective_modulus;
  cement.tensile_strength  = joint.tensile_strength;
  cement.cohesion          = 1e9;
  for (const dem::LinkMaterials &law : {dem::LinkMaterials(joint), dem::LinkMaterials(cement)})
    {
      const auto points = points_of(law, failure);
      double     peak   = 0;
      for (const dem::QuasiStaticPoint &point : points)
        peak = std::max(peak, point.stress[0]);
      CHECK(peak > 0.5 * joint.tensile_strength);
      CHECK(std::abs(points.back().stress[0]) < 1e-6 * peak);
      CHECK(points.back().balance_error() < 0.05);
    }
}

TEST_CASE("hexagonal crystal of bonds has E = 2 sqrt(3) k_n (k_n + k_s)/(3 k_n + k_s) (T8)", "[dem][laws][statics]")
{
  const auto check = [](const dem::LinkMaterials &law, const double ratio, const double E, const double nu) {
    dem::NetworkParameters links;
    links.dimension             = 2;
    links.interaction_ratio     = 1.1;
    links.thickness             = thickness;
    const dem::Packing  crystal = dem::make_lattice(dem::Lattice::hexagonal, R, {3, 2, 1});
    const base::Matrix6 D       = dem::relaxed_stiffness(dem::make_network(crystal, links, law)).stiffness;
    INFO("ratio " << ratio);
    CHECK(D(0, 0) - D(0, 1) * D(0, 1) / D(1, 1) == Approx(E).epsilon(1e-6));
    CHECK(D(0, 1) / D(1, 1) == Approx(nu).epsilon(1e-5).margin(1e-9));
  };
  for (const auto &[ratio, E, nu] : {std::array<double, 3>{2.5, 1.426395, 0.176471}, {1, std::sqrt(3.0), 0}})
    {
      auto joint            = mortar();
      joint.stiffness_ratio = ratio;
      dem::ParallelBondParameters p;
      p.effective_modulus = joint.effective_modulus;
      p.stiffness_ratio   = ratio;
      p.tensile_strength = p.cohesion = 1e6;
      dem::ContactBondParameters glue;
      glue.effective_modulus = joint.effective_modulus;
      glue.stiffness_ratio   = ratio;
      glue.tensile_strength = glue.cohesion = 1e6;
      for (const dem::LinkMaterials &law : {dem::LinkMaterials(joint), dem::LinkMaterials(p), dem::LinkMaterials(glue)})
        check(law, ratio, E * joint.effective_modulus, nu);
    }
}
