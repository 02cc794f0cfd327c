// Stiffness of lattices and small cells against closed forms and reference cells, doc/theory/homogenisation.md.
#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/packing/lattice.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace homogenisation_fixture;

namespace
{
  /** Cubic symmetry: D11, D12, D66; `plane` keeps 11, 22, 12 only. */
  Matrix6 cubic(const double d11, const double d12, const double d66, const bool plane = false)
  {
    Matrix6   D       = Matrix6::Zero();
    const int normals = plane ? 2 : 3;
    for (int i = 0; i < normals; ++i)
      for (int j = 0; j < normals; ++j)
        D(i, j) = i == j ? d11 : d12;
    for (int i = plane ? 5 : 3; i < 6; ++i)
      D(i, i) = d66;
    return D;
  }

  void require_exact(const dem::ElasticNetwork &network, const Matrix6 &exact, const std::size_t floaters = 0)
  {
    // Sums of at most a few hundred equal terms: rounding below 1e-13.
    CHECK(relative_difference(dem::affine_stiffness(network), exact) < 1e-12);
    for (const auto method : {dem::SolverMethod::iterative, dem::SolverMethod::direct})
      {
        dem::SolverParameters solver;
        solver.method    = method;
        const auto found = dem::relaxed_stiffness(network, solver);
        CHECK(found.solver.converged);
        CHECK(dem::floaters(found.solver.mechanisms).size() == floaters);
        CHECK(relative_difference(found.stiffness, exact) < 1e-12);
      }
  }
} // namespace

TEST_CASE("lattices: affine and relaxed stiffness are the exact values", "[dem][homogenisation]")
{
  const double E = 25e9, ratio = 0.3, G = ratio * E, r = 2e-3;
  const auto   p = links(1.05, ratio, E);
  SECTION("simple cubic")
  {
    require_exact(dem::make_network(dem::make_lattice(dem::Lattice::simple_cubic, r, {3, 4, 3}), p),
                  cubic(M_PI / 4 * E, 0, M_PI / 8 * G));
  }
  SECTION("face centred cubic")
  {
    const double a = M_PI / (2 * std::sqrt(2.0));
    require_exact(dem::make_network(dem::make_lattice(dem::Lattice::face_centred_cubic, r, {2, 2, 3}), p),
                  cubic(a * (E + G), a / 2 * (E - G), a / 2 * (E + G)));
  }
  SECTION("body centred cubic")
  {
    // Four links per sphere along (+-1, +-1, +-1)/sqrt(3): n_i^2 = 1/3, n_i^2 n_j^2 = 1/9; sum L A/V = 3 sqrt(3) pi/4.
    const double s = 3 * std::sqrt(3.0) / 4 * M_PI;
    // The two sublattices may turn against each other like gears: phi_J + phi_K = 0 on every link, a true mechanism.
    const std::size_t all = 24;
    require_exact(dem::make_network(dem::make_lattice(dem::Lattice::body_centred_cubic, r, {3, 2, 2}), p),
                  cubic(s * (E + 2 * G) / 9, s * (E - G) / 9, s * (E / 9 + G / 18)), all);
  }
  SECTION("square")
  {
    const auto plane = plane_links(1.05, ratio, 0.01, E);
    require_exact(dem::make_network(dem::make_lattice(dem::Lattice::square, r, {3, 4, 1}), plane),
                  cubic(E, 0, G / 2, true));
  }
  SECTION("hexagonal")
  {
    const double t = 0.01, S = 3 * 2 * r * 2 * r * t / (2 * std::sqrt(3.0) * r * r * t);
    const double lambda = S / 8 * (E - G), mu = S / 8 * (E + G);
    require_exact(
      dem::make_network(dem::make_lattice(dem::Lattice::hexagonal, r, {3, 2, 1}), plane_links(1.05, ratio, t, E)),
      cubic(lambda + 2 * mu, lambda, mu, true));
  }
}

TEST_CASE("lattices: a hexagonal sheet with circular links has the published moduli", "[dem][homogenisation]")
{
  // r = 5 mm, t = 10 mm, A = pi r^2 instead of 2 r t: E2 = 1.0464227e9 Pa, nu2 = 0.2307692, S2 = 2.720699.
  const double r = 5e-3, t = 0.01, circular = M_PI * r * r / (2 * r * t);
  const auto   network = dem::make_network(dem::make_lattice(dem::Lattice::hexagonal, r, {2, 2, 1}),
                                           plane_links(1.05, 0.25, t, circular * 1e9));
  const auto   m       = dem::isotropy_measures(dem::relaxed_stiffness(network).stiffness, 2);
  CHECK(m.mean.young == Approx(1.0464227e9).epsilon(1e-7)); // eight digits printed
  CHECK(m.mean.poisson == Approx(0.2307692).epsilon(1e-6)); // seven digits printed
  CHECK(m.off < 1e-12);
  CHECK(circular * dem::link_statistics(network).length_area == Approx(2.720699).epsilon(1e-6));
  const auto closed = dem::closed_form(dem::link_statistics(network), circular * 1e9, 0.25);
  CHECK(closed.young == Approx(1.0464227e9).epsilon(1e-7));
  CHECK(closed.poisson == Approx(0.2307692).epsilon(1e-6));
}

TEST_CASE("closed form: moduli and stiffness are those of evenly spread directions", "[dem][homogenisation]")
{
  // Directions of an icosahedron are a spherical 5-design: fourth-order means over its six axes are exactly isotropic.
  const double        golden = (1 + std::sqrt(5.0)) / 2, ratio = 0.35;
  dem::ElasticNetwork network;
  network.volume = 1.7;
  network.centre.resize(1);
  for (const Eigen::Vector3d &axis :
       {Eigen::Vector3d(0, 1, golden), Eigen::Vector3d(0, 1, -golden), Eigen::Vector3d(1, golden, 0),
        Eigen::Vector3d(1, -golden, 0), Eigen::Vector3d(golden, 0, 1), Eigen::Vector3d(-golden, 0, 1)})
    {
      dem::ElasticLink link{};
      link.direction           = axis.normalized();
      link.branch              = 0.9 * link.direction;
      link.area                = 0.4;
      const Eigen::Matrix3d nn = link.direction * link.direction.transpose();
      link.stiffness           = link.area / 0.9 * (nn + ratio * (Eigen::Matrix3d::Identity() - nn));
      network.links.push_back(link);
    }
  const Matrix6 affine     = dem::affine_stiffness(network);
  const auto    statistics = dem::link_statistics(network);
  CHECK(relative_difference(dem::closed_form_stiffness(statistics, 1, ratio), affine) < 1e-14);
  const auto constants = dem::closed_form(statistics, 1, ratio);
  const auto measured  = dem::isotropy_measures(affine, 3);
  CHECK(constants.young == Approx(measured.mean.young).epsilon(1e-13));
  CHECK(constants.poisson == Approx(measured.mean.poisson).epsilon(1e-13));
}

TEST_CASE("cell of eight spheres: every number of an independent solution", "[dem][homogenisation]")
{
  const auto network = dem::make_network(eight_particles(), links(1.5, 0.2));
  CHECK(network.links.size() == 37);
  const auto statistics = dem::link_statistics(network);
  CHECK(statistics.density() == Approx(1.012725).epsilon(1e-6));

  Matrix6 D;
  D << 0.6516972, 0.1656204, 0.1871454, -0.004127942, -0.07683566, -0.01991760, //
    0.1656204, 0.5962287, 0.1309957, 0.02745349, -0.01489825, -0.009256186,     //
    0.1871454, 0.1309957, 0.6422239, 0.01182032, -0.04931502, -0.002428461,     //
    -0.004127942, 0.02745349, 0.01182032, 0.1878680, -0.01971590, -0.03942749,  //
    -0.07683566, -0.01489825, -0.04931502, -0.01971590, 0.2281245, 0.01970901,  //
    -0.01991760, -0.009256186, -0.002428461, -0.03942749, 0.01970901, 0.2291952;
  const auto relaxed = dem::relaxed_stiffness(network);
  CHECK((relaxed.stiffness - D).cwiseAbs().maxCoeff() < 0.6e-7); // seven digits behind the point printed
  CHECK(relaxed.solver.mechanisms.empty());

  const auto m = dem::isotropy_measures(relaxed.stiffness, 3);
  CHECK(m.mean.young == Approx(0.552921).margin(0.6e-6)); // six digits, below five: five, behind the point printed
  CHECK(m.mean.poisson == Approx(0.199718).margin(0.6e-6));
  CHECK(m.young_spread == Approx(0.03433).margin(0.6e-5));
  CHECK(m.poisson_spread == Approx(0.05879).margin(0.6e-5));
  CHECK(m.shear_spread == Approx(0.22704).margin(0.6e-5));
  CHECK(m.off == Approx(0.13896).margin(0.6e-5));

  const auto affine = dem::isotropy_measures(dem::affine_stiffness(network), 3);
  CHECK(affine.mean.young == Approx(0.624201).margin(0.6e-6));
  CHECK(affine.mean.poisson == Approx(0.181831).margin(0.6e-6));

  const auto closed = dem::closed_form(statistics, 1, 0.2);
  CHECK(closed.young == Approx(0.626925).margin(0.6e-6));
  CHECK(closed.poisson == Approx(0.190476).margin(0.6e-6));

  auto blocked      = links(1.5, 0.2);
  blocked.rotations = false;
  const auto held =
    dem::isotropy_measures(dem::relaxed_stiffness(dem::make_network(eight_particles(), blocked)).stiffness, 3);
  CHECK(held.mean.young == Approx(0.579927).margin(0.6e-6));
  CHECK(held.mean.poisson == Approx(0.186597).margin(0.6e-6));
}

TEST_CASE("cell of six discs: every number of an independent solution", "[dem][homogenisation]")
{
  const auto network = dem::make_network(six_discs(), plane_links(1.25, 0.2, 1.0));
  CHECK(network.links.size() == 14);
  CHECK(dem::link_statistics(network).length_area == Approx(2.6286577).epsilon(1e-7));

  const auto require_plane = [](const Matrix6 &D, const Eigen::Matrix3d &expected) {
    const int at[] = {0, 1, 5};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        CHECK(D(at[i], at[j]) == Approx(expected(i, j)).margin(0.6e-6)); // six digits behind the point printed
    for (int i = 2; i < 5; ++i)
      CHECK(D.row(i).norm() == 0);
  };
  Eigen::Matrix3d relaxed, affine;
  relaxed << 0.829303, 0.298229, -0.033431, 0.298229, 0.968785, -0.022261, -0.033431, -0.022261, 0.259156;
  affine << 1.079166, 0.277155, -0.038675, 0.277155, 0.995181, -0.010888, -0.038675, -0.010888, 0.408588;
  for (const auto method : {dem::SolverMethod::iterative, dem::SolverMethod::direct})
    {
      dem::SolverParameters solver;
      solver.method = method;
      require_plane(dem::relaxed_stiffness(network, solver).stiffness, relaxed);
    }
  require_plane(dem::affine_stiffness(network), affine);

  auto blocked       = plane_links(1.25, 0.2, 1.0);
  blocked.rotations  = false;
  const Matrix6 held = dem::relaxed_stiffness(dem::make_network(six_discs(), blocked)).stiffness;
  CHECK(held(0, 0) == Approx(0.830159).margin(0.6e-6));
  CHECK(held(1, 1) == Approx(0.969424).margin(0.6e-6));
  CHECK(held(5, 5) == Approx(0.293181).margin(0.6e-6));
}
