#pragma once

#include "apps/bench/results.h"
#include "apps/bench/uniaxial_cases.h"
#include "apps/runs/uniaxial/result.h"
#include "apps/statistics/sample.h"

#include <string>
#include <vector>

namespace apps
{
  /** Values of one figure, one per seed. */
  struct Scatter
  {
    std::vector<double> values;
    double              mean() const { return statistics::moments_of(values).mean; }
    double              deviation() const { return statistics::moments_of(values).deviation; }
  };

  /** What one case gave, over its seeds. */
  struct UniaxialMeasurement
  {
    UniaxialCase which;

    Scatter     modulus, tension, compression; ///< [Pa]
    std::size_t particles = 0, links = 0;      ///< of the last seed
    double      steps = 0, seconds = 0;        ///< of one seed, both tests, in steps only

    /** One test more; a seed is complete with its two tests. */
    void add(const UniaxialResult &result);
    /** One line for the terminal. */
    std::string text() const;

  private:
    double all_steps = 0, all_seconds = 0;
  };

  /** Error over cost of all cases, as table and figure. */
  class UniaxialTable
  {
  public:
    void add(UniaxialMeasurement measured) { rows.push_back(std::move(measured)); }
    /** @throws postprocess::OutputError. */
    void write(const BenchResults &results) const;
    /** One per study, error over cost. */
    std::vector<postprocess::PlotPanel> panels() const;

  private:
    std::vector<UniaxialMeasurement> rows;
  };
} // namespace apps
