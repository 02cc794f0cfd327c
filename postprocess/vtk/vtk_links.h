#pragma once

#include "dem/observation/link_images.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace postprocess
{
  /**
   * Write the links as lines between the present particle positions, in a VTK XML file (.vtp), atomically. A link to a periodic
   * image goes from its particle to that image, not across the cell.
   *
   * Fields: the kind "links" of field_files(). The points are all particles in the packing's order, also when there is no link at
   * all, then the images.
   *
   * @param images that links lead to; empty: nothing is periodic
   * @param classes number of each link's class; empty: there are none
   * @throws std::invalid_argument if columns differ in length or a link ends at no particle; OutputError.
   */
  void write_vtk_links(const std::filesystem::path       &path,
                       const dem::LinkOutput             &links,
                       const dem::ParticleOutput         &particles,
                       double                             time,
                       const std::vector<dem::LinkImage> &images  = {},
                       const std::vector<std::int32_t>   &classes = {});
} // namespace postprocess
