#pragma once

#include "apps/scene/section.h"
#include "apps/studies/curve_reading.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** What a study varies: one or several entries of its scene that are given the same value. */
  struct StudyFactor
  {
    std::string name, entries, levels_text, reference_text;
    double      lower = 0, upper = 0; ///< of coded variables -1 and 1, or of the unit cube
    Place       place;
  };

  /** What a study reads from each run. */
  struct StudyResponse
  {
    std::string  name, figure; ///< "": of a curve
    CurveReading curve;
    Place        place;

    bool is_curve() const { return figure.empty(); }
  };

  enum class DesignKind
  {
    one_at_a_time,
    full_factorial,
    orthogonal_array,
    central_composite,
    box_behnken,
    latin_hypercube,
    sobol,
    table
  };

  /** A study as its file says it (doc/tutorials/studies.md). */
  struct StudyFile
  {
    std::string               file; ///< as typed
    std::string               kind, base_scene, output_folder;
    DesignKind                design = DesignKind::one_at_a_time;
    std::string               array  = "L27", table_file;
    std::int64_t              runs = 0, centres = 5, seed = 1;
    double                    axial_distance  = 0; ///< 0: rotatable
    std::int64_t              threads_per_run = 1;
    std::deque<StudyFactor>   factors;
    std::deque<StudyResponse> responses;
    std::unique_ptr<Section>  root;
  };

  enum class FileOf
  {
    scene, ///< of whatever kind
    study,
    calibration
  };

  /** What a parameter file says of itself by its entry Kind. */
  FileOf kind_of_file(const std::string &file);

  /** With its sections declared and no file read. */
  std::unique_ptr<StudyFile> declare_study();

  /**
   * Read a study and changes to it.
   * @throws base::InputError naming file, line and entry
   */
  std::unique_ptr<StudyFile> read_study(const std::string &file, const std::vector<std::string> &overrides);
} // namespace apps
