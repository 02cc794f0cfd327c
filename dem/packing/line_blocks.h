#pragma once

#include "base/column.h"
#include "dem/core/simd.h"
#include "dem/packing/sphere_share.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * Lines of pairs in blocks, over each of which something is added up, in eight lanes, by one rank: that which has the first line of the block. Ranks whose
   * lines begin within a block, their heads, send the terms of these, so that a sum has the order of one rank.
   */
  class LineBlocks
  {
  public:
    /** Lines here, of which all lie in one block or none. */
    struct Part
    {
      enum Kind
      {
        copy, ///< another rank adds them up
        head,
        block ///< begins here
      };
      std::size_t begin, end;
      Kind        kind;
      std::size_t number; ///< of a block, among those that begin here
    };

    /** What is added up is minus the sum of products. */
    struct Terms
    {
      base::Column one, other; ///< of each line of the head, which begins at a whole pack
    };

    /**
     * @param begins line of each rank among all, and behind the last @param copies lines here, from 0, that are copies, filled up
     * @param own where own lines begin here, as many behind a whole pack as among all @param end of all lines here, filled up
     */
    void plan(
      const SphereShare &share, std::vector<std::int64_t> begins, std::size_t copies, std::size_t own, std::size_t end);

    const std::vector<Part> &parts() const { return all_parts; }
    std::size_t              blocks() const; ///< that begin here
    std::size_t              lines_of_head() const { return head_lines; }

    /** @param sums of blocks that begin here, in lanes @param terms of the head @return the sum of all blocks of all ranks, in their order */
    double total(const SphereShare &share, std::vector<Pack> &sums, const Terms &terms) const;

  private:
    void add_heads(const SphereShare &share, std::vector<Pack> &sums, const Terms &terms) const;
    /** Of a rank. */
    std::size_t  first_block(std::size_t rank) const;
    std::int64_t lines_in_head(std::size_t rank) const;
    /** Which rank has the first line of the block in which a rank's lines begin. */
    std::size_t owner_of_head(std::size_t rank) const;

    std::vector<std::int64_t> line_begin;
    std::vector<Part>         all_parts;
    std::size_t               self = 0, before_head = 0,
                head_lines = 0; ///< lines of the head's first pack that are not its own; of the head with them
  };
} // namespace dem
