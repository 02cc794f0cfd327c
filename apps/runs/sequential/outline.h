#pragma once

#include "apps/runs/sequential/study.h"
#include "base/entry_path.h"
#include "dem/model/packing.h"
#include "postprocess/files/series.h"

#include <vector>

namespace apps
{
  /** The solid of a sequential scene before anything runs. */
  struct SolidOutline
  {
    Eigen::Vector3d                        low = {0, 0, 0}, high = {0, 0, 0}; ///< box around it [m]
    double                                 volume   = 0;                      ///< [m^3]
    std::size_t                            elements = 0, unknowns = 0;
    std::vector<postprocess::SeriesColumn> columns; ///< of the continuation's series

    double mean_element_size(int dimension) const; ///< [m]
    double section(int axis) const;                ///< mean across an axis [m^2]
  };

  /** @throws base::InputError for what a continuum run refuses. */
  SolidOutline outline_of(const ContinuumModel &model);

  /** The particles that will be handed over, or one saved state of them. */
  struct ParticleOutline
  {
    std::string     origin;                            ///< for messages: "the specimen", a file
    Eigen::Vector3d low = {0, 0, 0}, high = {0, 0, 0}; ///< box around the spheres [m]
    double          mean_radius = 0;                   ///< [m]
  };

  /** One of the packing; or one of each saved state, bonded particles only. @throws base::InputError */
  std::vector<ParticleOutline> outlines_of(const SequentialModel &model, const dem::Packing &packing);

  /**
   * What a study would compute that has no meaning: columns that the continuation does not write, particles and mesh of different
   * extents, a length or an area that are not the mesh's, an axis that is not the particles'.
   * @param study path of its section, for messages @throws base::InputError with the numbers
   */
  StudyUnits check_study(const SequentialModel              &model,
                         const base::EntryPath              &study,
                         const SolidOutline                 &solid,
                         const std::vector<ParticleOutline> &particles);
} // namespace apps
