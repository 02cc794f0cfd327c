#pragma once

#include "dem/linear/brick_border.h"
#include "dem/network/loaded_network.h"
#include "dem/statics/surrounded_system.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * What of a loaded network ties and a body take part in: the carriers that are tied or joints, with the links that end in them. Where the
   * rest is iterated, bricks of particles by ranks, this is its border, and answered by a factor of its own (doc/theory/quasi-static-path.md, 4).
   */
  class TiedZone
  {
  public:
    using Sparse = Eigen::SparseMatrix<double>;

    /** @param loaded must outlive this object @param scale that makes lengths of rotations [m] @param kept part of the undamaged diagonal that is added to the diagonal */
    TiedZone(const LoadedNetwork &loaded, double scale, double kept);

    bool                            holds(const std::size_t carrier) const { return inside[carrier]; }
    const std::vector<std::size_t> &links() const { return touching; } ///< with an end in it

    /**
     * The border of the other particles' rows. @param row of each particle, -1 in the zone @param share must outlive the border
     */
    std::unique_ptr<BrickBorder> border(const std::vector<std::int32_t> &row, const RowShare &share);

    /** @param stiffness of each link */
    BrickBorder::Blocks blocks(const std::vector<base::Matrix6> &stiffness);
    bool                has_multipliers() const { return around->has_multipliers(); }

    /** On its unknowns. @param on_carriers on each motion of each carrier, moments over the scale [N] */
    Eigen::VectorXd forces(const Eigen::VectorXd &on_carriers) const;
    /** @param of_carriers their motions, rotations times the scale [m], then multipliers */
    Eigen::VectorXd unknowns_of(const Eigen::VectorXd &of_carriers) const;
    /** And back: those of the zone are set, and the multipliers. */
    void put(const Eigen::VectorXd &unknowns, Eigen::VectorXd &of_carriers) const;

  private:
    void   find_carriers();
    void   number_unknowns();
    Sparse common_unknowns() const;
    /** Of a particle beside the zone that it is joined to; -1 where held, or no such. */
    int joined_unknown(std::int32_t particle, int motion) const;

    const LoadedNetwork            &loaded;
    double                          scale, kept;
    std::vector<char>               inside; ///< of each carrier
    std::vector<std::size_t>        touching;
    std::vector<int>                unknown; ///< of each motion of each carrier, -1 where held or not of the zone
    int                             count = 0;
    std::vector<std::int32_t>       place_of_row; ///< of each particle among the joined rows, -1 where it is none
    std::size_t                     joined = 0;   ///< rows
    Eigen::VectorXd                 diagonal;     ///< of the undamaged links
    std::optional<SurroundedSystem> around;
    Sparse                          by_unknowns;
  };
} // namespace dem
