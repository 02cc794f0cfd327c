#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace dem
{
  class Ranks;

  /**
   * Numbers go from rank to rank, each of which goes on with what the one before has left: sums have the order, and the bits, of one rank. The last
   * rank has what comes out. Called by all.
   */
  void pass_along(Ranks &ranks, double *numbers, std::size_t count, const std::function<void()> &go_on);

  /** The same, and all ranks have what comes out. */
  void in_turn(Ranks &ranks, double *numbers, std::size_t count, const std::function<void()> &go_on);

  /** The same from one to the next of some of them. @param by ascending, not empty, the same on all ranks; all of them call, and have what comes out */
  void in_turn(Ranks                          &ranks,
               const std::vector<std::size_t> &by,
               double                         *numbers,
               std::size_t                     count,
               const std::function<void()>    &go_on);
} // namespace dem
