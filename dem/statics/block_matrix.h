#pragma once

#include "dem/statics/stiffness_operator.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace dem
{
  /**
   * A square matrix of six by six blocks, a row of them per particle, nonzero between particles that are joined. The pattern is
   * symmetric, the numbers need not be. A vector has six numbers per row of blocks.
   */
  class BlockMatrix
  {
  public:
    /** @param joined pairs of rows below `rows`, in any order, as often as wanted; the diagonal is always there */
    BlockMatrix(int rows, const std::vector<std::pair<int, int>> &joined);

    int rows() const { return static_cast<int>(diagonal_.size()); }
    int size() const { return motions * rows(); }

    /** Places of the blocks of a row: begin(row) .. begin(row + 1), by ascending column. */
    int begin(const int row) const { return begin_[static_cast<std::size_t>(row)]; }
    int column(const int place) const { return columns[static_cast<std::size_t>(place)]; }
    int diagonal(const int row) const { return diagonal_[static_cast<std::size_t>(row)]; }
    /** Of the block between two rows that are joined. */
    int          place(int row, int column) const;
    Block       &block(const int place) { return blocks[static_cast<std::size_t>(place)]; }
    const Block &block(const int place) const { return blocks[static_cast<std::size_t>(place)]; }

    void set_zero();
    /** Leave some motions of a row out: their rows and columns become those of the unit matrix times `unit`. */
    void hold(int row, HeldMotions held, double unit);

    /** y = A x; y has the size of x. */
    void multiply(const Eigen::VectorXd &x, Eigen::VectorXd &y) const;

  private:
    std::vector<int>   begin_, columns, diagonal_;
    std::vector<Block> blocks;
  };
} // namespace dem
