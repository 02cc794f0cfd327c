#include "base/errors.h"
#include "dem/packing/compaction_on_ranks.h"
#include "dem/packing/frictional_assembly.h"
#include "dem/packing/sequential_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    constexpr std::int64_t steps_between_checks = 20;
    constexpr double       pressure_tolerance   = 0.01;
    constexpr double       largest_edge_change  = 0.01; // per step, in diameters
    /// Strain of the cell per step over the missing pressure p 2r/k_n. A packing with 6 contacts per sphere answers a strain
    /// with 1.1 times as much pressure, so this closes a twentieth of the gap per step: slower than the spheres' own
    /// vibrations (20 steps), faster than waves across the cell.
    constexpr double servo_gain = 0.05;

    struct Stage
    {
      int    number;
      double target; // p 2r/k_n
      double unbalanced_limit;
    };

    void require(const char *entry, const double value, const double low, const double high, const char *rule)
    {
      if (std::isfinite(value) && value >= low && value <= high)
        return;
      std::ostringstream text;
      text << "compaction: " << entry << " = " << value << ": must be " << rule << '.';
      throw base::InputError(text.str());
    }

    void check(const CompactionParameters &p)
    {
      constexpr double largest = std::numeric_limits<double>::max(), above_zero = std::numeric_limits<double>::min();
      const double     below_one = std::nextafter(1.0, 0.0);
      require("radius", p.radius, 1e-12, 1e9, "a length from 1e-12 to 1e9 m");
      require("count", static_cast<double>(p.count), 1, 1e8, "from 1 to 1e8 spheres");
      require("friction", p.friction, 0, largest, "finite and not negative");
      require("damping", p.damping, 0, below_one, "at least 0 and below 1");
      require("shear ratio", p.shear_ratio, 0, 1, "from 0 to 1");
      require("initial spacing", p.initial_spacing, 2.4, 10, "from 2.4 (denser, random places run out) to 10");
      require("low pressure", p.low_pressure, above_zero, 0.5, "above zero and below the high pressure");
      require("high pressure", p.high_pressure, std::nextafter(p.low_pressure, 1.0), 0.5,
              "above the low pressure, at most 0.5");
      require("proportions", p.proportions.minCoeff() / p.proportions.maxCoeff(), 1e-3, 1,
              "above zero, none a thousandth of another");
      require("time step factor", p.time_step_factor, above_zero, 1.2, "above 0, at most 1.2");
      require("step limit", static_cast<double>(p.step_limit), 1, largest, "above zero");
    }

    /** One compaction under way; pressures as p 2r/k_n, which is twice that of the assembly's units. */
    class Compaction
    {
    public:
      Compaction(const CompactionParameters                            &p,
                 const std::function<bool(const CompactionProgress &)> &on_progress,
                 Ranks *const                                           ranks)
        : parameters(p)
        , progress(on_progress)
        , assembly(loose_spheres(p), {p.friction, p.shear_ratio, p.damping, time_step(p), p.moulded}, ranks)
      {
      }

      CompactionResult run()
      {
        hold({1, parameters.high_pressure, 1e-2});
        hold({2, parameters.low_pressure, 1e-3});
        const AssemblyMeasures m = assembly.measures();
        return {frozen(),
                assembly.edges() * parameters.radius,
                packing_fraction(),
                assembly.mean_overlap() / 2,
                m.unbalanced_ratio,
                2 * static_cast<double>(m.contacts) / static_cast<double>(parameters.count),
                steps};
      }

    private:
      static Packing loose_spheres(const CompactionParameters &p)
      {
        if (p.moulded)
          return in_loose_mould(p);
        const Eigen::Vector3d shape = p.proportions / std::cbrt(p.proportions.prod());
        return place_sequentially(p.count, 1.0, p.initial_spacing * std::cbrt(static_cast<double>(p.count)) * shape,
                                  p.seed);
      }

      /** Away from the plates by a radius, in a cell whose shrinking leaves plates of the requested proportions. */
      static Packing in_loose_mould(const CompactionParameters &p)
      {
        const double          count = static_cast<double>(p.count), loose = std::pow(p.initial_spacing, 3) * count;
        const double          solid = 4.0 / 3.0 * M_PI * count;
        const Eigen::Vector3d last =
          p.proportions * std::cbrt(solid / expected_packing_fraction(p.friction) / p.proportions.prod());
        const auto room = [&](const double growth) -> Eigen::Array3d {
          return growth * (last.array() + beyond_plates) - beyond_plates - 2;
        };
        double small = 1, large = 2 + 10 / last.minCoeff() + p.initial_spacing;
        while (large - small > 1e-12 * large)
          {
            const double middle                                                          = 0.5 * (small + large);
            (room(middle).minCoeff() > 0 && room(middle).prod() > loose ? large : small) = middle;
          }
        Packing packing = place_sequentially(p.count, 1.0, room(large).matrix(), p.seed);
        for (Eigen::Vector3d &centre : packing.centre)
          centre.array() += 1;
        packing.periodic_cell = (room(large) + beyond_plates + 2).matrix();
        return packing;
      }

      /** P-wave time in sqrt(mass/k_n), with k_n = modulus radius. */
      static double time_step(const CompactionParameters &p)
      {
        return p.time_step_factor * std::sqrt(3.0 / (4.0 * M_PI));
      }

      double packing_fraction() const
      {
        return 4.0 / 3.0 * M_PI * static_cast<double>(parameters.count) / assembly.edges().prod();
      }

      /** Strain of the cell in the next step. @param pressure in the units of the assembly */
      double servo(const Stage &stage, const double pressure) const
      {
        const double wanted = servo_gain * (2 * pressure - stage.target);
        const double limit  = 2 * largest_edge_change / assembly.edges().maxCoeff();
        return std::clamp(wanted, -limit, limit);
      }

      void hold(const Stage &stage)
      {
        for (;;)
          {
            assembly.advance(steps_between_checks, [&](const double pressure) { return servo(stage, pressure); });
            steps += steps_between_checks;

            const AssemblyMeasures m        = assembly.measures();
            const double           relative = 2 * m.pressure / stage.target;
            if (!std::isfinite(relative))
              throw base::NumericalError("compaction: the pressure is no longer a number after step " +
                                         std::to_string(steps) + ".");
            if (progress && !progress({stage.number, steps, packing_fraction(), relative, m.unbalanced_ratio}))
              throw CompactionCancelled();
            if (std::abs(relative - 1) < pressure_tolerance && m.unbalanced_ratio < stage.unbalanced_limit)
              return;
            if (steps >= parameters.step_limit)
              give_up(stage, relative, m.unbalanced_ratio);
          }
      }

      [[noreturn]] void give_up(const Stage &stage, const double relative_pressure, const double unbalanced) const
      {
        std::ostringstream text;
        text << "compaction: no equilibrium within step limit = " << parameters.step_limit << ": stage " << stage.number
             << " of 2, packing fraction " << packing_fraction() << ", pressure " << relative_pressure
             << " of its target (allowed 0.99 to 1.01), unbalanced ratio " << unbalanced << " (allowed "
             << stage.unbalanced_limit << "). Raise the step limit or the damping, or take another seed.";
        throw CompactionFailed(text.str());
      }

      Packing frozen() const
      {
        Packing packing;
        packing.centre = assembly.centres();
        for (Eigen::Vector3d &x : packing.centre)
          x *= parameters.radius;
        packing.radius.assign(parameters.count, parameters.radius);
        if (!parameters.moulded)
          packing.periodic_cell = assembly.edges() * parameters.radius;
        return packing;
      }

      const CompactionParameters                            &parameters;
      const std::function<bool(const CompactionProgress &)> &progress;
      FrictionalAssembly                                     assembly;
      std::int64_t                                           steps = 0;
    };
  } // namespace

  double expected_packing_fraction(const double friction)
  {
    constexpr double table[][2] = {{0, 0.6466},   {0.1, 0.6150}, {0.2, 0.5933}, {0.5, 0.5657},
                                   {0.8, 0.5568}, {1.0, 0.5512}, {2.0, 0.5472}};
    constexpr int    rows       = sizeof(table) / sizeof(table[0]);
    for (int i = 1; i < rows; ++i)
      if (friction <= table[i][0])
        {
          const double part = (friction - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
          return table[i - 1][1] + part * (table[i][1] - table[i - 1][1]);
        }
    return table[rows - 1][1];
  }

  std::size_t count_to_fill(const Eigen::Vector3d &box, const double radius, const double friction)
  {
    constexpr double spare = 1.01 * 1.01 * 1.01;
    return static_cast<std::size_t>(
      std::ceil(spare * expected_packing_fraction(friction) * box.prod() / (4.0 / 3.0 * M_PI * std::pow(radius, 3))));
  }

  CompactionResult compact_on(Ranks *const                                           ranks,
                              const CompactionParameters                            &parameters,
                              const std::function<bool(const CompactionProgress &)> &progress)
  {
    check(parameters);
    return Compaction(parameters, progress, ranks).run();
  }

  CompactionResult compact(const CompactionParameters                            &parameters,
                           const std::function<bool(const CompactionProgress &)> &progress)
  {
    return compact_on(nullptr, parameters, progress);
  }
} // namespace dem
