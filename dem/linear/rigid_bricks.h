#pragma once

#include "dem/linear/block_matrix.h"
#include "dem/linear/brick_border.h"
#include "dem/linear/row_share.h"
#include "dem/linear/unsymmetric_factor.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dem
{
  /** The particles that rows of a system of blocks stand for, in the order of the rows. */
  struct RowParticles
  {
    std::vector<Eigen::Vector3d> place; ///< [m]
    std::vector<HeldMotions>     held;
    double                       scale = 1; ///< that makes lengths of rotations [m]
  };

  /**
   * A matrix of blocks seen by the rigid motions of its bricks, and by the modes of a border: P^T K P, which is small and which every rank
   * factorises by itself, so that all have the same bits. Held motions take no part.
   */
  class RigidBricks
  {
  public:
    /** @param links ends as rows, of the whole system @param share, border must outlive this object @param border null: there is none */
    RigidBricks(const RowParticles &rows, const LinkEnds &links, const RowShare &share, const BrickBorder *border);

    /**
     * @param matrix complete in the share's own rows
     * @param diagonal of the whole system with undamaged links; a tiny part of it keeps motions regular that nothing resists
     * @return false where it is singular
     */
    bool compute(const BlockMatrix &matrix, const Eigen::VectorXd &diagonal);

    /** z += P (P^T K P)^-1 P^T r, of the share's own rows. @param s, y the same of the border */
    void add_answer(const double *r, float *z, const Eigen::VectorXd &s, Eigen::VectorXd &y);

  private:
    static constexpr int rows_per_brick = static_cast<int>(particles_per_brick);

    Block rigid(int row) const; ///< motions of a row's particle per rigid motion of its brick
    void  condense(const BlockMatrix &matrix);
    void  add_border(std::vector<Eigen::Triplet<double>> &entries) const;
    /** Forces on rigid motions of bricks. @param on_rows forces on the rows to which the border is joined, six each, in columns */
    UnsymmetricFactor::Sparse on_bricks(const UnsymmetricFactor::Sparse &on_rows) const;
    int                       unknowns() const;
    /** @param kept added to its diagonal */
    UnsymmetricFactor::Sparse matrix_of_bricks(const Eigen::VectorXd &kept) const;

    RowParticles                 particles;
    const RowShare              &share;
    const BrickBorder           *border;
    std::vector<Eigen::Vector3d> middle; ///< of each brick [m]
    BlockPattern                 pattern;
    std::size_t                  widest = 0; ///< blocks of a row of bricks, at most
    base::Column                 blocks;     ///< `widest` for each brick
    UnsymmetricFactor            factor;
    base::Column                 forces; ///< of each brick
  };
} // namespace dem
