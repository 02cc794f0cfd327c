#pragma once

namespace dem
{
  /**
   * Part of a limit within which a distance counts as the limit itself, and so is not below it. Regular packings have distances that
   * are equal to the reach of their links on paper; whether they are linked must not depend on the rounding of the centres, that is on
   * where the origin lies.
   */
  constexpr double tie = 1e-9;
} // namespace dem
