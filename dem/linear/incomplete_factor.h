#pragma once

#include "dem/linear/block_matrix.h"

#include <array>
#include <memory>
#include <vector>

namespace dem
{
  /**
   * Incomplete LU factor of a matrix of blocks: what elimination would put outside the pattern is dropped (Meijerink and van der
   * Vorst 1977, with blocks in place of numbers). Unsymmetric and indefinite matrices are taken as they come.
   *
   * @tparam Number float halves what is read; an iteration that it steers does not notice
   */
  template <typename Number>
  class IncompleteFactor
  {
  public:
    /**
     * @param on_diagonal added to the diagonal, one number per unknown
     * @return false where a pivot is singular
     */
    bool compute(const BlockMatrix &matrix, const Eigen::VectorXd &on_diagonal);

    /** z_i = (L U)^-1 r_i for columns that stand in any place; as large as the matrix each. */
    template <int n>
    void apply(const std::array<const double *, n> &r, const std::array<Number *, n> &z);

  private:
    void eliminate(int row);

    std::shared_ptr<const BlockPattern> pattern;
    std::vector<WideBlock<Number>>      factor;  ///< L has unit blocks on its diagonal
    std::vector<WideBlock<Number>>      inverse; ///< of the pivots
    std::vector<int>                    place_of_column;
    std::vector<Number>                 work; ///< of a solution: a pack per row and column
  };
} // namespace dem
