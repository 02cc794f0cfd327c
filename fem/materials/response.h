#pragma once

#include "base/voigt.h"

#include <limits>
#include <stdexcept>

namespace fem
{
  /// What a material answers to a strain: stress [Pa], d stress / d strain [Pa], and the history it would accept.
  template <typename State>
  struct Response
  {
    base::Voigt     stress;
    base::Stiffness tangent; ///< consistent with the algorithm; valid only if it was requested
    State           trial;
    int             substeps = 1; ///< parts into which the law divided the strain increment
  };

  /// Marks a parameter that has no default: the input must give it.
  inline constexpr double required = std::numeric_limits<double>::quiet_NaN();

  /// The law found no answer to this increment; a solver answers with a shorter step.
  class MaterialFailure : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
}
