// Particles inside a solid whose linear systems are solved by iteration: against factors, and by several ranks with the same bits.
#include "coupling/volume/static_handshake.h"
#include "dem/laws/cpm.h"
#include "dem/statics/quasi_static_path.h"
#include "tests/coupling/random_cell.h"
#include "tests/dem/iterated_paths.h"
#include "tests/fem/solid_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace iterated_paths;
using Eigen::Vector3d;

namespace
{
  constexpr double spacing = 0.01, modulus = 25e9, across = 4 * spacing;
  constexpr double particles_to = 12 * spacing, overlap_width = 4 * spacing, end = 22 * spacing;

  dem::CpmParameters bonds_of_concrete()
  {
    dem::CpmParameters p;
    p.normal_modulus       = modulus;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = 10;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  coupling::Overlap overlap()
  {
    return {[](const Vector3d &place) { return place.x() - particles_to; }, overlap_width};
  }

  std::unique_ptr<fem::Solid<3>> elements(const bool shared)
  {
    const dealii::Point<3>    low(particles_to, 0, 0), high(end, across, across);
    fem::SolidOptions         options;
    std::vector<unsigned int> divisions = {5, 2, 2};
    if (shared)
      options.share = [](const std::array<double, 3> &place) { return overlap().of_solid(Vector3d(place.data())); };
    auto made = std::make_unique<fem::Solid<3>>(
      fem::make_mesh<3>(box<3>(low, high, divisions), fem::ElementFamily::hypercube, MPI_COMM_SELF), options);
    made->assign("0", fem::make_points(elastic(0.8 * modulus, 0.2), fem::Plane::strain));
    fem::Loads<3> loads;
    loads.may_move_freely = true;
    for (unsigned int c = 0; c < 3; ++c)
      loads.displacements.push_back(
        {"1", c, [c](const dealii::Point<3> &, const double t) { return c == 0 ? t : 0.0; }});
    made->set_loads(loads);
    return made;
  }

  /** A bar of spheres without order, held at one end, that goes over into elements, whose far end is pulled. */
  struct Bar
  {
    explicit Bar(coupling::VolumeCouplingParameters method)
      : solid(elements(method.method == coupling::VolumeMethod::multipliers))
    {
      method.name    = "bar";
      method.overlap = overlap();
      dem::NetworkParameters links;
      links.interaction_ratio = random_cell::interaction_ratio;
      const dem::Packing packing =
        random_cell::fill<3>(random_cell::make<3>(spacing), particles_to + overlap_width, across);
      dem::LoadedNetwork particles = dem::unloaded(dem::make_network(packing, links, bonds_of_concrete()));
      for (std::size_t i = 0; i < packing.size(); ++i)
        for (int c = 0; c < 3 && packing.centre[i].x() < spacing; ++c)
          dem::drive(particles, {i}, c, 0);
      both = std::make_unique<coupling::StaticHandshake<3>>(std::move(particles), *solid, std::vector{method});
    }

    const dem::LoadedNetwork &network() const { return both->network(); }

    std::unique_ptr<fem::Solid<3>>                solid;
    std::unique_ptr<coupling::StaticHandshake<3>> both;
  };

  coupling::VolumeCouplingParameters method_of(const std::string &name)
  {
    coupling::VolumeCouplingParameters p;
    if (name == "constrained")
      p.method = coupling::VolumeMethod::constrained;
    if (name == "strict")
      p.compatibility = coupling::Compatibility::strict;
    return p;
  }

  dem::QuasiStaticParameters pulled(const dem::SolverMethod method, const double end_strain = 4e-5)
  {
    dem::QuasiStaticParameters p;
    p.strain_step = 5e-6;
    p.end_strain  = end_strain;
    p.solver      = method;
    return p;
  }

  double largest_force(const std::vector<dem::QuasiStaticPoint> &points)
  {
    double largest = 0;
    for (const dem::QuasiStaticPoint &p : points)
      largest = std::max(largest, std::fabs(p.stress[0]));
    return largest;
  }
} // namespace

TEST_CASE("static handshake: particles that follow joints keep the ties, whatever these are",
          "[coupling][volume][statics]")
{
  const std::string name = GENERATE("coarse", "strict", "constrained");
  INFO(name);
  const Bar        bar(method_of(name));
  const dem::Ties &ties = *bar.network().ties;
  REQUIRE(ties.common_motions().cols() > 0);
  CHECK(ties.is_led() == (name != "coarse"));
  CHECK((ties.rows() * ties.common_motions()).norm() < 1e-13 * ties.common_motions().norm());
}

TEST_CASE("iterated handshake: from each point of a path by factors it finds the next one, whatever the ties",
          "[coupling][volume][statics][ranks][slow]")
{
  omp_set_num_threads(1);
  const std::string name = GENERATE("coarse", "strict", "constrained");
  INFO(name);
  const Bar            bar(method_of(name));
  dem::QuasiStaticPath factors(bar.network(), bonds_of_concrete(), pulled(dem::SolverMethod::direct)),
    iterated(bar.network(), bonds_of_concrete(), pulled(dem::SolverMethod::iterative));
  double furthest = 0;
  while (!factors.finished())
    {
      INFO("point " << factors.points().size());
      const dem::QuasiStaticPoint &expected = factors.advance(), &found = iterated.advance();
      CHECK(found.control == expected.control);
      CHECK(found.residual <= 1e-7);
      furthest = std::max(furthest, std::fabs(found.stress[0] - expected.stress[0]));
      go_on_from(iterated, factors);
    }
  REQUIRE(factors.points().size() > 20);
  CHECK(factors.points().back().mean_damage > 0);
  CHECK(furthest < 1e-6 * largest_force(factors.points()));
}

TEST_CASE("iterated handshake: every number has the bits of one rank", "[coupling][volume][statics][ranks][slow]")
{
  const std::string name = GENERATE("coarse", "strict", "constrained");
  INFO(name);
  const Bar bar(method_of(name));
  same_on_ranks(bar.network(), bonds_of_concrete(), pulled(dem::SolverMethod::iterative, 1.5e-5), {2, 3});
}
