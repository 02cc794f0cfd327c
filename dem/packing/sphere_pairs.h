#pragma once

#include "base/column.h"
#include "dem/model/cell.h"
#include "dem/packing/line_blocks.h"
#include "dem/packing/sphere_share.h"

#include <array>
#include <cstdint>
#include <utility>
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
   * Places are records of record_size doubles, the first three of which are the centre: of the spheres of a rank, and of its ghosts, by which pairs
   * know their ends. A pair is in the list of the ranks of both its ends. Lines are those of pairs whose first sphere belongs to a lower rank, filled up to
   * whole packs, then those whose first is this rank's, which begin as many lines behind a whole pack as they do in the list of all, filled up again.
   */
  class SpherePairs
  {
  public:
    /** @param share must outlive this; gets its ghosts @param places gets theirs @param cell enters the images that pairs reach to */
    SpherePairs(SphereShare &share, base::Column &places, Cell &cell);

    /**
     * After a step: make the lists anew if a pair could touch that is not in them.
     * @param growth of every length of the cell in the step @param largest no sphere of any rank moved further beside it
     */
    void follow(base::Column &places, Cell &cell, double growth, double largest);

    /** Number of lines: pairs, and what fills packs, two images that never touch. */
    std::size_t lines() const { return first.size(); }
    /** Lines of copies, and of the rank's own pairs: the first, and behind the last. */
    std::pair<std::size_t, std::size_t> copies() const { return {0, copied}; }
    std::pair<std::size_t, std::size_t> own() const { return {own_first, own_end}; }
    const LineBlocks                   &blocks() const { return line_blocks; }

    std::vector<std::int32_t> first, second,
      image;                            ///< of each line, records of places; pairs sorted by first, then second
    std::array<base::Column, 3> branch; ///< from the first to the second when forces were last found
    std::array<base::Column, 3> shear;  ///< elastic tangential displacement over the reference length 2

    std::vector<std::int32_t>
      own_begin; ///< of the rank's spheres: lines of which sphere i is the first: own_begin[i] to own_begin[i + 1]
    std::vector<std::int32_t> other_begin, others; ///< and of which it is the second

  private:
    void pick(const base::Column &places, Cell &cell);
    void search(base::Column &places, Cell &cell);
    void choose_ghosts(base::Column &places);
    /** Enter those that are near, by their numbers in the wide list, as lines. @return the line that each had; -1: none */
    std::vector<std::int32_t> enter(const std::vector<std::int32_t> &near);
    void                      enter_line(std::int32_t wide_pair, std::vector<std::int32_t> &from);
    void                      fill(std::size_t to, std::vector<std::int32_t> &from);
    void                      carry_memory(const std::vector<std::int32_t> &from, std::size_t lines);
    void                      enter_seconds();

    struct Wide
    {
      std::vector<NeighbourPair> pair; ///< by numbers of spheres among all
      std::vector<std::int32_t>  image;
      std::vector<std::int32_t>  line; ///< where each is among those that are near; -1: it is not
    };

    /** Where the rank's spheres were when a list was made. */
    struct Start
    {
      std::vector<Eigen::Vector3d> places;
      double                       edge = 1;

      void   note(const base::Column &places, std::size_t spheres, const Cell &cell);
      double growth(const Cell &cell) const { return cell.base()(0, 0) / edge; }
      double strayed(const base::Column &places, const Cell &cell) const; ///< largest distance from the cell's motion
    };

    SphereShare &share;
    std::size_t  copied = 0, own_first = 0, own_end = 0; ///< lines
    LineBlocks   line_blocks;
    std::int32_t never; ///< an image too far away to touch
    Wide         wide;
    Start        searched, picked;
    double       path = 0; ///< since they were picked no sphere has strayed further
  };
} // namespace dem
