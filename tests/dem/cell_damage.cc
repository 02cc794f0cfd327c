#include "dem/measures/couple_stress.h"
#include "dem/measures/stress.h"
#include "dem/observation/specimen_damage.h"
#include "periodic_cell_fixture.h"

#include <catch2/catch.hpp>

using namespace periodic_fixture;

namespace
{
  /** A cell pulled along the first axis until many links have gone. */
  dem::Specimen pulled()
  {
    dem::Specimen           specimen(disordered(5, 4), concrete_specimen(), brittle_concrete());
    dem::CellTestParameters p;
    p.path = {strain_leg(2000 * specimen.time_step(), 4e-3 * base::Vector6::Unit(0))};
    dem::CellTest(specimen, p).advance(2000);
    return specimen;
  }
} // namespace

TEST_CASE("damage tensors count every link that was made, deleted ones with their last direction", "[dem][measures]")
{
  const std::size_t   made = dem::Specimen(disordered(5, 4), concrete_specimen(), brittle_concrete()).counts().links;
  const dem::Specimen specimen = pulled();
  const dem::Counts   counts   = specimen.counts();
  REQUIRE(counts.broken > 20);
  REQUIRE(counts.links > 20);
  const dem::CohesiveDamage all = dem::cohesive_damage(specimen.links());
  REQUIRE(all.links.size() == made);
  REQUIRE(counts.links + counts.broken == made);

  std::size_t gone = 0;
  double      sum  = 0;
  for (const auto &l : all.links)
    {
      CHECK(l.direction.norm() == Approx(1.0));
      CHECK((l.damage >= 0 && l.damage <= 1));
      gone += l.damage == 1 ? 1 : 0;
      sum += l.damage;
    }
  CHECK(gone >= counts.broken);
  const Eigen::Matrix3d even = dem::damage_tensor_even(all.links), fit = *dem::damage_tensor_fitted(all.links);
  CHECK(even.trace() / 3 == Approx(sum / static_cast<double>(made)).epsilon(1e-12)); // (6.10) of Stransky (2018)
  CHECK(fit(0, 0) > fit(1, 1) + 0.1);                                                // pulled along the first axis
  CHECK(fit(0, 0) > fit(2, 2) + 0.1);

  // The particles' tensors, weighted by their links, add up to that of the whole: each link has two ends.
  Eigen::Matrix3d weighted = Eigen::Matrix3d::Zero();
  for (const auto &p : dem::particle_damage(all.ends, all.links, counts.particles, dem::DamageFit::even))
    weighted += static_cast<double>(p.links) / (2.0 * static_cast<double>(made)) * p.tensor;
  CHECK((weighted - even).norm() < 1e-13);
}

TEST_CASE("in a damaged cell at rest no particle feels a moment and the couple stress vanishes", "[dem][measures]")
{
  // Without contact couples mu = 0 in equilibrium (doc/theory/stress-and-fabric.md, 2); underway it is not.
  dem::Specimen specimen = pulled();
  const auto    measure  = [&] {
    const auto                       links = specimen.links();
    const auto                       place = specimen.particles().position;
    std::vector<dem::ParticleMoment> moments;
    for (const auto &x : place)
      moments.push_back({x, {0, 0, 0}});
    for (std::size_t l = 0; l < links.load.size(); ++l)
      {
        const dem::LinkLoad &load = links.load[l];
        moments[links.ends[l][0]].moment += (load.contact - load.first).cross(load.force);
        moments[links.ends[l][1]].moment -= (load.contact - load.second()).cross(load.force);
      }
    const Eigen::Vector3d middle = 0.5 * specimen.cell().base * Eigen::Vector3d::Ones();
    return dem::periodic_couple_stress_moment(links.load, moments, middle).norm();
  };
  const double moving = measure();
  REQUIRE(relax(specimen, 1e-7) > 0);
  CHECK(measure() < 1e-4 * moving);
}
