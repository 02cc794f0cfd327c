#pragma once

#include "dem/ranks/bricks.h"
#include "dem/specimen/specimen.h"

namespace apps
{
  /** A cube of a face-centred cubic lattice of CPM links. @param cells along each edge, of four particles @param found_by as of dem::Specimen */
  dem::Specimen cube_of_lattice(int cells, dem::Ranks *found_by = nullptr);

  /** Its links alone, without a specimen: as many as memory holds at eight bytes each. */
  dem::LinkEnds links_of_cube(int cells);
} // namespace apps
