#pragma once

#include "apps/bench/size_effect_answer.h"
#include "postprocess/pictures/plot.h"

#include <string>
#include <vector>

namespace apps
{
  /** A row per beam. */
  std::string csv_of_beams(const std::vector<BrokenBeam> &all);

  /** Markdown: a row per size and kind, laws beside it with how far off they are; then beams of particles alone beside those with elements; then constants. */
  std::string table_of_sizes(const std::vector<BrokenBeam> &all, const SizeEffectAnswer &answer);

  /** Strength over depth, both logarithmic: beams and laws with a notch, and without. */
  std::vector<postprocess::PlotPanel> panels_of_sizes(const std::vector<BrokenBeam> &all,
                                                      const SizeEffectAnswer        &answer);
} // namespace apps
