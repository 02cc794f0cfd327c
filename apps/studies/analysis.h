#pragma once

#include "apps/statistics/anova.h"
#include "apps/statistics/array_check.h"
#include "apps/statistics/gaussian_process.h"
#include "apps/statistics/ranges.h"
#include "apps/statistics/response_surface.h"
#include "apps/studies/table_selection.h"

#include <optional>
#include <string>
#include <vector>

namespace apps
{
  enum class AnalysisModel
  {
    range,
    anova,
    linear,
    quadratic
  };

  /** How a column to which no factor was given is treated. */
  enum class NullColumn
  {
    factor,
    pooled,
    error
  };

  struct AnalysisOptions
  {
    AnalysisModel model = AnalysisModel::quadratic;
    std::string   null_column; ///< "": there is none
    NullColumn    null_as          = NullColumn::factor;
    bool          gaussian_process = true; ///< beside a surface
  };

  /** A run that deserves a check, and why. */
  struct FlaggedRun
  {
    std::string run, reason;
  };

  /** What a table says of a response (doc/theory/studies.md). */
  struct Analysis
  {
    AnalysisOptions                      options;
    TableSelection                       table;
    statistics::ArrayCheck               array;
    std::vector<statistics::FactorRange> ranges;

    std::optional<statistics::Anova>           anova;
    std::optional<statistics::ResponseSurface> surface;
    std::optional<statistics::GaussianProcess> process;

    std::vector<FlaggedRun>  flags;
    std::vector<std::string> warnings; ///< sentences

    const statistics::LinearFit *fit() const; ///< of the model; nullptr: ranges alone
  };

  /** Beyond it a studentised residual is flagged. */
  constexpr double suspicious_residual = 4;

  /** @throws base::InputError for a table that does not carry the model */
  Analysis analyse(TableSelection table, const AnalysisOptions &options);
} // namespace apps
