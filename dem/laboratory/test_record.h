#pragma once

#include "base/column.h"
#include "base/state.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** What a laboratory reads off a specimen at an instant. Stress and strain positive in the sense of the load. */
  struct LabReading
  {
    double strain         = 0; ///< by the platens [-]
    double stress         = 0; ///< of half the sum of the forces on both platens [Pa]
    double low            = 0; ///< force on the low platen [N]
    double high           = 0; ///< on the high one [N]
    double gauge_strain   = 0; ///< by particles between the platens [-]
    double lateral_strain = 0; ///< mean over the directions across, positive: the specimen grows wider [-]
    double confinement    = 0; ///< mean pressure across the axis, as it is measured [Pa]
    double kinetic        = 0; ///< energy [J]
    double work           = 0; ///< from outside since the loading began [J]
    double force_ratio    = 1; ///< Specimen::force_ratio()
    double breaks         = 0; ///< bonds and elements that broke, since the start
  };

  /**
   * The curve of a test: a row every so many steps, whatever the scene shows, and what lies between two rows summed up. A test that goes
   * on for long keeps every second row and takes half as many from then on, so that memory stays bounded.
   */
  class TestRecord
  {
  public:
    static constexpr std::size_t  most_rows  = 16384;
    static constexpr std::int64_t first_rows = 20; ///< steps between two rows at the beginning

    /** Forces and stress of a step. @return whether a row is due, for which the caller reads the rest */
    bool step(double load, double first, double second);
    /** The row of the step just taken. */
    void row(const LabReading &reading);

    /** Columns by what they are. */
    enum Column
    {
      strain,
      stress,
      low,
      high,
      gauge_strain,
      lateral_strain,
      confinement,
      kinetic,
      work,
      force_ratio,
      breaks,
      largest_stress, ///< of all steps since the row before
      imbalance,      ///< largest difference of the forces on both platens since the row before [N]
      columns
    };
    std::size_t         rows() const { return numbers.size() / columns; }
    double              at(const std::size_t row, const Column column) const { return numbers[columns * row + column]; }
    std::vector<double> values(Column column) const;
    /** Forget all rows. */
    void clear();

    void visit_state(base::StateVisitor &visitor);

  private:
    base::Column numbers; ///< row by row
    std::int64_t interval = first_rows, since = 0;
    double       largest = 0, apart = 0;
  };
} // namespace dem
