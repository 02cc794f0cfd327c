#pragma once

#include "base/voigt.h"

#include <array>

namespace fem
{
  /// Which stress components are prescribed; the others are prescribed in strain.
  struct MixedTarget
  {
    std::array<bool, 6> stress_given{};
    base::Voigt         value = base::Voigt::Zero(); ///< strain [-] or stress [Pa], component by component
  };

  /// How a step is integrated whose components are given partly in stress.
  enum class Increments
  {
    followed, ///< in as many parts as its path needs
    whole     ///< as one increment of the law, however long, as in published runs of one increment a step
  };
}
