#pragma once

#include "dem/loading/link_motion.h"
#include "postprocess/files/csv_table.h"

namespace apps
{
  /**
   * Drive one link along a table of strains (normal_strain, shear_strain_1, shear_strain_2), or of displacements and forces by the names of
   * dem::link_motion_names; what has no column is no motion.
   * @param pair the particles of displacements and forces; strains are those of a link of unit size
   * @param row_time from row to row [s], for laws that depend on the rate; 0: no time passes, as for slow paths
   * @throws base::InputError naming the table and what is wrong with it
   */
  dem::LinkHistory drive_link(const dem::LinkLawKind      &law,
                              const dem::LinkConstants    &constants,
                              const dem::LinkPair         &pair,
                              const postprocess::CsvTable &path,
                              double                       row_time = 0);

  postprocess::CsvTable table_of(const dem::LinkHistory &history);
} // namespace apps
