#pragma once

#include "base/column.h"
#include "dem/linear/brick_factor.h"
#include "dem/linear/minimal_residuals.h"
#include "dem/linear/projected_residual.h"

#include <vector>

namespace dem
{
  /** A system of bricks with what is beside them. */
  struct BrickSystem
  {
    const BlockMatrix &matrix; ///< complete in the share's own rows
    BrickFactor       &factor;
    const BrickBorder *border = nullptr; ///< that of the factor; null: there is none
  };

  /** A vector of such a system. */
  struct BrickVector
  {
    base::Column    rows;   ///< of the whole system
    Eigen::VectorXd border; ///< empty without one
  };

  /**
   * GMRES as in MinimalResiduals, of one right side, shared out among threads and ranks by bricks of rows: products are summed up brick by brick, and
   * the sums of bricks in their order, so that the solution has the same bits for any number of either.
   */
  class BrickResiduals
  {
  public:
    /** @param share of fields of six numbers each, must outlive this object */
    explicit BrickResiduals(RowShare &share, std::size_t rows);

    /**
     * All ranks call it together.
     * @param x in: where to start; out: the solution, on all ranks
     * @param tolerance of the residual @param most iterations in all
     */
    ResidualLeft solve(const BrickSystem &system, const BrickVector &b, double tolerance, int most, BrickVector &x);

  private:
    static constexpr int restart = 100;

    int             run(const BrickSystem &system, double enough, int most, double norm);
    void            keep_w(int place, double length);
    void            add_to(BrickVector &x, int used) const;
    void            multiply(const BrickSystem &system, BrickVector &x);
    double          residual(const BrickSystem &system, const BrickVector &b, BrickVector &x);
    double          orthogonalise(int k);
    void            take_out(const Eigen::VectorXd &parts);
    Eigen::VectorXd products(int vectors) const; ///< of the basis' first ones with w, and of w with itself
    double          norm_of_w() const;

    RowShare                       &share;
    std::size_t                     rows;
    std::int64_t                    first_brick, bricks; ///< own
    std::vector<base::Column>       basis;               ///< orthonormal, own rows in whole bricks
    std::vector<std::vector<float>> found;               ///< what the factor made of them
    base::Column                    w;                   ///< own rows in whole bricks
    BrickVector                     z;
    std::vector<Eigen::VectorXd>    border_basis, border_found; ///< likewise, of the border
    Eigen::VectorXd                 border_w;
    ProjectedResidual               projected;
  };
} // namespace dem
