#include "dem/linear/iterations.h"

#include "base/errors.h"
#include "dem/core/simd.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace dem
{
  namespace
  {
    using Lanes = Pack;

    /** Values per sum; sums are added in order, so that neither threads nor ranks change a bit. */
    constexpr std::int64_t values_per_sum = particles_per_sum * motions * load_lanes;

    Lanes pack_of(const std::array<double, load_lanes> &values) { return Lanes::load_unaligned(values.data()); }

    /** a/b where b > 0, else 0; never divides by zero. */
    Lanes quotient(const Lanes &a, const Lanes &b)
    {
      const auto safe = b > Lanes(0.0);
      return select(safe, a / select(safe, b, Lanes(1.0)), Lanes(0.0));
    }

    constexpr std::int64_t field_size = motions * load_lanes; ///< values of a particle

    /** Visit the values of the particles in the share, eight lanes at a time. */
    template <typename Body>
    void visit(const RowShare &share, const Body &body)
    {
      const std::int64_t first = share.own().first * field_size, end = share.own().end * field_size;
#pragma omp parallel for schedule(static)
      for (std::int64_t i = first; i < end; i += load_lanes)
        body(i);
    }

    /** The same, and add up what the body returns. @param values of all ranks */
    template <typename Body>
    Lanes sum_over(const RowShare &share, const std::size_t values, const Body &body)
    {
      const std::int64_t sums  = (static_cast<std::int64_t>(values) + values_per_sum - 1) / values_per_sum;
      const std::int64_t first = share.own().first / particles_per_sum, end = share.own().end * field_size;
      const std::int64_t behind = (end + values_per_sum - 1) / values_per_sum;
      base::Column       partial(sums * load_lanes);
#pragma omp parallel for schedule(static)
      for (std::int64_t k = first; k < behind; ++k)
        {
          Lanes sum = 0.0;
          for (std::int64_t i = k * values_per_sum; i < std::min(end, (k + 1) * values_per_sum); i += load_lanes)
            sum += body(i);
          store(sum, &partial[k * load_lanes]);
        }
      share.gather_sums(partial);
      Lanes sum = 0.0;
      for (std::int64_t k = 0; k < sums; ++k)
        sum += load(&partial[k * load_lanes]);
      return sum;
    }

    Lanes dot(const RowShare &share, const Fields &a, const Fields &b)
    {
      return sum_over(share, a.size(), [&](const std::int64_t i) { return load(&a[i]) * load(&b[i]); });
    }

    /** x += alpha p, r -= alpha q; returns r.r. */
    Lanes advance(const RowShare &share, const Lanes &alpha, const Fields &p, const Fields &q, Fields &x, Fields &r)
    {
      return sum_over(share, x.size(), [&](const std::int64_t i) {
        store(multiply_add(alpha, load(&p[i]), load(&x[i])), &x[i]);
        const Lanes next = negative_multiply_add(alpha, load(&q[i]), load(&r[i]));
        store(next, &r[i]);
        return next * next;
      });
    }

    /** p = z + beta p */
    void turn(const RowShare &share, const Lanes &beta, const Fields &z, Fields &p)
    {
      visit(share, [&](const std::int64_t i) { store(multiply_add(beta, load(&p[i]), load(&z[i])), &p[i]); });
    }

    /** r = b - K x, zero in held motions; returns r.r. */
    Lanes residual(RowShare &share, const StiffnessOperator &stiffness, const Fields &b, Fields &x, Fields &r)
    {
      share.receive(x);
      stiffness.apply(x, r, share.own());
      visit(share, [&](const std::int64_t i) { store(load(&b[i]) - load(&r[i]), &r[i]); });
      stiffness.mask(r, share.own());
      return dot(share, r, r);
    }

    void require_numbers(const Lanes &squares, const int iteration)
    {
      for (int lane = 0; lane < load_lanes; ++lane)
        if (!std::isfinite(static_cast<double>(squares[lane])))
          throw base::NumericalError("static solution: the residual of load case " + std::to_string(lane + 1) +
                                     " is not a number after " + std::to_string(iteration) + " iterations.");
    }

    void conclude(const Lanes &squares, const Lanes &target, const Lanes &scale, IterationReport &report)
    {
      report.converged     = !any(squares > target);
      const Lanes relative = square_root(quotient(squares, scale * scale));
      for (int lane = 0; lane < load_lanes; ++lane)
        report.residual[lane] = relative[lane];
    }
  } // namespace

  double IterationReport::largest_residual() const { return *std::max_element(residual.begin(), residual.end()); }

  IterationReport conjugate_gradients(const StiffnessOperator              &stiffness,
                                      const Preconditioner                 &preconditioner,
                                      const Fields                         &b,
                                      Fields                               &x,
                                      const std::array<double, load_lanes> &reference,
                                      const IterationLimits                &limits,
                                      RowShare                             &share)
  {
    const Lanes     scale  = pack_of(reference);
    const Lanes     target = Lanes(limits.tolerance * limits.tolerance) * scale * scale;
    Fields          r(x.size()), z(x.size()), p(x.size(), 0.0), q(x.size());
    IterationReport report;

    // A restart from the true residual costs one product and takes back what rounding has let the recurrence lose.
    constexpr int most_restarts = 5;
    Lanes         squares       = residual(share, stiffness, b, x, r);
    for (int restart = 0; restart <= most_restarts && report.iterations < limits.max_iterations; ++restart)
      {
        require_numbers(squares, report.iterations);
        if (!any(squares > target))
          break;
        Lanes rz = 0.0, current = squares;
        while (any(current > target) && report.iterations < limits.max_iterations)
          {
            preconditioner.apply(r, z);
            const Lanes next = dot(share, r, z);
            turn(share, quotient(next, rz), z, p);
            rz = next;
            share.receive(p);
            stiffness.apply(p, q, share.own());
            if (stiffness.anything_held())
              stiffness.mask(q, share.own());
            const Lanes alpha = select(current > target, quotient(rz, dot(share, p, q)), Lanes(0.0));
            current           = advance(share, alpha, p, q, x, r);
            ++report.iterations;
            require_numbers(current, report.iterations);
          }
        squares = residual(share, stiffness, b, x, r);
      }

    share.gather(x);
    conclude(squares, target, scale, report);
    return report;
  }

  IterationReport refine(const StiffnessOperator              &stiffness,
                         const Preconditioner                 &factor,
                         const Fields                         &b,
                         Fields                               &x,
                         const std::array<double, load_lanes> &reference,
                         const IterationLimits                &limits)
  {
    const Lanes     scale  = pack_of(reference);
    const Lanes     target = Lanes(limits.tolerance * limits.tolerance) * scale * scale;
    Fields          r(x.size()), z(x.size());
    IterationReport report;
    RowShare        alone(stiffness, nullptr);
    Lanes           squares = residual(alone, stiffness, b, x, r);
    require_numbers(squares, 0);
    while (any(squares > target) && report.iterations < limits.max_iterations)
      {
        factor.apply(r, z);
        const Lanes step = select(squares > target, Lanes(1.0), Lanes(0.0));
        visit(alone, [&](const std::int64_t i) { store(load(&x[i]) + step * load(&z[i]), &x[i]); });
        squares = residual(alone, stiffness, b, x, r);
        ++report.iterations;
        require_numbers(squares, report.iterations);
      }
    conclude(squares, target, scale, report);
    return report;
  }
} // namespace dem
