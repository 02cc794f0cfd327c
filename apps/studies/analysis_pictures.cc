#include "apps/results/warning.h"
#include "apps/statistics/distributions.h"
#include "apps/studies/analysis_files.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/pictures/gnuplot.h"
#include "postprocess/pictures/plot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace apps
{
  namespace
  {
    using postprocess::PlotPanel;
    using postprocess::PlotSeries;

    std::string response_label(const Analysis &analysis)
    {
      const TableSelection &table = analysis.table;
      return table.response_unit.empty() ? table.response : table.response + " [" + table.response_unit + "]";
    }

    /** Mean response at the levels of each factor, which are drawn from -1 to 1. */
    PlotPanel effects(const Analysis &analysis)
    {
      PlotPanel panel;
      panel.title   = "Means at the levels of each factor";
      panel.x_label = "factor, from its lowest (-1) to its highest (1) value";
      panel.y_label = response_label(analysis);
      for (const statistics::FactorRange &range : analysis.ranges)
        {
          PlotSeries   series;
          const double low = range.levels.front(), high = range.levels.back();
          series.name = range.factor;
          series.y    = range.means;
          for (const double level : range.levels)
            series.x.push_back(high > low ? 2 * (level - low) / (high - low) - 1 : 0);
          panel.series.push_back(std::move(series));
        }
      return panel;
    }

    /** Sizes of effects with their names: of coded terms, or of factors by their mean squares. */
    std::vector<std::pair<double, std::string>> effect_sizes(const Analysis &analysis)
    {
      std::vector<std::pair<double, std::string>> sizes;
      if (analysis.surface)
        {
          const auto names = analysis.surface->polynomial.term_names();
          for (std::size_t term = 1; term < names.size(); ++term)
            sizes.emplace_back(std::fabs(analysis.surface->coded[term]), names[term]);
        }
      else
        for (const statistics::Effect &effect : analysis.anova->effects)
          sizes.emplace_back(std::sqrt(std::max(effect.sum_of_squares, 0.0) / std::max(effect.degrees, 1)),
                             effect.factor);
      std::sort(sizes.begin(), sizes.end());
      return sizes;
    }

    PlotPanel half_normal(const Analysis &analysis)
    {
      constexpr std::size_t named = 6; // the largest, in the legend
      const auto            sizes = effect_sizes(analysis);
      PlotPanel             panel;
      panel.title   = "Half-normal plot of effects: chance lies on a line through zero";
      panel.x_label = "size of the effect, " + response_label(analysis);
      panel.y_label = "half-normal quantile";
      PlotSeries others;
      others.style = PlotSeries::Style::points;
      for (std::size_t k = 0; k < sizes.size(); ++k)
        {
          const double quantile = statistics::half_normal_quantile((k + 0.5) / sizes.size());
          if (k + named < sizes.size())
            {
              others.x.push_back(sizes[k].first);
              others.y.push_back(quantile);
              continue;
            }
          PlotSeries one;
          one.style = PlotSeries::Style::points;
          one.name  = sizes[k].second;
          one.x     = {sizes[k].first};
          one.y     = {quantile};
          panel.series.push_back(std::move(one));
        }
      panel.series.push_back(std::move(others));
      return panel;
    }

    std::vector<double> list_of(const Eigen::VectorXd &values) { return {values.begin(), values.end()}; }

    std::vector<PlotPanel> residuals(const Analysis &analysis)
    {
      const statistics::LinearFit &fit = *analysis.fit();
      std::vector<PlotPanel>       panels(2);
      panels[0].title   = "Predicted and found";
      panels[0].x_label = "predicted " + response_label(analysis);
      panels[0].y_label = "found " + response_label(analysis);
      const double low  = std::min(fit.fitted.minCoeff(), analysis.table.values.minCoeff());
      const double high = std::max(fit.fitted.maxCoeff(), analysis.table.values.maxCoeff());
      PlotSeries   line, runs, left_out;
      line.style = PlotSeries::Style::line;
      line.name  = "equal";
      line.x = line.y = {low, high};
      runs.style = left_out.style = PlotSeries::Style::points;
      runs.name                   = "run";
      runs.x                      = list_of(fit.fitted);
      left_out.name               = "by all other runs";
      left_out.x                  = list_of(fit.left_out);
      runs.y = left_out.y = list_of(analysis.table.values);
      panels[0].series    = {line, runs, left_out};
      panels[1].title     = "Studentised residuals";
      panels[1].x_label   = "run, in the order of the table";
      panels[1].y_label   = "residual / its standard error";
      PlotSeries studentised;
      studentised.style = PlotSeries::Style::points;
      studentised.x.resize(fit.studentised.size());
      std::iota(studentised.x.begin(), studentised.x.end(), 1);
      studentised.y = list_of(fit.studentised);
      panels[1].series.push_back(studentised);
      return panels;
    }

    /** The factors of largest coded terms, products and squares counted to each of theirs. */
    std::vector<int> leading_factors(const statistics::ResponseSurface &surface)
    {
      const std::size_t     factors = surface.polynomial.factors().size();
      std::vector<double>   weight(factors, 0.0);
      const Eigen::MatrixXd ones   = Eigen::VectorXd::Ones(factors);
      const Eigen::MatrixXd powers = surface.polynomial.derivatives(ones);
      for (std::size_t factor = 0; factor < factors; ++factor)
        weight[factor] = powers.col(factor).cwiseProduct(surface.coded).cwiseAbs().sum();
      std::vector<int> order(factors);
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](const int a, const int b) { return weight[a] > weight[b]; });
      order.resize(std::min<std::size_t>(factors, 3));
      return order;
    }

    /** Values on a grid of two factors, the others at their centres, as gnuplot reads a surface. */
    std::string grid(const statistics::ResponseSurface &surface, const int right, const int up)
    {
      constexpr int   points = 41;
      std::string     text;
      Eigen::VectorXd at = surface.box.centre();
      for (int i = 0; i < points; ++i, text += '\n')
        for (int j = 0; j < points; ++j, text += '\n')
          {
            at[right] = surface.box.lower[right] + 2 * surface.box.half()[right] * i / (points - 1);
            at[up]    = surface.box.lower[up] + 2 * surface.box.half()[up] * j / (points - 1);
            for (const double value : {at[right], at[up], surface.value(at)})
              {
                postprocess::numeric_text::append(text, value);
                text += ' ';
              }
          }
      return text;
    }

    std::string contour_panel(const Analysis &analysis, const int right, const int up, const std::string &file)
    {
      using postprocess::gnuplot_quoted;
      const auto label = [&analysis](const int factor) {
        const std::string &unit = analysis.table.factor_units[static_cast<std::size_t>(factor)];
        return analysis.surface->polynomial.factors()[factor] + (unit.empty() ? "" : " [" + unit + "]");
      };
      return "set title " + gnuplot_quoted(response_label(analysis) + ", all else at its centre") + " noenhanced\n" +
             "set xlabel " + gnuplot_quoted(label(right)) + " noenhanced\nset ylabel " + gnuplot_quoted(label(up)) +
             " noenhanced\nsplot " + gnuplot_quoted(file) + " using 1:2:3 with pm3d notitle, " + gnuplot_quoted(file) +
             " using 1:2:3 with lines lc rgb 'black' nosurface notitle, " + gnuplot_quoted(file) +
             " using 1:2:3 with labels font ',8' nosurface notitle\n";
    }

    std::string draw_contours(const Analysis &analysis, const std::filesystem::path &path)
    {
      const std::vector<int>  leading = leading_factors(*analysis.surface);
      postprocess::GnuplotJob job;
      std::string             panels;
      int                     count = 0;
      for (std::size_t a = 0; a < leading.size(); ++a)
        for (std::size_t b = a + 1; b < leading.size(); ++b)
          {
            const std::string file = "grid" + std::to_string(count++);
            job.data[file]         = grid(*analysis.surface, leading[a], leading[b]);
            panels += contour_panel(analysis, leading[a], leading[b], file);
          }
      if (count == 0)
        return "a surface of one factor has no contours";
      job.width  = 620 * count;
      job.height = 520;
      job.script = "set multiplot layout 1," + std::to_string(count) +
                   "\nset view map\nset contour base\nset cntrlabel onecolor\nset cntrparam levels auto 8\n"
                   "set palette defined (0 '#f7fbff', 1 '#6baed6', 2 '#08519c')\nset autoscale fix\n" +
                   panels + "unset multiplot\n";
      try
        {
          postprocess::draw_with_gnuplot(path, job);
          return "";
        }
      catch (const std::exception &problem)
        {
          return problem.what();
        }
    }
  } // namespace

  void draw(const Analysis &analysis, const std::filesystem::path &folder)
  {
    warn_of_missing("effects.png", postprocess::plot(folder / "effects.png", {effects(analysis)}));
    if (!analysis.fit())
      return;
    warn_of_missing("half_normal.png", postprocess::plot(folder / "half_normal.png", {half_normal(analysis)}));
    warn_of_missing("residuals.png", postprocess::plot(folder / "residuals.png", residuals(analysis)));
    if (analysis.surface && analysis.table.factors.size() > 1)
      warn_of_missing("contours.png", draw_contours(analysis, folder / "contours.png"));
  }
} // namespace apps
