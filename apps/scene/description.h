#pragma once

#include "apps/scene/section.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /**
   * A scene file with every entry, its default, meaning, unit and range; needed constants stand as comments to fill
   * in.
   */
  std::string description_as_prm(const Section &section);
  /** The same as a Markdown table per section. */
  std::string description_as_markdown(const Section &section);
  /** The same for programs: nested objects with "entries" and "sections". */
  nlohmann::json description_as_json(const Section &section);

  enum class Completed
  {
    everything,
    what_decides_results ///< without folders, checkpoint intervals and the like; without remarks
  };

  /**
   * The scene as it was understood: every needed entry with its value, defaults included; reading it gives the same
   * run.
   */
  std::string completed_scene(const Section &root, Completed what);
} // namespace apps
