#pragma once

#include "apps/studies/analysis.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace apps
{
  /** What analysis.json holds (doc/formats.md). */
  nlohmann::json json_of(const Analysis &analysis);

  /** What a terminal shows. */
  std::string words_of(const Analysis &analysis);

  /** analysis.csv: a line for each factor or term. */
  std::string csv_of(const Analysis &analysis);

  /** residuals.csv: a line for each run. Of ranges alone there are none: "". */
  std::string residuals_csv_of(const Analysis &analysis);

  /** report.html of a folder in which the pictures stand. */
  std::string report_of(const Analysis &analysis, const std::filesystem::path &folder);

  /** Draw effects.png, and as the model has them half_normal.png, residuals.png, contours.png. What cannot be drawn costs a warning. */
  void draw(const Analysis &analysis, const std::filesystem::path &folder);
} // namespace apps
