#include "postprocess/pictures/break_pictures.h"

#include "postprocess/files/numeric_text.h"
#include "postprocess/pictures/gnuplot.h"
#include "postprocess/pictures/picture_axes.h"
#include "postprocess/pictures/picture_view.h"
#include "postprocess/vtk/break_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numeric>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    struct Mode
    {
      dem::BreakMode mode;
      const char    *data, *name, *colour;
    };
    // Blue and vermilion can be distinguished by colour-blind readers (Okabe and Ito, 2008).
    constexpr std::array<Mode, 3> modes = {{{dem::BreakMode::tension, "tension", "tension", "#d55e00"},
                                            {dem::BreakMode::shear, "shear", "shear", "#0072b2"},
                                            {dem::BreakMode::gradual, "gradual", "damaged until broken", "#d55e00"}}};

    /** Segments across what broke, of one mode. */
    std::string segment_rows(const std::vector<dem::Break> &breaks,
                             const PictureView             &view,
                             const dem::BreakMode           mode,
                             const double                   thickness,
                             const double                   scale)
    {
      std::string text;
      for (const dem::Break &b : breaks)
        {
          const Eigen::Vector2d across = view.projected(b.normal);
          if (b.mode != mode || across.norm() < 0.1 || (thickness == 0 && !view.shows(b.place)))
            continue;
          const Eigen::Vector2d along = Eigen::Vector2d(-across.y(), across.x()).normalized() * width_of(b, thickness);
          const Eigen::Vector2d start = view.projected(b.place) - 0.5 * along;
          append_row(text, {scale * start.x(), scale * start.y(), scale * along.x(), scale * along.y()});
        }
      return text;
    }

    std::string outline_rows(const dem::ParticleOutput      &particles,
                             const PictureView              &view,
                             const std::vector<std::size_t> &shown,
                             const double                    scale)
    {
      std::string text;
      for (const std::size_t i : shown)
        append_row(text, {scale * view.on_paper(i).x(), scale * view.on_paper(i).y(), scale * particles.radius[i]});
      return text;
    }

    std::size_t count_of(const std::vector<dem::Break> &breaks, const dem::BreakMode mode)
    {
      return static_cast<std::size_t>(
        std::count_if(breaks.begin(), breaks.end(), [mode](const dem::Break &b) { return b.mode == mode; }));
    }

    void draw_breaks(const std::filesystem::path   &path,
                     const dem::ParticleOutput     &particles,
                     const std::vector<dem::Break> &breaks,
                     const double                   thickness,
                     const std::string             &title,
                     const PictureSlab             &slab)
    {
      if (breaks.empty())
        throw std::invalid_argument("nothing broke");
      const PictureView  view(particles, slab);
      const auto         shown = view.shown();
      GnuplotJob         job;
      const PictureFrame frame{view.frame(shown), view.name_of_right(), view.name_of_up(), 760, 130, 160, 480};
      const double       scale = set_axes(job, frame).per_metre;
      job.data["particles"]    = outline_rows(particles, view, shown, scale);
      job.script += "set title " + gnuplot_quoted(title) +
                    " noenhanced\nset style fill solid 1 border lc rgb '#c8c8c8'\n" + legend_below() +
                    "plot 'particles' using 1:2:3 with circles fc "
                    "rgb '#f2f2f2' notitle";
      for (const Mode &mode : modes)
        {
          const std::string rows = segment_rows(breaks, view, mode.mode, thickness, scale);
          if (rows.empty())
            continue;
          job.data[mode.data] = rows;
          job.script += std::string(", '") + mode.data + "' using 1:2:3:4 with vectors nohead lw 1.6 lc rgb '" +
                        mode.colour + "' notitle, NaN with lines lw 2.5 lc rgb '" + mode.colour + "' title '" +
                        mode.name + " (" + std::to_string(count_of(breaks, mode.mode)) + ")'";
        }
      draw_with_gnuplot(path, job);
    }

    /** A sector of a circle as a closed polygon, on both sides of the middle. */
    void append_sectors(std::string &text, const int sector, const double from, const double to)
    {
      const double wide = M_PI / BreakDirections::sectors;
      for (const double turned : {0.0, M_PI})
        {
          constexpr int pieces = 8;
          for (int k = 0; k <= pieces; ++k)
            {
              const double angle = turned + wide * (sector + static_cast<double>(k) / pieces);
              append_row(text, {to * std::cos(angle), to * std::sin(angle)});
            }
          for (int k = pieces; k >= 0; --k)
            {
              const double angle = turned + wide * (sector + static_cast<double>(k) / pieces);
              append_row(text, {from * std::cos(angle), from * std::sin(angle)});
            }
          text += "\n\n";
        }
    }

    void draw_directions(const std::filesystem::path &path,
                         const BreakDirections       &found,
                         const int                    along,
                         const std::string           &title)
    {
      const double total = found.total();
      if (!(total > 0))
        throw std::invalid_argument("nothing broke that would be seen from here");
      GnuplotJob  job;
      double      largest = 0;
      std::string torn, others;
      for (int s = 0; s < BreakDirections::sectors; ++s)
        {
          const auto   at         = static_cast<std::size_t>(s);
          const double in_tension = 100 * found.tension[at] / total, both = in_tension + 100 * found.others[at] / total;
          largest = std::max(largest, both);
          if (in_tension > 0)
            append_sectors(torn, s, 0, in_tension);
          if (both > in_tension)
            append_sectors(others, s, in_tension, both);
        }
      const double step = tick_step(largest, 4), reach = 1.05 * largest;
      job.width = job.height = 560;
      std::string range;
      numeric_text::append(range, reach);
      job.script = "set title " + gnuplot_quoted(title) + " noenhanced\nset size ratio -1\nset border 0\nunset tics\n" +
                   "set xrange [-" + range + ":" + range + "]\nset yrange [-" + range + ":" + range +
                   "]\nset key outside below center\nset style fill solid 1 border lc rgb '#ffffff'\n";
      for (double ring = step; ring < reach; ring += step)
        {
          std::string size;
          numeric_text::append(size, ring);
          job.script += "set object circle at 0,0 size " + size + " back fs empty border lc rgb '#b0b0b0' lw 0.7\n" +
                        "set label '" + numeric_text::rounded(ring) + " %' at " + size + "*0.7071," + size +
                        "*0.7071 front font ',9' tc rgb '#606060'\n";
        }
      const char right = along == 0 ? 'y' : 'x', up = along == 2 ? 'y' : 'z';
      job.script += std::string("set label '") + right + "' at " + range + ",0 right offset 0,0.7\nset label '" + up +
                    "' at 0," + range + " left offset 0.7,0\nplot ";
      std::string comma;
      const auto  add = [&](const char *name, const std::string &rows, const char *colour, const char *legend) {
        if (rows.empty())
          return;
        job.data[name] = rows;
        job.script +=
          comma + "'" + name + "' using 1:2 with filledcurves closed fc rgb '" + colour + "' title '" + legend + "'";
        comma = ", ";
      };
      add("torn", torn, "#d55e00", "tension");
      add("others", others, "#0072b2", "shear, or damaged until broken");
      draw_with_gnuplot(path, job);
    }
  } // namespace

  double BreakDirections::total() const
  {
    return std::accumulate(tension.begin(), tension.end(), 0.0) + std::accumulate(others.begin(), others.end(), 0.0);
  }

  BreakDirections directions_of(const std::vector<dem::Break> &breaks, const int looking_along)
  {
    const int       right = looking_along == 0 ? 1 : 0, up = looking_along == 2 ? 1 : 2;
    BreakDirections found;
    for (const dem::Break &b : breaks)
      {
        const double seen = std::hypot(b.normal[right], b.normal[up]);
        if (seen < 0.1)
          continue;
        // The crack lies across its bond; its two ends are the same.
        double angle  = std::fmod(std::atan2(b.normal[right], -b.normal[up]) + 2 * M_PI, M_PI);
        auto   sector = static_cast<std::size_t>(angle / M_PI * BreakDirections::sectors);
        sector        = std::min<std::size_t>(sector, BreakDirections::sectors - 1);
        (b.mode == dem::BreakMode::tension ? found.tension : found.others)[sector] += b.area * seen;
      }
    return found;
  }

  std::string picture_of_breaks(const std::filesystem::path   &path,
                                const dem::ParticleOutput     &particles,
                                const std::vector<dem::Break> &breaks,
                                const double                   thickness,
                                const std::string             &title,
                                const PictureSlab             &slab) noexcept
  {
    try
      {
        draw_breaks(path, particles, breaks, thickness, title, slab);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }

  std::string picture_of_directions(const std::filesystem::path   &path,
                                    const std::vector<dem::Break> &breaks,
                                    const int                      looking_along,
                                    const std::string             &title) noexcept
  {
    try
      {
        draw_directions(path, directions_of(breaks, looking_along), looking_along, title);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
