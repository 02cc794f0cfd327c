#pragma once

#include "dem/statics/block_matrix.h"

#include <vector>

namespace dem
{
  /**
   * Incomplete LU factor of a matrix of blocks: what elimination would put outside the pattern is dropped (Meijerink and van der
   * Vorst 1977, with blocks in place of numbers). Unsymmetric and indefinite matrices are taken as they come.
   */
  class IncompleteFactor
  {
  public:
    /**
     * @param on_diagonal added to the diagonal, one number per unknown
     * @return false where a pivot is singular
     */
    bool compute(const BlockMatrix &matrix, const Eigen::VectorXd &on_diagonal);

    /** z = (L U)^-1 r; z has the size of r. */
    void apply(const Eigen::VectorXd &r, Eigen::VectorXd &z) const;

  private:
    void eliminate(int row, std::vector<int> &place_of_column);

    std::vector<BlockMatrix> factor;  ///< one, or none yet; L has unit blocks on its diagonal
    std::vector<Block>       inverse; ///< of the pivots
  };
} // namespace dem
