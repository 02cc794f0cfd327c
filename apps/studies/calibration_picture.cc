#include "apps/studies/calibration_picture.h"

#include "postprocess/files/numeric_text.h"
#include "postprocess/pictures/gnuplot.h"

#include <cmath>

namespace apps
{
  namespace
  {
    using postprocess::gnuplot_quoted;

    /** A line of the picture: a name, and values from the left to the right that it stands for. */
    struct NamedValues
    {
      std::string name;
      double      start, value, lower, upper; ///< of the band of 95 %; NaN: there is none
    };

    std::vector<NamedValues> figures_of(const CalibrationFile &file,
                                        const CalibrationRuns &runs,
                                        const Calibration     &found,
                                        const bool             in_deviations)
    {
      std::vector<NamedValues> all;
      for (std::size_t k = 0; k < file.targets.size(); ++k)
        {
          if (file.targets[k].is_curve())
            continue;
          const Eigen::Index at       = runs.first_of(k);
          const double       measured = runs.measured()[at];
          const double       unit     = in_deviations ? runs.scale()[at] : std::fabs(measured) / 100;
          const double       start    = found.at_start.size() > 0 ? (found.at_start[at] - measured) / unit : NAN;
          const double       value = (found.predicted[at] - measured) / unit, half = found.half_widths[at] / unit;
          all.push_back({file.targets[k].name, start, value, value - half, value + half});
        }
      return all;
    }

    /** In per cent of the way from the lower to the upper bound. */
    std::vector<NamedValues> constants_of(const CalibrationFile &file, const Calibration &found)
    {
      std::vector<NamedValues> all;
      for (std::size_t k = 0; k < file.constants.size(); ++k)
        {
          const SoughtConstant &own = file.constants[k];
          const auto way = [&own](const double value) { return 100 * (value - own.lower) / (own.upper - own.lower); };
          const bool has_band = found.determined[k];
          all.push_back({own.name, way(own.start), way(found.constants[k]), has_band ? way(found.lower[k]) : NAN,
                         has_band ? way(found.upper[k]) : NAN});
        }
      return all;
    }

    std::string table_of(const std::vector<NamedValues> &rows)
    {
      std::string text;
      for (std::size_t row = 0; row < rows.size(); ++row, text += '\n')
        for (const double value :
             {-static_cast<double>(row), rows[row].start, rows[row].value, rows[row].lower, rows[row].upper})
          {
            postprocess::numeric_text::append(text, value);
            text += ' ';
          }
      return text;
    }

    std::string panel(const std::string              &title,
                      const std::string              &label,
                      const std::vector<NamedValues> &rows,
                      const std::string              &data)
    {
      std::string names;
      for (std::size_t row = 0; row < rows.size(); ++row)
        names += (row > 0 ? ", " : "") + gnuplot_quoted(rows[row].name) + " " + std::to_string(-static_cast<long>(row));
      const std::string from = gnuplot_quoted(data);
      return "set title " + gnuplot_quoted(title) + " noenhanced\nset xlabel " + gnuplot_quoted(label) +
             " noenhanced\nset ytics (" + names + ") noenhanced\nset yrange [" +
             std::to_string(-static_cast<long>(rows.size())) + ":1]\nplot " + from +
             " using 2:1 with points pt 6 ps 1.6 lw 1.5 lc rgb '#999999' title 'start', " + from +
             " using 3:1:4:5 with xerrorbars pt 0 lw 2 lc rgb '#56b4e9' title 'band of 95 %', " + from +
             " using 3:1 with points pt 7 ps 1.4 lc rgb '#0072b2' title 'found'\n";
    }
  } // namespace

  std::string draw_figures_and_constants(const CalibrationFile       &file,
                                         const CalibrationRuns       &runs,
                                         const Calibration           &found,
                                         const std::filesystem::path &path)
  {
    const bool                     in_deviations = file.targets.front().deviation > 0;
    const std::vector<NamedValues> figures       = figures_of(file, runs, found, in_deviations);
    postprocess::GnuplotJob        job;
    job.data["figures"]   = table_of(figures);
    job.data["constants"] = table_of(constants_of(file, found));
    job.width             = 1240;
    job.height            = 460;
    job.script =
      "set multiplot layout 1,2\nset grid xtics ytics lc rgb '#d8d8d8' lt 1 lw 1\nset key below\nset bmargin 6\n"
      "set datafile missing 'nan'\n"
      "set arrow 1 from 0, graph 0 to 0, graph 1 nohead lw 1.5 lc rgb 'black'\n";
    job.script +=
      panel("Figures", in_deviations ? "off what was measured [standard deviations]" : "off what was measured [%]",
            figures, "figures");
    job.script += "unset arrow 1\nset xrange [-3:103]\n";
    job.script += panel("Constants", "of the way between the bounds [%]", constants_of(file, found), "constants");
    job.script += "unset multiplot\n";
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
} // namespace apps
