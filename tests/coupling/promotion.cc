// Elements that become particles where bonds inside them come near their damage (doc/theory/static-handshake.md, 4).
#include "base/errors.h"
#include "coupling/promotion/carried_motion.h"
#include "coupling/promotion/growing_regions.h"
#include "dem/laws/cpm.h"
#include "dem/packing/lattice.h"
#include "tests/dem/clusters.h"
#include "tests/fem/solid_fixture.h"

#include <catch2/catch.hpp>

#include <memory>
#include <optional>

using Eigen::Vector3d;

namespace
{
  constexpr double spacing = 0.01, elastic_strain = 1e-4;

  dem::CpmParameters brittle_row()
  {
    dem::CpmParameters p   = cluster::concrete();
    p.limit_elastic_strain = elastic_strain;
    p.relative_ductility   = 2;
    return p;
  }

  /** Six elements of one spacing in a row along x, with a particle in the middle of each. */
  struct Row
  {
    Row()
      : materials(brittle_row())
      , packing(dem::make_lattice(dem::Lattice::square, spacing / 2, {6, 1, 1}))
    {
      packing.periodic_cell.reset();
      for (std::size_t i = 0; i < packing.size(); ++i)
        packing.centre[i] = {(static_cast<double>(i) + 0.5) * spacing, 0.5 * spacing, 0};
      dem::NetworkParameters p;
      p.dimension         = 2;
      p.interaction_ratio = 1.05;
      p.thickness         = spacing;
      whole.emplace(dem::unloaded(dem::make_network(packing, p, materials)));
      bonds = std::make_unique<dem::DamagingLinks>(*whole, materials);
    }

    /** Particles start in the first element. */
    static coupling::GrowingRegions regions(const double threshold, const double reach)
    {
      const auto distance = [](const Vector3d &place) { return place.x() - spacing; };
      return {coupling::elements_of(fem::make_mesh<2>(box<2>({6 * spacing, spacing}, {6, 1}),
                                                      fem::ElementFamily::hypercube, MPI_COMM_SELF)),
              {{"core", distance, spacing, threshold, reach}}};
    }

    /** Particles in the solid from this one on; the others are awake. */
    coupling::PlaceMotions in_solid_from(const std::size_t first) const
    {
      coupling::PlaceMotions motions(packing.size());
      for (std::size_t i = first; i < packing.size(); ++i)
        {
          motions[i].emplace();
          motions[i]->element = packing.centre[i];
        }
      return motions;
    }

    /** The bond after a particle strained, and all beyond it moved along. */
    void strain(const std::size_t bond, const double strain)
    {
      dem::LoadedMotion motion(whole->held.size());
      for (std::size_t i = bond + 1; i < packing.size(); ++i)
        motion.particles(0, static_cast<Eigen::Index>(i)) = strain * spacing;
      bonds->evaluate(motion);
    }

    dem::LinkMaterials                  materials;
    dem::Packing                        packing;
    std::optional<dem::LoadedNetwork>   whole;
    std::unique_ptr<dem::DamagingLinks> bonds;
  };
} // namespace

TEST_CASE("An element joins the particles once a bond inside it comes near its damage, within its reach",
          "[coupling][promotion][volume]")
{
  Row                      row;
  coupling::GrowingRegions regions = Row::regions(0.5, 2.5 * spacing);
  CHECK(regions.growable() == std::vector<std::size_t>{2}); // wholly within the reach of the first
  const coupling::PlaceMotions in_solid = row.in_solid_from(1);
  row.strain(1, 0.49 * elastic_strain);
  CHECK_FALSE(regions.grow(*row.bonds, row.whole->network.links, in_solid));
  CHECK_FALSE(regions.has_grown());

  row.strain(1, 0.51 * elastic_strain); // between the second and the third element
  CHECK(regions.grow(*row.bonds, row.whole->network.links, in_solid));
  CHECK(regions.grown() == std::vector<std::size_t>{2});
  CHECK(regions.distance_from(0)({3.5 * spacing, 0, 0}) == Approx(0.5 * spacing));
  CHECK_FALSE(regions.grow(*row.bonds, row.whole->network.links, in_solid));

  coupling::GrowingRegions far_away = Row::regions(0.5, 2.5 * spacing);
  row.strain(4, elastic_strain); // beyond the reach
  CHECK_FALSE(far_away.grow(*row.bonds, row.whole->network.links, in_solid));
}

TEST_CASE("Elements beside what is held stay elements, and one without a particle cannot follow",
          "[coupling][promotion][volume]")
{
  const Row                row;
  coupling::GrowingRegions regions = Row::regions(0.5, 4.5 * spacing);
  CHECK(regions.growable() == std::vector<std::size_t>{4});
  CHECK_NOTHROW(regions.require_particles(row.in_solid_from(1)));
  CHECK_THROWS_WITH(regions.require_particles(row.in_solid_from(3)),
                    Catch::Contains("no particle of the specimen lies in the element around (0.015, 0.005, 0)"));
  regions.leave_out_around({Vector3d(6 * spacing, 0, 0)}); // the overlap would come to the end
  CHECK(regions.growable() == std::vector<std::size_t>{3});
}

TEST_CASE("After a promotion particles go on with their own motion, and those still in elements with that of the solid",
          "[coupling][promotion][volume]")
{
  const Row                      row;
  const std::vector<std::size_t> first = {0, 1}, all = {0, 1, 2, 3, 4, 5};
  dem::NetworkParameters         p;
  p.dimension         = 2;
  p.interaction_ratio = 1.05;
  p.thickness         = spacing;
  dem::Packing two    = row.packing;
  two.centre.resize(2);
  two.radius.resize(2);
  const dem::LoadedNetwork few = dem::unloaded(dem::make_network(two, p, row.materials));

  dem::LoadedMotion of_few(2);
  of_few.particles(0, 1) = 3e-6;
  of_few.particles(5, 1) = 2e-4;
  of_few.loads[0]        = 0.7;
  coupling::PlaceMotions in_solid(6);
  for (std::size_t i = 2; i < 6; ++i)
    {
      in_solid[i].emplace();
      in_solid[i]->displacement.x() = 1e-6 * static_cast<double>(i);
      in_solid[i]->rotation.z()     = -1e-5;
    }
  const coupling::AwakeParticles before{few, first}, now{*row.whole, all};
  const dem::LoadedMotion        whole = coupling::motion_of_all(*row.whole, before, of_few, in_solid);
  CHECK(whole.particles.col(1) == of_few.particles.col(1));
  CHECK(whole.particles.col(4) == in_solid[4]->motion());

  coupling::PlaceMotions still(6);
  still[5].emplace(); // has not become free
  const dem::LoadedMotion start = coupling::start_from({before, of_few, whole, in_solid, {}}, now, still);
  CHECK(start.loads[0] == 0.7);
  for (const int i : {0, 1})
    CHECK(start.particles.col(i) == of_few.particles.col(i));
  for (const int i : {2, 3, 4})
    CHECK(start.particles(0, i) == 1e-6 * i);
  CHECK(start.particles(0, 5) == in_solid[5]->displacement.x());
  CHECK(start.particles(5, 3) == -1e-5);

  const auto known = coupling::links_before(before, now);
  REQUIRE(known.size() == 5);
  CHECK(known[0] == std::optional<std::size_t>(0));
  for (std::size_t l = 1; l < 5; ++l)
    CHECK_FALSE(known[l].has_value());
}
