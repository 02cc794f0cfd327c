#pragma once

#include "apps/scene/section.h"

#include <cstdint>
#include <string>
#include <vector>

namespace apps
{
  /** An entry "Seed" of a scene, and its value. */
  struct SceneSeed
  {
    std::string  entry; ///< "Specimen/Generator/Seed"
    std::int64_t value = 0;
  };

  /** Whether something of a kind is drawn by a seed, or can be. */
  bool has_seed(const Section &root);

  /** Of a scene as read: the seeds that something is drawn by, in the order of its sections. */
  std::vector<SceneSeed> seeds_in_use(const Section &root);
} // namespace apps
