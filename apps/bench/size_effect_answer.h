#pragma once

#include "apps/bench/size_effect_beams.h"
#include "apps/bench/size_effect_universal.h"

#include <functional>
#include <string>
#include <vector>

namespace apps
{
  /** Mean and standard deviation of a figure over the geometries of a size. */
  struct FigureOfSize
  {
    double mean = 0, deviation = 0;
    int    beams = 0; ///< none: the mean is NaN
  };

  /** A law of size effect by its name in tables and pictures. */
  struct NamedLaw
  {
    std::string                   name;
    std::function<double(double)> notched, smooth; ///< nominal strength [Pa] over depth [m]; empty: there is none

    const std::function<double(double)> &of(const bool notch) const { return notch ? notched : smooth; }
  };

  /** What all beams say together, and what one size says of the others. */
  struct SizeEffectAnswer
  {
    std::vector<NamedLaw>    laws;  ///< the last is predicted from one size
    std::vector<std::string> words; ///< lines about their constants, and why laws are not there
    /**
     * The model, calibrated on one size: what notched beams of it bear that are all of particles, over those with elements. By it strengths with
     * elements predict the other sizes (doc/theory/size-effect.md, 6). Not a number where there are none.
     */
    double model = 0;
  };

  /** Of the beams of a size with elements around their core, or all of particles. */
  FigureOfSize figure_of(const std::vector<BrokenBeam> &all, const BeamCase &like, double BrokenBeam::*member);

  /** @param calibrated size from which alone the last law is @param young of elements and of particles together [Pa] */
  SizeEffectAnswer size_effect_answer(const std::vector<BrokenBeam> &all, int calibrated, double young);
} // namespace apps
