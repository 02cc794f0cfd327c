#pragma once

namespace dem
{
  /** How a linear system of links is solved. */
  enum class SolverMethod
  {
    automatic, ///< by whichever is expected to take less; iterative where ranks share the work
    iterative, ///< without a factor of the whole: what ranks can share
    direct     ///< a sparse factor
  };
} // namespace dem
