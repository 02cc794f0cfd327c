#pragma once

#include "dem/specimen/results.h"
#include "fem/solid/solid.h"

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /**
   * A section of the solid through the plane of loading with the particles that it meets; in space, where it meets none, through the
   * particle that is nearest to it. @return what is missing, "" if nothing
   */
  template <int dim>
  std::string draw_solid_and_particles(const fem::Solid<dim>       &solid,
                                       const fem::Vector           &displacement,
                                       const dem::ParticleOutput   &particles,
                                       const std::filesystem::path &file,
                                       const std::string           &title);

  /** Particles, and links of theirs that are damaged or broken. */
  struct DrawnCracks
  {
    const dem::ParticleOutput      &particles;
    const dem::LinkOutput          &links;
    const std::vector<std::string> &material_names;
    std::vector<std::string>        link_classes; ///< empty: cracks are all alike
  };

  /** Particles with their cracks, and the solid's outlines, both with magnified displacements. @return likewise */
  template <int dim>
  std::string draw_cracks_in_solid(const fem::Solid<dim>       &solid,
                                   const fem::Vector           &displacement,
                                   const DrawnCracks           &cracks,
                                   const std::filesystem::path &file,
                                   const std::string           &title);
} // namespace apps
