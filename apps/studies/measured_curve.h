#pragma once

#include "postprocess/files/csv_table.h"

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** At how many points a curve is compared at most. */
  constexpr int points_of_curve = 50;

  /** Columns of a table by which two curves are compared, of some rows. */
  struct CurveColumns
  {
    std::string abscissa, ordinate;
    std::string test; ///< of rows whose column `test` has this word; "": of all
  };

  using CurvePoints = std::vector<std::pair<double, double>>; ///< abscissa and ordinate

  /** Those that are farther out than all before, the origin first. @throws base::InputError for a curve without a point */
  CurvePoints points_of(const postprocess::CsvTable &table, const CurveColumns &columns);

  /** Those of the measured curve; of one with more points, equally spaced up to the farthest, without zero. @throws base::InputError for an unusable curve */
  Eigen::VectorXd abscissae_of(const postprocess::CsvTable &measured, const CurveColumns &columns);

  /**
   * Ordinates by linear interpolation, where the curve first gets as far; from the origin, where it does not begin there. Beyond its end
   * the last one falls to zero over a tenth of the farthest abscissa. @throws base::InputError for a curve without a point
   */
  Eigen::VectorXd
  ordinates_at(const Eigen::VectorXd &abscissae, const postprocess::CsvTable &table, const CurveColumns &columns);
} // namespace apps
