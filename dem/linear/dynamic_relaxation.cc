#include "dem/linear/dynamic_relaxation.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace dem
{
  namespace
  {
    /**
     * Sum of the absolute entries of each row of the stiffness: with these as masses the largest eigenvalue is at most one
     * (Gershgorin), and the stable step exactly two.
     */
    std::vector<double> row_sums(const StiffnessOperator &stiffness)
    {
      std::vector<double> mass(stiffness.particles() * motions, 0.0);
      const auto          add = [&](const std::int32_t i, const Block &block) {
        for (int c = 0; c < motions; ++c)
          mass[motions * i + c] += block.row(c).cwiseAbs().sum();
      };
      for (std::size_t l = 0; l < stiffness.links(); ++l)
        {
          const auto b = stiffness.link_blocks(l);
          add(b.first, b.JJ);
          add(b.first, b.JK);
          add(b.second, b.KK);
          add(b.second, b.JK.transpose());
        }
      return mass;
    }
  } // namespace

  IterationReport relax_dynamically(const StiffnessOperator              &stiffness,
                                    const Fields                         &b,
                                    Fields                               &x,
                                    const std::array<double, load_lanes> &reference,
                                    const DynamicRelaxationParameters    &p)
  {
    const std::vector<double> mass = row_sums(stiffness);
    const double              step = 2 * p.step_factor;
    Fields                    force(x.size()), v(x.size(), 0.0);
    IterationReport           report;
    for (;; ++report.iterations)
      {
        std::array<double, load_lanes> squares{};
        stiffness.apply(x, force);
        for (std::size_t i = 0; i < x.size(); ++i)
          force[i] = b[i] - force[i];
        stiffness.mask(force, stiffness.all());
        for (std::size_t i = 0; i < x.size(); ++i)
          squares[i % load_lanes] += force[i] * force[i];
        for (int lane = 0; lane < load_lanes; ++lane)
          report.residual[lane] = reference[lane] > 0 ? std::sqrt(squares[lane]) / reference[lane] : 0.0;
        if (!std::isfinite(report.largest_residual()))
          throw base::NumericalError("dynamic relaxation: the residual is not a number after " +
                                     std::to_string(report.iterations) + " steps.");
        report.converged = report.largest_residual() <= p.limits.tolerance;
        if (report.converged || report.iterations == p.limits.max_iterations)
          return report;

        for (std::size_t i = 0; i < x.size(); ++i)
          {
            if (mass[i / load_lanes] == 0)
              continue;
            const double a     = force[i] / mass[i / load_lanes];
            const double along = a * (v[i] + 0.5 * step * a);
            const double sign  = along > 0 ? 1.0 : along < 0 ? -1.0 : 0.0;
            v[i] += step * a * (1 - p.damping * sign);
            x[i] += step * v[i];
          }
      }
  }
} // namespace dem
