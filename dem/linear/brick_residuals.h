#pragma once

#include "base/column.h"
#include "dem/linear/brick_factor.h"
#include "dem/linear/minimal_residuals.h"
#include "dem/linear/projected_residual.h"

#include <vector>

namespace dem
{
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
     * @param matrix complete in the share's own rows
     * @param b, x of the whole system; x in: where to start; out: the solution, on all ranks
     * @param tolerance of the residual @param most iterations in all
     */
    ResidualLeft solve(const BlockMatrix  &matrix,
                       BrickFactor        &factor,
                       const base::Column &b,
                       double              tolerance,
                       int                 most,
                       base::Column       &x);

  private:
    static constexpr int restart = 100;

    int             run(const BlockMatrix &matrix, BrickFactor &factor, double enough, int most, double norm);
    void            add_to(base::Column &x, int used) const;
    double          residual(const BlockMatrix &matrix, const base::Column &b, base::Column &x);
    double          orthogonalise(int k);
    void            take_out(const Eigen::VectorXd &parts);
    Eigen::VectorXd products(int vectors) const; ///< of the basis' first ones with w, and of w with itself
    double          norm_of_w() const;

    RowShare                       &share;
    std::size_t                     rows;
    std::int64_t                    first_brick, bricks; ///< own
    std::vector<base::Column>       basis;               ///< orthonormal, own rows in whole bricks
    std::vector<std::vector<float>> found;               ///< what the factor made of them
    base::Column                    w, z;                ///< own rows in whole bricks; the whole system
    ProjectedResidual               projected;
  };
} // namespace dem
