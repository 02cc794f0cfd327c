#pragma once

#include "base/column.h"
#include "base/matrix6.h"
#include "dem/network/elastic_network.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace dem
{
  /** Load cases that are solved side by side, one in each lane of a pack. */
  constexpr int load_lanes = 8;

  /** Unknowns of a particle: three displacements, three rotations times the length scale, so that all six are lengths. */
  constexpr int motions = 6;

  /**
   * Displacement (or force) fields of all load cases: value(particle, motion, lane) stands at
   * (particle * motions + motion) * load_lanes + lane. [m] or [N].
   */
  using Fields = base::Column;

  using Block = Eigen::Matrix<double, motions, motions>;

  /** Bit c set: motion c of the particle is held (or does not exist). */
  using HeldMotions = std::uint8_t;

  /** A small strain per lane; engineering shears, order 11 22 33 23 31 12. */
  using LaneStrains = std::array<base::Vector6, load_lanes>;

  /** Whether a macroscopic strain moves a link by its whole branch, or only by the cell's share of it. */
  enum class CellFormulation
  {
    fluctuation, ///< unknowns are the fluctuations about the affine field: slip += E l
    total        ///< unknowns are total displacements: only links that cross the cell feel it, slip += E H k
  };

  /** Particles that follow each other in the operator's order. */
  struct ParticleRange
  {
    std::int64_t first = 0, end = 0;
  };

  /**
   * The stiffness of a network, applied link by link without a matrix, to eight fields at once.
   *
   * Every particle gathers from its links in a fixed order: the same bits for any number of threads. Particles are
   * renumbered along a space-filling curve; order() translates.
   */
  class StiffnessOperator
  {
  public:
    /** @param held one entry per particle of the network, or empty: nothing is held */
    StiffnessOperator(const ElasticNetwork           &network,
                      const std::vector<HeldMotions> &held,
                      CellFormulation                 formulation = CellFormulation::fluctuation);

    std::size_t particles() const { return masks.size(); }
    std::size_t links() const { return records.size(); }
    double      length_scale() const { return scale; } ///< rotations are multiplied by it [m]

    /** order()[k]: number in the network of the k-th particle here. */
    const std::vector<std::int32_t> &order() const { return numbers; }
    /** Of the particles here [m]. */
    const std::vector<Eigen::Vector3d> &places() const { return centres; }

    /** Give every link, in the network's order, another stiffness (as it is damaged). */
    void set_stiffness(const std::vector<Eigen::Matrix3d> &stiffness);

    /** y = K x on all particles, held ones included (there: what the supports have to give). */
    void apply(const Fields &x, Fields &y) const;
    /** Internal forces under the fields x and the macroscopic strains. */
    void apply(const Fields &x, const LaneStrains &strain, Fields &y) const;
    /** y = K x on some particles; the others of y stay as they are. */
    void apply(const Fields &x, Fields &y, const ParticleRange &of) const;
    /** Set the held motions of some particles to zero. */
    void          mask(Fields &x, const ParticleRange &of) const;
    ParticleRange all() const { return {0, static_cast<std::int64_t>(particles())}; }
    bool          is_held(const std::size_t particle, const int motion) const { return masks[particle] >> motion & 1; }
    bool          anything_held() const { return some_held; }

    /** Root of the sum of squared link forces of each lane: what an unbalanced force is compared with [N]. */
    std::array<double, load_lanes> link_force_norm(const Fields &x, const LaneStrains &strain) const;

    /** (1/2) sum of slip C slip over pairs of lanes: twice the energy of the fields i and j, i, j < 6 [J]. */
    base::Matrix6 energy_product(const Fields &x, const LaneStrains &strain) const;

    /** The block of the stiffness between two motions of one particle. */
    std::vector<Block> diagonal_blocks() const;

    /** One link's contribution to the stiffness: blocks JJ, JK, KK (KJ is the transpose of JK). */
    struct LinkBlocks
    {
      std::int32_t first, second;
      Block        JJ, JK, KK;
    };
    LinkBlocks link_blocks(std::size_t link) const;

    /** Both ends of a link. */
    std::pair<std::int32_t, std::int32_t> ends(const std::size_t link) const
    {
      return {records[link].first, records[link].second};
    }
    /** How many link ends a particle has. */
    std::size_t links_of(const std::size_t particle) const { return begin[particle + 1] - begin[particle]; }

  private:
    struct Record
    {
      std::int32_t    first, second;
      Eigen::Vector3d n, macro;              ///< direction; E macro is the slip of a macroscopic strain
      double          arm_first, arm_second; ///< over the length scale
      double          c11, c22, c33, c23, c31, c12;
      std::int32_t    number; ///< of the link in the network

      void            set_stiffness(const Eigen::Matrix3d &C);
      Eigen::Matrix3d stiffness() const;
    };
    struct Entry
    {
      std::int32_t link, side;
    };

    template <bool strained, bool turning>
    void gather(const Fields &x, const LaneStrains &strain, Fields &y, const ParticleRange &of) const;
    Eigen::Matrix<double, 3, 6> slips(const Record &link, const Fields &x, const LaneStrains &strain) const;
    Eigen::Matrix<double, 3, 6> turns(const Record &link, const Fields &x) const;

    std::vector<Record> records;
    std::vector<Record> turning; ///< of each record its moment over relative rotation, over the scale squared; or empty
    std::vector<std::int64_t>    begin; ///< entries of particle i: begin[i] .. begin[i + 1]
    std::vector<Entry>           entries;
    std::vector<HeldMotions>     masks;
    std::vector<std::int32_t>    numbers;
    std::vector<Eigen::Vector3d> centres;
    double                       scale     = 1;
    bool                         some_held = false;
  };

} // namespace dem
