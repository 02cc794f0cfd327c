#include "apps/studies/measured_curve.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace apps
{
  namespace
  {
    const std::vector<std::string> *words_in_column(const postprocess::CsvTable &table, const std::string &name)
    {
      for (std::size_t column = 0; column < table.names.size(); ++column)
        if (table.names[column] == name && column < table.words.size() && !table.words[column].empty())
          return &table.words[column];
      return nullptr;
    }
  } // namespace

  CurvePoints points_of(const postprocess::CsvTable &table, const CurveColumns &columns)
  {
    const std::vector<double>      &x = table.column(columns.abscissa), &y = table.column(columns.ordinate);
    const std::vector<std::string> *tests  = columns.test.empty() ? nullptr : words_in_column(table, "test");
    CurvePoints                     points = {{0, 0}};
    for (std::size_t row = 0; row < x.size(); ++row)
      if ((!tests || (*tests)[row] == columns.test) && std::isfinite(x[row]) && std::isfinite(y[row]) &&
          std::fabs(x[row]) > std::fabs(points.back().first))
        points.emplace_back(x[row], y[row]);
    if (points.size() < 2)
      throw base::InputError(table.origin + ": has no curve of " + columns.ordinate + " over " + columns.abscissa +
                             (columns.test.empty() ? "" : " of the test " + columns.test) + ".");
    return points;
  }

  Eigen::VectorXd abscissae_of(const postprocess::CsvTable &measured, const CurveColumns &columns)
  {
    const CurvePoints points   = points_of(measured, columns);
    const double      farthest = points.back().first;
    const auto        count    = static_cast<Eigen::Index>(points.size()) - 1; // without the origin
    if (count > points_of_curve)
      return Eigen::VectorXd::LinSpaced(points_of_curve, farthest / points_of_curve, farthest);
    Eigen::VectorXd own(
      count); // between them there are no further observations, and the error would look smaller than it is
    for (Eigen::Index k = 0; k < count; ++k)
      own[k] = points[k + 1].first;
    return own;
  }

  Eigen::VectorXd
  ordinates_at(const Eigen::VectorXd &abscissae, const postprocess::CsvTable &table, const CurveColumns &columns)
  {
    const CurvePoints points   = points_of(table, columns);
    const double      farthest = abscissae.cwiseAbs().maxCoeff();
    Eigen::VectorXd   ordinates(abscissae.size());
    for (Eigen::Index k = 0; k < abscissae.size(); ++k)
      {
        const double x    = std::fabs(abscissae[k]);
        const auto   next = std::find_if(points.begin() + 1, points.end(),
                                         [x](const auto &point) { return std::fabs(point.first) >= x; });
        if (next == points.end())
          {
            const double beyond = x - std::fabs(points.back().first);
            ordinates[k]        = points.back().second * std::max(0.0, 1 - beyond / (0.1 * farthest));
            continue;
          }
        const auto  &before = *(next - 1);
        const double part   = (x - std::fabs(before.first)) / (std::fabs(next->first) - std::fabs(before.first));
        ordinates[k]        = before.second + part * (next->second - before.second);
      }
    return ordinates;
  }
} // namespace apps
