#pragma once

#include "apps/models/loading.h"
#include "base/column.h"
#include "dem/grips/grip_layers.h"
#include "dem/loading/curve_figures.h"
#include "dem/observation/crack.h"
#include "postprocess/pictures/plot.h"

#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** What a laboratory notes of one test between grips, in time or without inertia. */
  struct LabNotes
  {
    std::string          name; ///< "tension"
    dem::UniaxialFigures figures;
    dem::Crack           crack;
    double               section = 0, gauge_length = 0; ///< [m^2], [m]; 0: a periodic cell, which has neither
    double               deepest_overlap = 0;           ///< see dem::Counts

    std::optional<double> poisson_ratio; ///< up to a third of the largest stress; nothing: not read, or too few samples
    double work_of_fracture = 0;         ///< of the grips over the section, until the test ends [J/m^2]; 0: not read
    double stress_left      = 1;         ///< at that end, over the largest

    void visit_state(base::StateVisitor &visitor);
  };

  template <typename Result>
  std::vector<LabNotes> notes_of(const std::vector<Result> &results)
  {
    std::vector<LabNotes> notes;
    for (const Result &result : results)
      notes.push_back(result.notes);
    return notes;
  }

  /** The test whose energies balance worst. @pre there is one */
  template <typename Result>
  const Result &worst_balanced(const std::vector<Result> &results)
  {
    return *std::max_element(results.begin(), results.end(), [](const Result &a, const Result &b) {
      return a.worst_balance_error < b.worst_balance_error;
    });
  }

  /** Note the work of fracture of a test between grips: the area under its curve times the gauge length. */
  void note_work_of_fracture(LabNotes &test, const dem::UniaxialFigures &curve);

  /** Figures of the tests as a summary holds them: value and unit; where one is not determined, null and the reason. */
  nlohmann::json figures_of(const std::vector<LabNotes> &tests);
  /** Names of all that figures_of() can have. @param between_grips not of a periodic cell */
  std::vector<std::string> names_of_figures(const std::vector<UniaxialLoad> &tests, bool between_grips);
  /** Figures and crack of one test. */
  nlohmann::json json_of(const LabNotes &test);
  /** What casts doubt on the figures: a crack at a grip, particles pressed deep into each other. */
  std::vector<std::string> warnings_of(const std::vector<LabNotes> &tests);
  /** One line for the terminal: strength, modulus, crack. */
  std::string text_of(const LabNotes &test);
  /** The curve of one test, upwards in compression as well. @param strain, stress tension positive [-], [Pa] */
  postprocess::PlotPanel panel_of(UniaxialLoad load, const base::Column &strain, const base::Column &stress);
  /** Section and gauge length, as long as there are grips. */
  std::string basis_of(const LabNotes &test);
} // namespace apps
