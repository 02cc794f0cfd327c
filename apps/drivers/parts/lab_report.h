#pragma once

#include "dem/grips/grip_layers.h"
#include "dem/loading/curve_figures.h"
#include "dem/observation/crack.h"

#include <nlohmann/json_fwd.hpp>

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

    void visit_state(dem::StateVisitor &visitor);
  };

  /** Figures of the tests as a summary holds them: value and unit; where one is not determined, null and the reason. */
  nlohmann::json figures_of(const std::vector<LabNotes> &tests);
  /** Figures and crack of one test. */
  nlohmann::json json_of(const LabNotes &test);
  /** What casts doubt on the figures: a crack at a grip. */
  std::vector<std::string> warnings_of(const std::vector<LabNotes> &tests);
  /** One line for the terminal: strength, modulus, crack. */
  std::string text_of(const LabNotes &test);
  /** Section and gauge length, as long as there are grips. */
  std::string basis_of(const LabNotes &test);
} // namespace apps
