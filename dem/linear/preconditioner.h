#pragma once

#include "dem/network/stiffness_operator.h"

namespace dem
{
  /** z = M^-1 r of all lanes: a fixed, symmetric approximation of the inverse stiffness, zero in held motions. */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner()                            = default;
    virtual void apply(const Fields &r, Fields &z) const = 0;
  };
} // namespace dem
