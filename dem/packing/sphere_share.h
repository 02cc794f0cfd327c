#pragma once

#include "base/column.h"
#include "dem/neighbours/cell_list.h"
#include "dem/ranks/ranks.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace dem
{
  /**
   * Spheres, in their order along a curve, of which one of several ranks has whole bricks (doc/theory/ranks.md, 1). Columns hold records of its own, in
   * their order, and behind them of its ghosts, those of others that its pairs reach to. Alone, all are its own.
   *
   * All ranks make the same calls in the same order.
   */
  class SphereShare
  {
  public:
    /** @param ranks null: alone; otherwise they outlive this object */
    SphereShare(std::size_t spheres, Ranks *ranks);

    std::size_t all() const { return begin.back(); }
    std::size_t own() const { return begin[self + 1] - begin[self]; }
    std::size_t here() const { return own() + ghosts.size(); } ///< records of a column
    std::size_t first() const { return begin[self]; }          ///< of its own, among all
    PairsOf     range() const;
    bool        owns(const std::int32_t sphere) const { return range().has(sphere); }
    /** Which record is that of a sphere, given by its number among all. @pre it is its own, or a ghost */
    std::int32_t record_of(std::int32_t sphere) const;

    /** @param needed others' spheres, ascending */
    void set_ghosts(std::vector<std::int32_t> needed);
    /** Bring places and turns of ghosts up to date. @param records of what is here */
    void receive(base::Column &records);

    std::vector<Eigen::Vector3d> all_places(const base::Column &records) const;
    double                       largest(double here) const;
    /** Begin of each rank's items among all, and behind the last. @param here how many this rank has */
    std::vector<std::int64_t> begins(std::int64_t here) const;
    /** in_turn(), or alone. */
    void in_turn(double *numbers, std::size_t count, const std::function<void()> &go_on) const;

    Ranks      *together() const { return ranks; } ///< null: alone
    std::size_t rank() const { return self; }

  private:
    std::size_t owner_of(std::int32_t sphere) const;

    Ranks                                 *ranks;
    std::size_t                            self = 0;
    std::vector<std::size_t>               begin;  ///< sphere of each rank, and behind the last
    std::vector<std::int32_t>              ghosts; ///< ascending
    std::vector<std::vector<std::int32_t>> sent;   ///< own spheres that are ghosts of each rank
    std::vector<RankMessage>               out, in;
  };
} // namespace dem
