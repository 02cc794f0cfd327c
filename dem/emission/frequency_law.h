#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace dem
{
  /** Gutenberg and Richter's law log10 N(>= M) = a - b M, from the magnitudes of events (doc/theory/acoustic-emission.md, 3). */
  struct FrequencyLaw
  {
    double      completeness = 0; ///< M_c: events from there on are all heard
    std::size_t events       = 0; ///< from there on
    double      b            = 0; ///< by maximum likelihood (Aki, 1965)
    double      error        = 0; ///< standard error of b (Shi and Bolt, 1982)
  };

  /** Events from the completeness on, below which b says nothing. */
  constexpr std::size_t fewest_events_of_law = 10;

  /**
   * The completeness is the magnitude at which most events are, in classes of a tenth (maximum curvature: Wiemer and Wyss, 2000).
   * @return none: fewer than fewest_events_of_law from there on, or all of one magnitude
   */
  std::optional<FrequencyLaw> frequency_law(const std::vector<double> &magnitudes);
} // namespace dem
