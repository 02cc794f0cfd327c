#pragma once

#include "dem/linear/block_jacobi.h"
#include "dem/linear/block_matrix.h"
#include "dem/linear/row_share.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace dem
{
  /**
   * A stiffness seen by the rigid motions of groups of particles that follow each other along its order: P^T K P, which is small and which every
   * rank factorises by itself, so that all have the same bits (doc/theory/statics.md, 2).
   *
   * A motion of a particle that none of its links resists takes no part, nor do held motions, nor particles that are linked to fewer others than a
   * group has.
   */
  class RigidGroups
  {
  public:
    /** Particles from which on groups are worth their sums and their factor. */
    static constexpr std::size_t fewest_particles = 4096;

    /** @param share must outlive this object @throws base::NumericalError where there is no factor */
    RigidGroups(const StiffnessOperator &stiffness, const RowShare &share);
    ~RigidGroups();

    /** z += P (P^T K P)^-1 P^T r of the share's own particles. All ranks call it together. */
    void add_answer(const Fields &r, Fields &z) const;

    /** Multiplications and additions of add_answer() with all lanes. */
    double operations() const;

  private:
    struct Factor;

    std::int32_t group_of(const std::int64_t particle) const { return static_cast<std::int32_t>(particle / of_group); }
    std::vector<std::uint8_t>    take_part(const StiffnessOperator &stiffness) const;
    void                         find_resisted(const StiffnessOperator &stiffness);
    Block                        rigid(std::int64_t particle) const;
    std::unique_ptr<BlockMatrix> condense(const StiffnessOperator &stiffness) const;
    Eigen::MatrixXd              on_groups(const Fields &r) const;

    const RowShare              &share;
    std::int64_t                 particles, of_group, groups;
    std::vector<Eigen::Vector3d> arm; ///< from the middle of its group to each particle, over the length of rotations
    std::vector<std::uint8_t>    partly; ///< whether a particle's links resist some motions alone
    /** Of those the part that they resist, a projection. */
    std::unordered_map<std::int64_t, Block> resisted;
    std::unique_ptr<Factor>                 factor; ///< behind a pointer: its header is for this file alone
  };

  /** Inverse of the particles' own blocks, and rigid motions of groups: z = D^-1 r + P (P^T K P)^-1 P^T r. */
  class BlocksAndGroups : public Preconditioner
  {
  public:
    BlocksAndGroups(const StiffnessOperator &stiffness, const RowShare &share)
      : blocks(stiffness, share.own())
      , groups(stiffness, share)
    {
    }
    void apply(const Fields &r, Fields &z) const override
    {
      blocks.apply(r, z);
      groups.add_answer(r, z);
    }
    double operations() const { return groups.operations(); }

  private:
    BlockJacobi blocks;
    RigidGroups groups;
  };
} // namespace dem
