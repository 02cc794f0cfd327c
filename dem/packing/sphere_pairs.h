#pragma once

#include "base/column.h"
#include "dem/model/cell.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * Pairs of spheres of radius 1 in a periodic cell that touch or may soon, with what a contact remembers: where the second sphere
   * stood, and its elastic shear. Pairs that are near are picked from a wider list, which is searched anew only where spheres have
   * moved by a good part of their radius: searching costs thirty steps, picking two.
   *
   * Both lists are complete by proof of distance: a pair farther apart than r when a list is made is, after the cell has grown by the
   * factor g and no sphere has strayed from the cell's motion by more than u, farther than g r - 2 u. So forces do not depend on when
   * lists are made.
   *
   * Places are records of record_size doubles, the first three of which are the centre.
   */
  class SpherePairs
  {
  public:
    /** @param cell enters the images that pairs reach to */
    SpherePairs(std::size_t spheres, const base::Column &places, Cell &cell);

    /**
     * After a step: make the lists anew if a pair could touch that is not in them.
     * @param growth of every length of the cell in the step @param largest no sphere moved further beside it
     */
    void follow(const base::Column &places, Cell &cell, double growth, double largest);

    /** Number of lines: pairs, and behind them what fills the last pack, two images that never touch. */
    std::size_t lines() const { return first.size(); }
    std::size_t size() const { return pairs; }

    std::vector<std::int32_t>   first, second, image; ///< of each line; pairs sorted by first
    std::array<base::Column, 3> branch;               ///< from the first to the second when forces were last found
    std::array<base::Column, 3> shear;                ///< elastic tangential displacement over the reference length 2

    std::vector<std::int32_t> own_begin; ///< pairs of which sphere i is the first: own_begin[i] to own_begin[i + 1]
    std::vector<std::int32_t> other_begin, others; ///< and of which it is the second

  private:
    void pick(const base::Column &places, Cell &cell);
    void search(const base::Column &places, Cell &cell);
    void carry_memory(const std::vector<std::int32_t> &from, std::size_t lines);
    void enter_seconds();

    struct Wide
    {
      std::vector<std::int32_t> begin, second, image; ///< pairs by their first sphere
      std::vector<std::int32_t> line;                 ///< where each is among those that are near; -1: it is not
    };

    /** Where spheres were when a list was made. */
    struct Start
    {
      std::vector<Eigen::Vector3d> places;
      double                       edge = 1;

      void   note(const base::Column &places, const Cell &cell);
      double growth(const Cell &cell) const { return cell.base()(0, 0) / edge; }
      double strayed(const base::Column &places, const Cell &cell) const; ///< largest distance from the cell's motion
    };

    std::size_t  spheres, pairs = 0;
    std::int32_t never; ///< an image too far away to touch
    Wide         wide;
    Start        searched, picked;
    double       path = 0; ///< since they were picked no sphere has strayed further
  };
} // namespace dem
