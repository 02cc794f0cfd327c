#pragma once

#include "apps/optimisation/model_noise.h"
#include "apps/scene/section.h"

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** A constant that is sought: one or several entries of the scenes that are given the same value. */
  struct SoughtConstant
  {
    std::string name, entries,
      targets; ///< names of targets, between commas, whose scenes have the entries; "": all have
    double start = 0, lower = 0, upper = 0;
  };

  /** What a run shall give: a figure, or a curve of its series. */
  struct CalibrationTarget
  {
    std::string name, scene, figure;
    double      value = 0;
    std::string curve, abscissa = "strain", ordinate = "stress", test;
    double      deviation = 0; ///< standard deviation of what was measured; 0: not known
    double      weight    = 1;
    std::string reference; ///< scene whose run is what was measured; "": a table or a value is
    std::string reference_abscissa = "strain", reference_ordinate = "stress", reference_test;
    std::string reference_figure;                         ///< of its run; "": of the same name
    double      abscissa_factor = 1, ordinate_factor = 1; ///< of the run's columns, into the units of what was measured
    std::string cheap_scene;                              ///< "": the scene itself with the changes of the cheap model

    bool is_curve() const { return figure.empty(); }
  };

  /** A model that is run first, because its runs cost less: the costly one then begins near its answer. */
  struct CheapModel
  {
    std::string base_scene, changes; ///< "Entry=value; Entry=value"

    bool exists() const { return !base_scene.empty() || !changes.empty(); }
  };

  /** What the posterior of the constants is drawn from. */
  struct PosteriorRequest
  {
    std::int64_t runs = 0, draws = 2000, seed = 1; ///< runs 0: not requested
  };

  enum class SearchMethod
  {
    least_squares,
    without_derivatives
  };

  /** A calibration as its file says it (doc/tutorials/calibrate.md). */
  struct CalibrationFile
  {
    std::string                   file; ///< as typed
    std::string                   kind, base_scene, output_folder;
    std::int64_t                  threads_per_run = 1, most_runs = 200;
    double                        step = 0.03, smallest_relative_sum = 0, smallest_decrease = 0.01;
    bool                          central_differences = false, updated_jacobian = true;
    optimisation::NoiseSearch     model_noise = optimisation::NoiseSearch::where_it_matters;
    SearchMethod                  method      = SearchMethod::least_squares;
    CheapModel                    cheap;
    PosteriorRequest              posterior;
    std::string                   seed_entry, seeds_text;
    std::deque<SoughtConstant>    constants;
    std::deque<CalibrationTarget> targets;
    std::unique_ptr<Section>      root;
  };

  /** With its sections declared and no file read. */
  std::unique_ptr<CalibrationFile> declare_calibration();

  /** @throws base::InputError naming file, line and entry */
  std::unique_ptr<CalibrationFile> read_calibration(const std::string &file, const std::vector<std::string> &overrides);
} // namespace apps
