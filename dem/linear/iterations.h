#pragma once

#include "dem/linear/preconditioner.h"
#include "dem/linear/row_share.h"

#include <array>
#include <functional>

namespace dem
{
  /** When to stop. */
  struct IterationLimits
  {
    double tolerance      = 1e-10; ///< largest residual of a lane over its reference
    int    max_iterations = 0;     ///< > 0
  };

  /** How it went. */
  struct IterationReport
  {
    int                            iterations = 0;
    std::array<double, load_lanes> residual; ///< true residual b - K x over the reference, measured at the end
    bool                           converged = false;

    double largest_residual() const;
  };

  /**
   * Conjugate gradients on all lanes at once (each lane its own, one pass over the links for all): K x = b, K symmetric
   * positive semi-definite and b in its range.
   *
   * What K does not see (mechanisms, rigid motion) stays in x as it was at the start. Ranks share the work of each iteration; what comes out has the
   * same bits for any number of them.
   *
   * @param preconditioner of the share's own particles, at least
   * @param b          of the share's own particles, at least
   * @param x          in: start, zero in held motions; out: solution
   * @param reference  per lane [N], what the norm of the residual is compared with
   * @throws base::NumericalError when a residual is no longer a number.
   */
  IterationReport conjugate_gradients(const StiffnessOperator              &stiffness,
                                      const Preconditioner                 &preconditioner,
                                      const Fields                         &b,
                                      Fields                               &x,
                                      const std::array<double, load_lanes> &reference,
                                      const IterationLimits                &limits,
                                      RowShare                             &share);

  /**
   * The same for a preconditioner as good as exact (a factor), by each rank alone: x += M^-1 (b - K x) until converged. Unlike conjugate gradients
   * it is not disturbed by rounding in motions that K does not see and M^-1 enlarges.
   */
  IterationReport refine(const StiffnessOperator              &stiffness,
                         const Preconditioner                 &factor,
                         const Fields                         &b,
                         Fields                               &x,
                         const std::array<double, load_lanes> &reference,
                         const IterationLimits                &limits);
} // namespace dem
