#pragma once

#include "apps/models/material.h"
#include "apps/models/specimen.h"
#include "dem/model/packing.h"
#include "dem/packing/compaction.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace apps
{
  /**
   * The particles of a scene: generated or read, repeated and cropped to its box, each with its material where there
   * are several. Long generation shows progress; what the user should know about the packing goes to the standard error.
   *
   * @throws base::InputError; dem::CompactionCancelled when interrupted, dem::CompactionFailed.
   */
  dem::Packing make_packing(const SpecimenSection &specimen, const MaterialSection &material, int dimension);

  /**
   * The same without its material, which is still as the file has it.
   * @param cell receives the periodic packing of which they are a part, where there is one; nullptr: not needed
   */
  dem::Packing
  specimen_particles(const SpecimenSection &specimen, int dimension, std::optional<dem::Packing> *cell = nullptr);
  /** Where these come from, for messages. */
  std::string origin_of(const SpecimenSection &specimen);

  /** dem::compact() with progress on the standard error, ended by an interrupt; or what packing_cache() has kept of it. */
  dem::CompactionResult compact_with_progress(const dem::CompactionParameters &parameters);

  /** Those particles of a packing that are kept, by number; one body, which repeats nowhere. */
  dem::Packing particles_where(const dem::Packing &packing, const std::function<bool(std::size_t)> &keeps);

  /** dem::tile_and_crop(), its note shown. */
  dem::Packing cropped(const dem::Packing &packing, const Eigen::Vector3d &box);

  /** A run's own copy in its folder, packing.h5, with which a resumed one goes on. @throws postprocess::OutputError */
  void keep_packing(const dem::Packing &packing, const std::filesystem::path &folder);
  /** @throws base::InputError when it is not there */
  dem::Packing kept_packing(const std::filesystem::path &folder);
} // namespace apps
