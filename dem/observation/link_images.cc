#include "dem/observation/link_images.h"

#include "dem/specimen/observation.h"

#include <Eigen/LU>

namespace dem
{
  std::vector<LinkImage> link_images(const LinkOutput      &links,
                                     const ParticleOutput  &particles,
                                     const Eigen::Matrix3d &base,
                                     const Eigen::Matrix3d &base_at_start)
  {
    const Eigen::Matrix3d  cells_now = base.inverse(), cells_at_start = base_at_start.inverse();
    std::vector<LinkImage> images;
    images.reserve(links.ends.size());
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      {
        const auto [i, j]            = links.ends[l];
        const bool            is_met = links.kind[l] == LinkOutput::contact;
        const auto           &u      = particles.displacement;
        const Eigen::Vector3d branch = links.load[l].branch, apart = particles.position[i] - particles.position[j];
        // Of a bond: places when it was made, so that only what it was stretched by until now, or until it broke, is not cell.
        const Eigen::Vector3d k = (is_met ? Eigen::Vector3d(cells_now * (apart + branch)) :
                                            Eigen::Vector3d(cells_at_start * (apart - (u[i] - u[j]) + branch)))
                                    .array()
                                    .round();
        images.push_back({base * k, base_at_start * k});
      }
    return images;
  }

  std::vector<LinkImage>
  link_images(const ObservedSpecimen &specimen, const LinkOutput &links, const ParticleOutput &particles)
  {
    if (!specimen.parameters().physics.periodic)
      return {};
    const CellState cell = specimen.cell();
    return link_images(links, particles, cell.base, cell.deformation.inverse() * cell.base);
  }
} // namespace dem
