#include "apps/specimens/deep_overlap.h"

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

  std::string turn_warning(const double largest)
  {
    constexpr double doubtful = 0.01; // spec of the bonded contact laws, 8
    if (largest <= doubtful)
      return {};
    return fmt::format(
      "particles turned by up to {:.2g} rad in a step; laws of links hold for rotations that are small in "
      "a step (here at most {}). Lower Time/Step factor",
      largest, doubtful);
  }
} // namespace apps
