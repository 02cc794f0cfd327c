#include "dem/linear/unsymmetric_factor.h"

#include "base/solver_turns.h"

#include <Eigen/UmfPackSupport>

namespace dem
{
  struct UnsymmetricFactor::Lu : Eigen::UmfPackLU<Sparse>
  {
    double operations() const { return m_umfpackInfo[UMFPACK_FLOPS]; }
  };

  UnsymmetricFactor::UnsymmetricFactor()
    : lu(std::make_unique<Lu>())
  {
  }

  UnsymmetricFactor::~UnsymmetricFactor() = default;

  double UnsymmetricFactor::operations() const { return lu->operations(); }

  bool UnsymmetricFactor::factorize(const Sparse &matrix, const bool zeros_on_diagonal)
  {
    if (!ordered)
      {
        const auto turn                        = base::ordering_turn();
        lu->umfpackControl()[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
        lu->umfpackControl()[UMFPACK_STRATEGY] = zeros_on_diagonal ? UMFPACK_STRATEGY_AUTO : UMFPACK_STRATEGY_SYMMETRIC;
        lu->umfpackControl()[UMFPACK_IRSTEP]   = 0;
        lu->analyzePattern(matrix);
        ordered = true;
      }
    const auto turn = base::dense_kernels_turn();
    lu->factorize(matrix);
    return lu->info() == Eigen::Success;
  }

  Eigen::MatrixXd UnsymmetricFactor::solve(const Eigen::MatrixXd &right) const
  {
    const auto turn = base::dense_kernels_turn();
    return lu->solve(right);
  }
} // namespace dem
