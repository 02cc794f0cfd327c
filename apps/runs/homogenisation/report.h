#pragma once

#include "apps/runs/homogenisation/moduli.h"
#include "base/voigt.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** Mean and standard deviation of a sample. */
  struct SampleFigure
  {
    double mean = 0, deviation = 0; ///< deviation: 0 for a sample of one
  };
  /** @return nothing for an empty sample */
  std::optional<SampleFigure> sample_figure(const std::vector<double> &values);

  /** One constant as found in one way, of those answers that have it. */
  std::vector<double> constants_of(const std::vector<HomogenisationAnswer> &answers,
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
