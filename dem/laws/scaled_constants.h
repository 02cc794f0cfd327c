#pragma once

#include "dem/laws/registry.h"

#include <memory>

namespace dem
{
  /** Constants of one material over those of another. */
  struct ConstantFactors
  {
    double stiffness = 1; ///< of moduli
    double strength  = 1; ///< of strengths and cohesions; strains at which damage starts by strength over stiffness
    double ductility = 1; ///< of the relative ductility
  };

  /**
   * A copy whose constants are those of a law times factors (doc/theory/mesostructure.md, 5); ratios and friction stay.
   * @throws base::InputError where a factor other than 1 has no constant of the law to change
   */
  std::shared_ptr<LinkConstants> scaled(const LinkConstants &constants, const ConstantFactors &factors);
} // namespace dem
