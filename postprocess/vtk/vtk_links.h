#pragma once

#include "dem/observation/link_images.h"
#include "dem/specimen/rank_output.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
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

  /** Images that links of a periodic cell lead to; none: nothing is periodic. */
  using ImagesOfCell = std::optional<std::vector<dem::LinkImage>>;
  /** Number of each link's class; none: there are no classes. */
  using ClassesOfLinks = std::optional<std::vector<std::int32_t>>;

  /** The same of those that one of several ranks shows: a piece. Its points are the rank's particles, others' that links lead to, then images. */
  void write_vtk_links(const std::filesystem::path &path,
                       const dem::RankOutput       &shown,
                       double                       time,
                       const ImagesOfCell          &images,
                       const ClassesOfLinks        &classes);

  /**
   * Write the record (.pvtp) of the pieces, atomically.
   * @param like what one of the ranks shows, for the names of the fields  @param pieces files, relative to the record  @throws OutputError
   */
  void write_vtk_links_record(const std::filesystem::path    &path,
                              const dem::RankOutput          &like,
                              const ImagesOfCell             &images,
                              const ClassesOfLinks           &classes,
                              const std::vector<std::string> &pieces);
} // namespace postprocess
