#include "dem/observation/link_images.h"

#include "periodic_cell_fixture.h"

#include <catch2/catch.hpp>

using namespace periodic_fixture;

namespace
{
  /** How far the ends of a link were apart when it was bonded, by its image. */
  Eigen::Vector3d
  bonded_branch(const dem::ParticleOutput &p, const dem::LinkOutput &links, const dem::LinkImage &image, std::size_t l)
  {
    const auto [i, j] = links.ends[l];
    return p.position[j] - p.displacement[j] + image.at_start - (p.position[i] - p.displacement[i]);
  }
} // namespace

TEST_CASE("links of a cell that is torn apart are seen at the images that they join, before and after they broke",
          "[dem][periodic]")
{
  const dem::Packing packing = disordered(4, 3);
  dem::Specimen      specimen(packing, concrete_specimen(), brittle_concrete());
  const double       reach = 1.4 * 2e-3, edge = packing.periodic_cell->x();
  const std::size_t  bonded  = specimen.counts().links;
  bool               crossed = false;
  specimen.set_velocity_gradient(Eigen::Vector3d(60, -5, 0).asDiagonal());
  for (int stage = 0; stage < 4; ++stage)
    {
      specimen.advance(1500);
      const dem::ParticleOutput p      = specimen.particles();
      const dem::LinkOutput     links  = specimen.links();
      const auto                images = dem::link_images(specimen, links, p);
      const dem::CellState      cell   = specimen.cell();
      REQUIRE(images.size() == links.ends.size());
      std::size_t bonds = 0;
      for (std::size_t l = 0; l < images.size(); ++l)
        {
          // A lattice vector: whole numbers of the edges, moved with the cell.
          const Eigen::Vector3d k = images[l].at_start / edge;
          CHECK((k - k.array().round().matrix()).norm() < 1e-9);
          CHECK((cell.base * k - images[l].now).norm() < 1e-9 * edge);
          crossed |= images[l].is_other();
          const auto [i, j] = links.ends[l];
          if (links.kind[l] == dem::LinkOutput::contact)
            {
              CHECK((p.position[j] + images[l].now - p.position[i] - links.load[l].branch).norm() < 1e-2 * reach);
              continue;
            }
          ++bonds;
          CHECK(bonded_branch(p, links, images[l], l).norm() < reach); // as it was made
        }
      CHECK(bonds == bonded);
    }
  CHECK(crossed);
  CHECK(specimen.counts().broken > 0);
}

TEST_CASE("links of a free specimen lead to no images", "[dem]")
{
  dem::SpecimenParameters parameters = concrete_specimen();
  parameters.physics.periodic        = false;
  const dem::Specimen specimen(disordered(3, 1), parameters, brittle_concrete());
  CHECK(dem::link_images(specimen, specimen.links(), specimen.particles()).empty());
}
