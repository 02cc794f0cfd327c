#pragma once

#include "dem/linear/incomplete_factor.h"
#include "dem/linear/rigid_bricks.h"

#include <memory>
#include <vector>

namespace dem
{
  /**
   * An approximate inverse of a matrix of blocks that threads and ranks share out by bricks of rows (doc/theory/quasi-static-path.md, 4): an incomplete
   * factor of each brick by itself, and the rigid motions of bricks against each other. It does not depend on how many threads and ranks there are.
   */
  class BrickFactor
  {
  public:
    /**
     * @param links ends as rows, of the whole system
     * @param share, border must outlive this object @param border null: there is none
     */
    BrickFactor(const RowParticles &rows,
                const LinkEnds     &links,
                const RowShare     &share,
                const BrickBorder  *border = nullptr);

    /**
     * @param matrix complete in the share's own rows; the border has its own, and its factor
     * @param diagonal of the whole system with undamaged links; tiny parts of it keep motions regular that nothing resists
     * @return false on all ranks where a pivot is singular on one
     */
    bool compute(const BlockMatrix &matrix, const Eigen::VectorXd &diagonal);

    /** z = M^-1 r, of the share's own rows. All ranks call it together. @param s, y the same of the border, empty without one */
    void apply(const double *r, float *z, const Eigen::VectorXd &s, Eigen::VectorXd &y);

  private:
    bool compute_brick(std::size_t brick, const BlockMatrix &matrix, const Eigen::VectorXd &diagonal);

    const RowShare                                  &share;
    const BrickBorder                               *border;
    std::vector<std::shared_ptr<const BlockPattern>> pattern; ///< of each own brick
    std::vector<IncompleteFactor<float>>             factor;  ///< likewise
    RigidBricks                                      rigid;
  };
} // namespace dem
