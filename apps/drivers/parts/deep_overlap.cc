#include "apps/drivers/parts/deep_overlap.h"

#include "dem/contacts/deepest_overlap.h"

#include <fmt/format.h>

namespace apps
{
  std::string overlap_warning(const double deepest)
  {
    if (deepest <= dem::DeepestOverlap::doubtful)
      return {};
    return fmt::format(
      "particles were pressed into each other by up to {:.2g} radii of the smaller one; laws of contact hold for "
      "overlaps that are small beside the particles (here at most {})",
      deepest, dem::DeepestOverlap::doubtful);
  }
} // namespace apps
