#include "dem/linear/block_jacobi.h"

#include "dem/core/simd.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace dem
{
  namespace
  {
    /** Pivots of a well supported particle stay far above this; below, eigenvalues decide. */
    constexpr double safe_pivot = 1e-6;
    /** Relative stiffness taken for none (doc/theory/statics.md, 3). */
    constexpr double no_stiffness = 1e-10;

    Block without_held(Block block, const HeldMotions held)
    {
      for (int c = 0; c < motions; ++c)
        if (held >> c & 1)
          {
            block.row(c).setZero();
            block.col(c).setZero();
          }
      return block;
    }

    /** False if the block is not safely positive definite. */
    bool invert(const Block &block, Block &inverse)
    {
      const Eigen::LLT<Block> factor(block);
      if (factor.info() != Eigen::Success)
        return false;
      const auto pivots = factor.matrixLLT().diagonal().array().square();
      if (!(pivots.minCoeff() > safe_pivot * block.diagonal().maxCoeff()))
        return false;
      inverse = factor.solve(Block::Identity());
      return true;
    }
  } // namespace

  Block pseudo_inverse(const Block &block, const HeldMotions held, const double cut)
  {
    Block inverse;
    if (held == 0 && invert(block, inverse))
      return inverse;
    const Eigen::SelfAdjointEigenSolver<Block> eigen(without_held(block, held));
    const double                               largest = eigen.eigenvalues().maxCoeff();
    inverse.setZero();
    for (int k = 0; k < motions; ++k)
      if (eigen.eigenvalues()[k] > cut * largest && largest > 0)
        inverse += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / eigen.eigenvalues()[k];
    return without_held(inverse, held);
  }

  Block particle_inverse(const StiffnessOperator &stiffness, const Block &own, const std::size_t particle)
  {
    HeldMotions held = 0;
    for (int c = 0; c < motions; ++c)
      if (stiffness.is_held(particle, c))
        held |= HeldMotions(1u << c);
    return pseudo_inverse(own, held, no_stiffness);
  }

  BlockJacobi::BlockJacobi(const StiffnessOperator &stiffness, const ParticleRange &of)
    : range(of)
    , inverse(stiffness.diagonal_blocks())
  {
    for (std::int64_t i = range.first; i < range.end; ++i)
      inverse[i] = particle_inverse(stiffness, inverse[i], i);
  }

  void BlockJacobi::apply(const Fields &r, Fields &z) const
  {
#pragma omp parallel for schedule(static)
    for (std::int64_t i = range.first; i < range.end; ++i)
      {
        Pack in[motions];
        for (int c = 0; c < motions; ++c)
          in[c] = load(&r[(motions * i + c) * load_lanes]);
        for (int row = 0; row < motions; ++row)
          {
            Pack sum = inverse[i](row, 0) * in[0];
            for (int c = 1; c < motions; ++c)
              sum = multiply_add(Pack(inverse[i](row, c)), in[c], sum);
            store(sum, &z[(motions * i + row) * load_lanes]);
          }
      }
  }
} // namespace dem
