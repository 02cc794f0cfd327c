#pragma once

#include "dem/linear/brick_residuals.h"
#include "dem/network/loaded_network.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * The linearised equilibrium of a loaded network without body and ties, links of any stiffness (unsymmetric, indefinite), by iteration that
   * threads and ranks share out (doc/theory/quasi-static-path.md, 4). The same bits for any number of either. Each rank holds the rows of its own
   * particles.
   */
  class SharedTangent
  {
  public:
    /**
     * @param loaded must outlive this object
     * @param kept part of the undamaged diagonal that is added to the diagonal
     * @param ranks null: this process alone; otherwise they outlive this object
     */
    SharedTangent(const LoadedNetwork &loaded, double kept, Ranks *ranks);

    /**
     * All ranks call it together.
     * @param stiffness of each link, force and moment per slip and relative rotation [N/m], [N m]
     * @return false if a part of it cannot be factorised
     */
    bool set(const std::vector<base::Matrix6> &stiffness);

    /**
     * All ranks call it together.
     * @param force on each motion of each particle, moments over the scale [N], zero where held
     * @param accuracy largest residual over the forces
     * @param motion in: where to start; out: rotations times the scale [m] @return false if it was not reached
     */
    bool solve(const Eigen::VectorXd &force, double accuracy, Eigen::VectorXd &motion);

  private:
    struct End
    {
      std::size_t link;
      bool        second;
    };

    LinkEnds     ends_as_rows() const;
    RowParticles particles_of_rows() const;
    BlockMatrix  matrix_of_own_rows() const;
    void         find_ends();
    void         find_diagonal();
    void         assemble_row(int row, const std::vector<base::Matrix6> &stiffness);

    const LoadedNetwork          &loaded;
    double                        scale; ///< that makes lengths of rotations [m]
    double                        kept;
    std::vector<std::int32_t>     order;  ///< particle of each row
    std::vector<std::int32_t>     row_of; ///< each particle
    LinkEnds                      ends;   ///< of each link
    RowShare                      share;
    std::vector<std::vector<End>> ends_at;  ///< each of the share's own rows, in the links' order
    BlockMatrix                   matrix;   ///< own rows, and in those of ghosts what concerns them
    Eigen::VectorXd               diagonal; ///< of the undamaged links, by rows; where a motion meets none, the mean
    BrickFactor                   factor;
    BrickResiduals                iteration;
    base::Column                  right, found;
  };
} // namespace dem
