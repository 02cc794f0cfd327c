#pragma once

#include "dem/core/simd.h"
#include "dem/network/stiffness_operator.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace dem
{
  /** Which blocks of a matrix, a row of them per particle, are there: a symmetric pattern, with the diagonal. */
  class BlockPattern
  {
  public:
    /** @param joined pairs of rows below `rows`, in any order, as often as wanted */
    BlockPattern(int rows, const std::vector<std::pair<int, int>> &joined);

    int rows() const { return static_cast<int>(diagonal_.size()); }
    int size() const { return motions * rows(); } ///< of a vector
    int blocks() const { return static_cast<int>(columns.size()); }

    /** Places of the blocks of a row: begin(row) .. begin(row + 1), by ascending column. */
    int begin(const int row) const { return begin_[static_cast<std::size_t>(row)]; }
    int column(const int place) const { return columns[static_cast<std::size_t>(place)]; }
    int diagonal(const int row) const { return diagonal_[static_cast<std::size_t>(row)]; }
    /** Of the block between two rows that are joined. */
    int place(int row, int column) const;

  private:
    std::vector<int> begin_, columns, diagonal_;
  };

  /** A block and two rows of zeros, so that each of its columns fills a pack. */
  template <typename Number>
  using WideBlock = Eigen::Matrix<Number, pack_size, motions>;

  /** Several vectors beside each other. */
  template <int n>
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, n>;

  /**
   * A square matrix of six by six blocks, a row of them per particle, nonzero between particles that are joined. The pattern is
   * symmetric, the numbers need not be. A vector has six numbers per row of blocks.
   */
  class BlockMatrix
  {
  public:
    /** @param joined as BlockPattern */
    BlockMatrix(int rows, const std::vector<std::pair<int, int>> &joined);
    explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);

    const std::shared_ptr<const BlockPattern> &pattern() const { return of; }

    int rows() const { return of->rows(); }
    int size() const { return of->size(); }
    int begin(const int row) const { return of->begin(row); }
    int column(const int place) const { return of->column(place); }
    int diagonal(const int row) const { return of->diagonal(row); }
    int place(const int row, const int column) const { return of->place(row, column); }

    auto block(const int place) { return wide[static_cast<std::size_t>(place)].topRows<motions>(); }
    auto block(const int place) const { return wide[static_cast<std::size_t>(place)].topRows<motions>(); }

    void set_zero();
    /** Leave some motions of a row out: their rows and columns become those of the unit matrix times `unit`. */
    void hold(int row, HeldMotions held, double unit);

    /** y = A x; y has the size of x. */
    template <int n>
    void multiply(const Columns<n> &x, Columns<n> &y) const;
    /** The same for one vector and some rows, by all threads. @param y of these rows alone */
    void multiply(const double *x, int first, int end, double *y) const;

  private:
    /** What a row makes of vectors that stand so far apart. @param y likewise */
    template <int n>
    void multiply_row(int row, const double *x, std::ptrdiff_t x_apart, double *y, std::ptrdiff_t y_apart) const;

    std::shared_ptr<const BlockPattern> of;
    std::vector<WideBlock<double>>      wide;
  };
} // namespace dem
