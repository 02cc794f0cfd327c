#pragma once

#include "base/state.h"
#include "base/voigt.h"
#include "dem/measures/localisation.h"
#include "dem/specimen/observation.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * Watches a periodic cell that is driven from sample to sample: whether its stress begins to fall while links damage (the onset), and
   * whether what is lost from then on is gathered in a band (doc/theory/periodic-cell.md, 4).
   */
  class LocalisationWatch
  {
  public:
    /** What is sampled at one instant. */
    struct Sample
    {
      base::Vector6 strain = base::Vector6::Zero(), stress = base::Vector6::Zero();
      double        dissipated = 0; ///< by damage so far [J]
    };

    /** @param above concentration of the loss (see Band) at which a cell is called localised, in (0, 1) */
    explicit LocalisationWatch(const double above = 0.5)
      : localised_above(above)
    {
    }

    /** The next sample of that specimen. @return the band in which it has just localised; after that it samples no more */
    std::optional<Band> update(const ObservedSpecimen &specimen, const Sample &now);

    /** Number of the sample before the stress began to fall, from 0. */
    std::optional<std::int64_t> onset() const
    {
      return has_onset ? std::optional<std::int64_t>(onset_number) : std::nullopt;
    }

    void visit_state(base::StateVisitor &visitor);

  private:
    double              localised_above;
    std::int64_t        samples = 0, onset_number = 0, has_onset = 0, has_localised = 0;
    Sample              last, at_onset;
    std::vector<double> lost,
      lost_at_onset; ///< strength that the links of each particle have lost, half of each link's
  };
} // namespace dem
