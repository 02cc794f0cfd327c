#pragma once

#include "dem/laws/cpm.h"

#include <tuple>

namespace dem
{
  /** The link laws that a scene can name; factory, error text and generic tests go through this list. */
  using LinkLaws = std::tuple<CpmDescription>;
} // namespace dem
