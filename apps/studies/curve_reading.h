#pragma once

#include "apps/studies/measured_curve.h"

#include <optional>

namespace apps
{
  /** What is read from a curve. */
  enum class CurveMeasure
  {
    none,
    value,         ///< ordinate at an abscissa
    peak,          ///< ordinate of the largest magnitude
    place_of_peak, ///< its abscissa
    area,          ///< below the curve between two abscissae
    slope,         ///< of the straight line nearest to its points between two abscissae
    hardening      ///< part of the peak that is reached after the curve has left its straight beginning
  };

  /** A number that stands for a curve of a run's series. */
  struct CurveReading
  {
    CurveColumns columns{"strain", "stress", ""};
    CurveMeasure measure = CurveMeasure::none;
    double       from = 0, to = 0; ///< magnitudes of abscissae; `to` 0: the end. A value is read at `to`
    double       offset = 5e-5;    ///< of abscissae, by which a curve has left a line: of hardening

    /** "Pa" of a stress, "Pa/-" made "Pa" of its slope over strain. */
    std::string unit_in(const postprocess::CsvTable &table) const;
  };

  /** Nothing where the curve does not get as far. @throws base::InputError for a table without the columns or a curve */
  std::optional<double> read_curve(const postprocess::CsvTable &table, const CurveReading &reading);
} // namespace apps
