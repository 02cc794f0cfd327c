#pragma once

#include "apps/runs/homogenisation/moduli.h"
#include "apps/statistics/sample.h"
#include "base/voigt.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** One constant as found in one way, over those answers that have it. */
  statistics::SampleMoments moments_of(const std::vector<HomogenisationAnswer> &answers,
                                       FoundStiffness HomogenisationAnswer::*way,
                                       double dem::ElasticConstants::*figure);

  /** The table for the terminal: three ways side by side, isotropy, solver. */
  std::string table_of(const HomogenisationAnswer &answer, const HomogenisationQuestion &question);

  /** Scatter over packings, a line per way; empty for less than two. */
  std::string scatter_table(const std::vector<HomogenisationAnswer> &answers);

  /** The six rows of a stiffness. */
  nlohmann::json json_of(const base::Stiffness &D);

  /** What homogenised.json holds for one packing. */
  nlohmann::json json_of(const HomogenisationAnswer &answer);

  /** Mean, deviation and values of the moduli over packings. */
  nlohmann::json scatter_json(const std::vector<HomogenisationAnswer> &answers);
} // namespace apps
