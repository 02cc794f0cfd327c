#pragma once

#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <string>
#include <vector>

namespace apps_tests
{
  /** Three constants of a stack of spheres that is pulled until it breaks, in part of a second; no test shows the third. */
  std::string calibration_of_stack(const std::string &targets);

  /** Targets of such a calibration: two figures. */
  std::string two_figures();

  /** The same calibration without the constant that no figure shows. */
  std::string two_constants(const std::string &targets);

  /** Two figures: a modulus as wanted, and a strength that this stack has with a limit a little below its start. */
  std::string stack_figures(const std::string &modulus, const std::string &deviation);

  /** The stack, its scene and a calibration. */
  void write_calibration(const ScratchFolder &folder, const std::string &text);

  /** A process of its own: a calibration starts its program again for each run. */
  Outcome calibrate(const ScratchFolder &folder, const std::vector<std::string> &options);

  /** The curve of the run "truth" up to its peak, with noise, in TEST.csv: its standard deviation. Beyond the peak it is jagged. */
  double measured_up_to_peak(const ScratchFolder &folder, const std::string &test);

  /** That of known constants in measured.csv. */
  double measure(const ScratchFolder &folder);

  /** The stack, and a calibration whose target is that curve, known to its noise. @param section of the calibration besides */
  void write_curve_calibration(const ScratchFolder &folder, const std::string &section = "");
} // namespace apps_tests
