#include "apps/studies/curve_reading.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace apps
{
  namespace
  {
    const std::string &unit_of(const postprocess::CsvTable &table, const std::string &column)
    {
      static const std::string none;
      const auto               at = std::find(table.names.begin(), table.names.end(), column);
      return at == table.names.end() ? none : table.units[static_cast<std::size_t>(at - table.names.begin())];
    }

    double ordinate_at(const CurvePoints &points, const double x)
    {
      const auto next =
        std::find_if(points.begin() + 1, points.end(), [x](const auto &point) { return std::fabs(point.first) >= x; });
      const auto  &before = *(next - 1);
      const double part   = (x - std::fabs(before.first)) / (std::fabs(next->first) - std::fabs(before.first));
      return before.second + part * (next->second - before.second);
    }

    CurvePoints::const_iterator peak_of(const CurvePoints &points)
    {
      return std::max_element(points.begin(), points.end(),
                              [](const auto &a, const auto &b) { return std::fabs(a.second) < std::fabs(b.second); });
    }

    /** Both ends, and the points between them. */
    CurvePoints between(const CurvePoints &points, const double from, const double to)
    {
      const double sign  = points.back().first < 0 ? -1 : 1;
      CurvePoints  inner = {{sign * from, from > 0 ? ordinate_at(points, from) : points.front().second}};
      for (const auto &point : points)
        if (std::fabs(point.first) > from && std::fabs(point.first) < to)
          inner.push_back(point);
      inner.emplace_back(sign * to, ordinate_at(points, to));
      return inner;
    }

    double area_below(const CurvePoints &points)
    {
      double sum = 0;
      for (std::size_t k = 1; k < points.size(); ++k)
        sum += (points[k].first - points[k - 1].first) * (points[k].second + points[k - 1].second) / 2;
      return sum;
    }

    /** The straight line nearest to points. */
    struct Line
    {
      double x, y, slope; ///< through (x, y)
    };

    Line line_of(const CurvePoints &points)
    {
      double x = 0, y = 0, xx = 0, xy = 0;
      for (const auto &point : points)
        {
          x += point.first / static_cast<double>(points.size());
          y += point.second / static_cast<double>(points.size());
        }
      for (const auto &point : points)
        {
          xx += (point.first - x) * (point.first - x);
          xy += (point.first - x) * (point.second - y);
        }
      return {x, y, xy / xx};
    }

    /**
     * Where the ordinate is the yield one, abscissae first exceed by the offset the line through the points between a fifth and a half of
     * the peak: below, platens are still being seated. Nothing where there are too few.
     */
    std::optional<double> hardening_of(const CurvePoints &points, const double offset)
    {
      const auto   peak = peak_of(points);
      const double top  = std::fabs(peak->second);
      CurvePoints  straight;
      std::copy_if(points.begin(), peak, std::back_inserter(straight), [top](const auto &point) {
        return std::fabs(point.second) >= 0.2 * top && std::fabs(point.second) <= 0.5 * top;
      });
      if (straight.size() < 2)
        return std::nullopt;
      const Line line  = line_of(straight);
      const auto yield = std::find_if(points.begin(), peak, [&](const auto &point) {
        const double ahead = point.first - line.x - (point.second - line.y) / line.slope;
        return std::fabs(point.second) > 0.5 * top && ahead * (peak->first < 0 ? -1 : 1) > offset;
      });
      return 1 - std::fabs(yield->second) / top;
    }
  } // namespace

  std::string CurveReading::unit_in(const postprocess::CsvTable &table) const
  {
    const std::string &x = unit_of(table, columns.abscissa), &y = unit_of(table, columns.ordinate);
    const bool         pure = x == "-" || x.empty();
    if (measure == CurveMeasure::place_of_peak)
      return x;
    if (measure == CurveMeasure::hardening)
      return "-";
    if (pure || measure == CurveMeasure::value || measure == CurveMeasure::peak)
      return y;
    return y + (measure == CurveMeasure::slope ? "/" : " ") + x;
  }

  std::optional<double> read_curve(const postprocess::CsvTable &table, const CurveReading &reading)
  {
    const CurvePoints points = points_of(table, reading.columns);
    const double      end = std::fabs(points.back().first), to = reading.to > 0 ? reading.to : end;
    switch (reading.measure)
      {
      case CurveMeasure::peak:
        return peak_of(points)->second;
      case CurveMeasure::place_of_peak:
        return peak_of(points)->first;
      case CurveMeasure::hardening:
        return hardening_of(points, reading.offset);
      default:
        break;
      }
    if (to > end || reading.from >= to)
      return std::nullopt;
    if (reading.measure == CurveMeasure::value)
      return ordinate_at(points, to);
    const CurvePoints part = between(points, reading.from, to);
    return reading.measure == CurveMeasure::area ? area_below(part) : line_of(part).slope;
  }
} // namespace apps
