#include "apps/studies/replicate_statistics.h"

#include "apps/statistics/sample.h"
#include "apps/studies/measured_curve.h"
#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    const std::vector<std::string> *tests_in(const postprocess::CsvTable &series)
    {
      const auto found = std::find(series.names.begin(), series.names.end(), "test");
      return found == series.names.end() ? nullptr :
                                           &series.words[static_cast<std::size_t>(found - series.names.begin())];
    }

    bool has_test(const postprocess::CsvTable &series, const std::string &test)
    {
      const std::vector<std::string> *tests = tests_in(series);
      return tests && std::find(tests->begin(), tests->end(), test) != tests->end();
    }

    /** Tests that all series have; one without a name where the first has no tests. */
    std::vector<std::string> common_tests(const std::vector<postprocess::CsvTable> &all)
    {
      const std::vector<std::string> *of_first = tests_in(all.front());
      if (!of_first)
        return {""};
      std::vector<std::string> common;
      for (const std::string &test : *of_first)
        if (std::find(common.begin(), common.end(), test) == common.end() &&
            std::all_of(all.begin(), all.end(), [&test](const auto &series) { return has_test(series, test); }))
          common.push_back(test);
      return common;
    }

    /** Columns of numbers but for the abscissa that all series have. */
    std::vector<std::size_t> ordinates_of(const std::vector<postprocess::CsvTable> &all, const std::string &abscissa)
    {
      const postprocess::CsvTable &first = all.front();
      std::vector<std::size_t>     ordinates;
      for (std::size_t c = 0; c < first.names.size(); ++c)
        if (first.words[c].empty() && first.names[c] != abscissa &&
            std::all_of(all.begin(), all.end(), [&](const auto &series) {
              return std::find(series.names.begin(), series.names.end(), first.names[c]) != series.names.end();
            }))
          ordinates.push_back(c);
      return ordinates;
    }

    /** From where all curves have begun to where the first one ends; empty where there is no such part. */
    Eigen::VectorXd common_abscissae(const std::vector<postprocess::CsvTable> &all, const CurveColumns &columns)
    {
      double begin = 0, end = 0;
      for (std::size_t k = 0; k < all.size(); ++k)
        {
          const CurvePoints points = points_of(all[k], columns);
          const double      first = points[1].first, last = points.back().first;
          begin = std::fabs(first) > std::fabs(begin) ? first : begin;
          end   = k == 0 || std::fabs(last) < std::fabs(end) ? last : end;
        }
      return std::fabs(begin) < std::fabs(end) ? Eigen::VectorXd::LinSpaced(points_of_band, begin, end) :
                                                 Eigen::VectorXd();
    }

    /** A column may be without a single number, of what a run does not determine. */
    bool has_curve(const postprocess::CsvTable &series, const CurveColumns &columns)
    {
      const std::vector<double> &values = series.column(columns.ordinate);
      return std::any_of(values.begin(), values.end(), [](const double value) { return std::isfinite(value); });
    }

    void add_ordinate(const std::vector<postprocess::CsvTable> &all,
                      const CurveColumns                       &columns,
                      const Eigen::VectorXd                    &abscissae,
                      std::vector<double>                      &means,
                      std::vector<double>                      &deviations)
    {
      std::vector<Eigen::VectorXd> curves;
      for (const postprocess::CsvTable &series : all)
        curves.push_back(has_curve(series, columns) ?
                           ordinates_at(abscissae, series, columns) :
                           Eigen::VectorXd::Constant(abscissae.size(), std::numeric_limits<double>::quiet_NaN()));
      for (Eigen::Index row = 0; row < abscissae.size(); ++row)
        {
          std::vector<double> values;
          for (const Eigen::VectorXd &curve : curves)
            values.push_back(curve[row]);
          const statistics::SampleMoments sample = statistics::moments_of(values);
          means.push_back(sample.mean);
          deviations.push_back(sample.deviation);
        }
    }
  } // namespace

  std::vector<double> ReplicatedFigure::determined() const
  {
    std::vector<double> found;
    for (const std::optional<double> &value : values)
      if (value)
        found.push_back(*value);
    return found;
  }

  double ReplicatedFigure::mean() const { return statistics::moments_of(determined()).mean; }

  std::optional<double> ReplicatedFigure::standard_deviation() const
  {
    const statistics::SampleMoments found = statistics::moments_of(determined());
    return found.count > 1 ? std::optional<double>(found.deviation) : std::nullopt;
  }

  std::vector<ReplicatedFigure> replicated_figures(const std::vector<RunResult> &runs)
  {
    std::vector<ReplicatedFigure> all;
    for (std::size_t k = 0; k < runs.size(); ++k)
      for (const std::string &path : runs[k].figures())
        {
          auto found =
            std::find_if(all.begin(), all.end(), [&path](const ReplicatedFigure &known) { return known.path == path; });
          if (found == all.end())
            {
              all.push_back({path, "", std::vector<std::optional<double>>(runs.size()), ""});
              found = all.end() - 1;
            }
          const Figure figure = runs[k].figure(path);
          found->values[k]    = figure.value;
          if (found->unit.empty())
            found->unit = figure.unit;
          if (!figure.value && found->not_determined.empty())
            found->not_determined = figure.not_determined;
        }
    return all;
  }

  std::string abscissa_of_band(const postprocess::CsvTable &series)
  {
    for (const char *name : {"strain", "time"})
      if (std::find(series.names.begin(), series.names.end(), name) != series.names.end())
        return name;
    return "";
  }

  ReplicatedSeries replicated_series(const std::vector<postprocess::CsvTable> &all)
  {
    const postprocess::CsvTable   &first     = all.front();
    const std::string              abscissa  = abscissa_of_band(first);
    const std::vector<std::size_t> ordinates = ordinates_of(all, abscissa);
    const auto                     unit_of   = [&first](const std::string &name) {
      return first
        .units[static_cast<std::size_t>(std::find(first.names.begin(), first.names.end(), name) - first.names.begin())];
    };
    ReplicatedSeries band;
    if (tests_in(first))
      band.columns.push_back({"test", "", true});
    std::vector<postprocess::SeriesColumn> numbers = {{abscissa, unit_of(abscissa)}};
    for (const std::size_t c : ordinates)
      {
        numbers.push_back({first.names[c], first.units[c]});
        numbers.push_back({first.names[c] + "_deviation", first.units[c]});
      }
    band.columns.insert(band.columns.end(), numbers.begin(), numbers.end());
    band.table = empty_series(numbers, "series of the replicates");
    for (const std::string &test : common_tests(all))
      {
        const CurveColumns    place{abscissa, abscissa, test};
        const Eigen::VectorXd abscissae = common_abscissae(all, place);
        if (tests_in(first))
          band.tests.insert(band.tests.end(), static_cast<std::size_t>(abscissae.size()), test);
        band.table.columns[0].insert(band.table.columns[0].end(), abscissae.begin(), abscissae.end());
        if (abscissae.size() > 0)
          for (std::size_t k = 0; k < ordinates.size(); ++k)
            add_ordinate(all, {abscissa, first.names[ordinates[k]], test}, abscissae, band.table.columns[1 + 2 * k],
                         band.table.columns[2 + 2 * k]);
      }
    if (band.table.rows() == 0)
      throw base::InputError("the series of the replicates have no part of " + abscissa + " in common.");
    return band;
  }
} // namespace apps
