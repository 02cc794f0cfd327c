#pragma once

#include "dem/observation/discrete_state.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace dem
{
  /** What a DiscreteState consists of, particles first. */
  enum class StateColumn
  {
    reference,
    position,
    radius,
    volume,
    stress, ///< xx yy zz yz xz xy
    held,
    ends,
    direction,
    strength_damage,
    contact
  };

  constexpr std::size_t numbers_of_row(const StateColumn column)
  {
    switch (column)
      {
      case StateColumn::reference:
      case StateColumn::position:
      case StateColumn::direction:
      case StateColumn::contact:
        return 3;
      case StateColumn::stress:
        return 6;
      case StateColumn::ends:
        return 2;
      default:
        return 1;
      }
  }

  /** Takes one column, row by row. */
  using UseOfStateColumn = std::function<void(StateColumn, const std::vector<double> &numbers)>;

  /** Call use for all columns, in their order. */
  void each_column(const DiscreteState &state, const UseOfStateColumn &use);

  /**
   * The same of discrete_state(specimen), of which there are places, radii and volumes of particles, and one column, at a time. Of the ranks that
   * share the specimen all call this, and use is called on all of them: the first has the numbers, the others none.
   */
  void each_column(const ObservedSpecimen &specimen, const UseOfStateColumn &use);
} // namespace dem
