#pragma once

#include "base/column.h"
#include "dem/linear/row_share.h"
#include "dem/linear/unsymmetric_factor.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * Unknowns beside the rows of a system of bricks, which no rank has alone: all ranks have all of them, and do the same with them
   * (doc/theory/quasi-static-path.md, 4). With the rows' matrix A,
   *
   *   [ A  C ] [ x ]
   *   [ D  E ] [ y ]
   */
  class BrickBorder
  {
  public:
    using Sparse = Eigen::SparseMatrix<double>;

    struct Blocks
    {
      Sparse C; ///< forces on the joined rows, six each, per unit of the border's unknowns
      Sparse D; ///< and the other way about
      Sparse E; ///< of the border alone
    };

    /**
     * @param rows to which it is joined, ascending
     * @param modes its unknowns in motions by which it takes part where bricks move rigidly, a column each
     * @param share must outlive this object
     */
    BrickBorder(std::vector<std::int32_t> rows, Sparse modes, const RowShare &share);

    Eigen::Index number_of_modes() const { return modes.cols(); }

    void set(Blocks blocks) { now = std::move(blocks); }

    /** @param E whose factor answers for the border from now on; it need not be that which is set @return false where it is singular */
    bool factorize(const Sparse &E, bool zeros_on_diagonal) { return factor.factorize(E, zeros_on_diagonal); }
    Eigen::VectorXd answer(const Eigen::VectorXd &forces) const { return factor.solve(forces); }

    /**
     * All ranks call it together.
     * @param x of the whole system, own rows up to date @param w of own rows: C y is added @param v out: D x + E y
     */
    void multiply(const base::Column &x, const Eigen::VectorXd &y, double *w, Eigen::VectorXd &v) const;

    /** With modes for its unknowns. */
    Blocks          by_modes() const;
    Eigen::VectorXd on_modes(const Eigen::VectorXd &forces) const { return modes.transpose() * forces; }
    Eigen::VectorXd of_modes(const Eigen::VectorXd &parts) const { return modes * parts; }
    const std::vector<std::int32_t> &rows() const { return joined; }

  private:
    std::vector<std::int32_t> joined;
    Sparse                    modes;
    const RowShare           &share;
    Blocks                    now;
    UnsymmetricFactor         factor;
  };
} // namespace dem
