#pragma once

#include <Eigen/SparseCore>

#include <memory>

namespace dem
{
  /** A sparse factor of a system whose values need not be symmetric (UMFPACK), ordered when it is first made. */
  class UnsymmetricFactor
  {
  public:
    using Sparse = Eigen::SparseMatrix<double>;

    UnsymmetricFactor();
    ~UnsymmetricFactor();

    /**
     * @param matrix of the same pattern each time
     * @param zeros_on_diagonal pivots are then sought beside it @return false where it is singular
     */
    bool factorize(const Sparse &matrix, bool zeros_on_diagonal);
    /** A column for each right side. No refinement: what a solution leaves is in the caller's next residual. */
    Eigen::MatrixXd solve(const Eigen::MatrixXd &right) const;
    /** What it took to factorise. */
    double operations() const;

  private:
    struct Lu;

    std::unique_ptr<Lu> lu; ///< behind a pointer: its header is for this file alone
    bool                ordered = false;
  };
} // namespace dem
