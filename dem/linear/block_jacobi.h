#pragma once

#include "dem/linear/preconditioner.h"

namespace dem
{
  /**
   * Inverse of each particle's own 6 x 6 block.
   *
   * A motion to which none of the particle's links answers (a floater's, or the spin of a particle with two links) gives a
   * singular block; the pseudo-inverse leaves that motion where it is.
   */
  class BlockJacobi : public Preconditioner
  {
  public:
    /** @param of particles that it is for; the others of z stay as they are */
    BlockJacobi(const StiffnessOperator &stiffness, const ParticleRange &of);
    void apply(const Fields &r, Fields &z) const override;

  private:
    ParticleRange      range;
    std::vector<Block> inverse;
  };

  /**
   * Pseudo-inverse of a symmetric positive semi-definite block; eigenvalues below `cut` times the largest count as zero.
   * Rows and columns of held motions are left out and come back as zero.
   */
  Block pseudo_inverse(const Block &block, HeldMotions held, double cut);

  /** Of a particle's own block: motions that nothing resists, and held ones, stay where they are. */
  Block particle_inverse(const StiffnessOperator &stiffness, const Block &own, std::size_t particle);
} // namespace dem
