#pragma once

#include "apps/scene/section.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /**
   * A scene file with every entry, its default, meaning, unit and range; needed constants stand as comments to fill
   * in.
   * @param only this entry of the section, if given
   */
  std::string description_as_prm(const Section &section, const Entry *only = nullptr);
  /** The entries of one section, not those of its sub-sections, as a Markdown table after a line of what the section is. */
  std::string description_as_markdown(const Section &section, const Entry *only = nullptr);
  /** The same as description_as_prm() for programs: nested objects with "entries" and "sections". */
  nlohmann::json description_as_json(const Section &section, const Entry *only = nullptr);

  enum class Completed
  {
    everything,
    what_decides_results ///< without folders, checkpoint intervals and the like; without remarks
  };

  /** A scene of a kind to start from: nothing but its kind is set, every entry stands in it as a comment with what it means. */
  std::string proposed_scene(const Section &root, const std::string &kind);

  /**
   * The scene as it was understood: every needed entry with its value, defaults included; reading it gives the same
   * run.
   */
  std::string completed_scene(const Section &root, Completed what);
} // namespace apps
