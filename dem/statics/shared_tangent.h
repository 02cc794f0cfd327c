#pragma once

#include "dem/linear/brick_residuals.h"
#include "dem/network/loaded_network.h"
#include "dem/statics/tied_zone.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * The linearised equilibrium of a loaded network, links of any stiffness (unsymmetric, indefinite), by iteration that threads and ranks share
   * out (doc/theory/quasi-static-path.md, 4). The same bits for any number of either. Each rank holds the rows of its own particles, and all of
   * what is tied, or joint of a body.
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
     * @param force on each motion of each carrier, moments over the scale [N], zero where held
     * @param accuracy largest residual over the forces
     * @param motion of each carrier, and multipliers (SurroundedSystem::multipliers()); in: where to start; out: rotations times the scale [m]
     * @return false if it was not reached
     */
    bool solve(const Eigen::VectorXd &force, double accuracy, Eigen::VectorXd &motion);

  private:
    struct End
    {
      std::size_t link;
      bool        second;
    };

    std::optional<TiedZone>   tied_zone() const;
    std::vector<std::int32_t> particles_by_rows() const;
    LinkEnds                  ends_as_rows() const;
    RowParticles              particles_of_rows() const;
    BlockMatrix               matrix_of_own_rows() const;
    std::int32_t row(const std::int32_t particle) const { return row_of[static_cast<std::size_t>(particle)]; }
    void         find_ends();
    void         find_diagonal();
    void         assemble_row(int row, const std::vector<base::Matrix6> &stiffness);

    const LoadedNetwork          &loaded;
    double                        scale; ///< that makes lengths of rotations [m]
    double                        kept;
    std::optional<TiedZone>       zone;   ///< none: nothing is tied
    std::vector<std::int32_t>     order;  ///< particle of each row: those beside the zone
    std::vector<std::int32_t>     row_of; ///< each particle, -1 in the zone
    LinkEnds                      ends;   ///< of each link between rows
    RowShare                      share;
    std::unique_ptr<BrickBorder>  border;         ///< the zone
    bool                          answers = true; ///< whether the zone has a factor
    std::vector<std::vector<End>> ends_at;        ///< each of the share's own rows, in the links' order
    BlockMatrix                   matrix;         ///< own rows, and in those of ghosts what concerns them
    Eigen::VectorXd               diagonal; ///< of the undamaged links, by rows; where a motion meets none, the mean
    BrickFactor                   factor;
    BrickResiduals                iteration;
    BrickVector                   right, found;
  };
} // namespace dem
