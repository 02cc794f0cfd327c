#include "dem/laboratory/test_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dem
{
  namespace
  {
    /** Part of the peak at which moduli are read, and the window of the lines through it. */
    constexpr double middle = 0.5, window_from = 0.45, window_to = 0.55;
    /** Part of the curve that the smoothed strength is a mean over. */
    constexpr double smoothed_part = 0.005;
    /** Stress, as part of the peak, from which a loading is checked for being static: below there is hardly any force. */
    constexpr double looked_at_from = 0.1;
    constexpr int    least_rows     = 3; ///< of a line

    struct Rows
    {
      std::size_t from = 0, to = 0;
      std::size_t at_half = 0; ///< first row at half the peak or above

      std::size_t count() const { return to - from; }
    };

    /** Rows of the window on the first way up. */
    Rows window(const std::vector<double> &load, const double peak)
    {
      Rows       found;
      const auto first = std::find_if(load.begin(), load.end(), [&](const double s) { return s >= middle * peak; });
      found.at_half    = static_cast<std::size_t>(first - load.begin());
      auto from        = first;
      while (from != load.begin() && *(from - 1) >= window_from * peak)
        --from;
      auto to = first;
      while (to != load.end() && *to <= window_to * peak)
        ++to;
      found.from = static_cast<std::size_t>(from - load.begin());
      found.to   = static_cast<std::size_t>(to - load.begin());
      return found;
    }

    /** Slope of the least-squares line. */
    Finding slope(const std::vector<double> &x, const std::vector<double> &y, const Rows &rows)
    {
      if (rows.count() < least_rows)
        return Finding::none("fewer than three rows of the curve lie about half of the largest stress");
      const auto n    = static_cast<double>(rows.count());
      const auto mean = [&](const std::vector<double> &v) {
        return std::accumulate(v.begin() + static_cast<std::ptrdiff_t>(rows.from),
                               v.begin() + static_cast<std::ptrdiff_t>(rows.to), 0.0) /
               n;
      };
      const double mx = mean(x), my = mean(y);
      double       xx = 0, xy = 0;
      for (std::size_t r = rows.from; r < rows.to; ++r)
        {
          xx += (x[r] - mx) * (x[r] - mx);
          xy += (x[r] - mx) * (y[r] - my);
        }
      return xx > 0 ? Finding::of(xy / xx) :
                      Finding::none("the strain does not change about half of the largest stress");
    }

    std::vector<double> load_of(const TestCurve &curve)
    {
      std::vector<double> load = curve.record.values(TestRecord::stress);
      for (double &each : load)
        each -= curve.offset;
      return load;
    }

    double largest_mean(const std::vector<double> &load)
    {
      const auto wide =
        std::max<std::size_t>(1, static_cast<std::size_t>(smoothed_part * static_cast<double>(load.size())));
      double sum = 0, largest = -std::numeric_limits<double>::infinity();
      for (std::size_t r = 0; r < load.size(); ++r)
        {
          sum += load[r];
          if (r >= wide)
            sum -= load[r - wide];
          if (r + 1 >= wide)
            largest = std::max(largest, sum / static_cast<double>(wide));
        }
      return largest;
    }

    void read_moduli(TestFigures &found, const TestCurve &curve, const std::vector<double> &load)
    {
      const auto strain   = curve.record.values(TestRecord::strain),
                 gauge    = curve.record.values(TestRecord::gauge_strain),
                 lateral  = curve.record.values(TestRecord::lateral_strain);
      const Rows rows     = window(load, curve.peak);
      found.modulus       = slope(strain, load, rows);
      found.gauge_modulus = slope(gauge, load, rows);
      const std::size_t h = rows.at_half;
      if (h < load.size() && strain[h] != strain.front())
        found.secant_modulus = Finding::of((load[h] - load.front()) / (strain[h] - strain.front()));
      else
        found.secant_modulus = Finding::none("the curve has no row at half of the largest stress");
      // Compression is positive, and growing wider: their ratio is Poisson's. Pulled, the specimen grows thinner.
      const double sign   = curve.compress ? 1 : -1;
      const auto   turned = [sign](Finding f) { return f.value *= sign, f; };
      found.poisson_slope = turned(slope(gauge, lateral, rows));
      if (h < load.size() && gauge[h] != gauge.front())
        found.poisson_secant = Finding::of(sign * (lateral[h] - lateral.front()) / (gauge[h] - gauge.front()));
      else
        found.poisson_secant = Finding::none("the gauges do not move up to half of the largest stress");
    }
  } // namespace

  TestFigures figures_of(const TestCurve &curve)
  {
    TestFigures found;
    const auto  none = Finding::none("the specimen never resisted the load");
    if (!(curve.peak > 0) || curve.record.rows() == 0)
      {
        for (Finding *each :
             {&found.largest_stress, &found.strength, &found.smooth_strength, &found.strain_at_peak, &found.modulus,
              &found.gauge_modulus, &found.secant_modulus, &found.poisson_secant, &found.poisson_slope})
          *each = none;
        return found;
      }
    const auto load = load_of(curve);
    const auto not_passed =
      Finding::none("the largest stress may be passed yet: it had not fallen for good when the run ended");
    found.largest_stress  = Finding::of(curve.peak);
    found.strength        = curve.past ? Finding::of(curve.peak) : not_passed;
    found.smooth_strength = curve.past ? Finding::of(largest_mean(load)) : not_passed;
    found.strain_at_peak  = curve.past ? Finding::of(curve.at_peak) : not_passed;
    read_moduli(found, curve, load);
    return found;
  }

  Finding effect_of_speed(const TestFigures &test, const TestFigures &slow)
  {
    if (!test.strength.found)
      return Finding::none("the strength is not determined");
    if (!slow.strength.found)
      return Finding::none("at half the speed the strength is not determined: " + slow.strength.why_not);
    return Finding::of(std::abs(slow.strength.value / test.strength.value - 1));
  }

  QuasiStatic quasi_static(const TestCurve &curve)
  {
    QuasiStatic       found;
    const TestRecord &r     = curve.record;
    const auto        load  = load_of(curve);
    double            apart = 0, kinetic = 0, unbalanced = 0;
    bool              checked = false, worked = false;
    for (std::size_t row = 0; row < r.rows() && r.at(row, TestRecord::strain) <= curve.at_peak; ++row)
      {
        if (!(curve.peak > 0) || load[row] < looked_at_from * curve.peak)
          continue;
        checked           = true;
        const double mean = 0.5 * (r.at(row, TestRecord::low) + r.at(row, TestRecord::high));
        apart             = std::max(apart, r.at(row, TestRecord::imbalance) / std::abs(mean));
        unbalanced        = std::max(unbalanced, r.at(row, TestRecord::force_ratio));
        if (r.at(row, TestRecord::work) > 0)
          {
            worked  = true;
            kinetic = std::max(kinetic, r.at(row, TestRecord::kinetic) / r.at(row, TestRecord::work));
          }
      }
    const char *const unseen = "no row of the curve lies between a tenth of the largest stress and it";
    found.imbalance          = checked ? Finding::of(apart) : Finding::none(unseen);
    found.force_ratio        = checked ? Finding::of(unbalanced) : Finding::none(unseen);
    found.kinetic = worked ? Finding::of(kinetic) : Finding::none("no work was done up to the largest stress");
    return found;
  }
} // namespace dem
