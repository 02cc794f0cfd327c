#include "postprocess/pictures/picture_axes.h"

#include "postprocess/files/numeric_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    constexpr double character = 8, line = 30; // [pixel], with the font of draw_with_gnuplot()

    /** The longest label that ticks of that step have within the range. */
    std::size_t label_length(const double low, const double high, const double step)
    {
      std::size_t longest = 0;
      for (const double value : {std::ceil(low / step) * step, std::floor(high / step) * step})
        {
          char text[40];
          longest = std::max(longest, static_cast<std::size_t>(std::snprintf(text, sizeof(text), "%.6g", value)));
        }
      return longest;
    }

    void set_axis(GnuplotJob &job, const char axis, const double low, const double high, const double step)
    {
      job.script += std::string("set ") + axis + "range [";
      numeric_text::append(job.script, low);
      numeric_text::append(job.script += ':', high);
      job.script += std::string("]\nset ") + axis + "tics ";
      numeric_text::append(job.script, step);
      job.script += "\n";
    }
  } // namespace

  LengthUnit length_unit(const double extent)
  {
    return extent >= 2 ? LengthUnit{1, "m"} : extent >= 2e-3 ? LengthUnit{1e3, "mm"} : LengthUnit{1e6, "µm"};
  }

  std::string length_text(const double metres)
  {
    const double     size = std::fabs(metres);
    const LengthUnit unit = size >= 1    ? LengthUnit{1, "m"} :
                            size >= 1e-3 ? LengthUnit{1e3, "mm"} :
                                           LengthUnit{1e6, "µm"};
    return numeric_text::rounded(unit.per_metre * metres) + " " + unit.name;
  }

  double tick_step(const double range, const double most)
  {
    const double wished = range / std::max(1.0, most), decade = std::pow(10, std::floor(std::log10(wished)));
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor * decade >= wished * (1 - 1e-9))
        return factor * decade;
    return 10 * decade;
  }

  double round_magnification(const double wished)
  {
    if (!(wished > 1))
      return 1;
    const double decade = std::pow(10, std::floor(std::log10(wished)));
    return std::floor(wished / decade) * decade;
  }

  double horizontal_tick_step(const double low, const double high, const double pixels)
  {
    double step = tick_step(high - low, std::min(8.0, pixels / line));
    for (int i = 0; i < 3; ++i) // a coarser step may have shorter labels
      step = tick_step(high - low,
                       std::min(8.0, pixels / (character * static_cast<double>(label_length(low, high, step) + 2))));
    return step;
  }

  LengthUnit set_axes(GnuplotJob &job, const PictureFrame &frame)
  {
    const Eigen::Vector2d sizes = frame.box.sizes();
    if (!(sizes.minCoeff() >= 0) || !(sizes.maxCoeff() > 0) || !frame.box.min().allFinite() ||
        !frame.box.max().allFinite())
      throw std::invalid_argument("what is to be drawn has no extent, or is not a number");
    const LengthUnit unit     = length_unit(sizes.maxCoeff());
    const double     scale    = frame.longer_side / sizes.maxCoeff(); // [pixel/m]
    job.width                 = std::max(frame.least, static_cast<int>(sizes.x() * scale) + frame.around_x);
    job.height                = std::max(frame.least, static_cast<int>(sizes.y() * scale) + frame.around_y);
    const Eigen::Vector2d low = unit.per_metre * frame.box.min(), high = unit.per_metre * frame.box.max();
    set_axis(job, 'x', low.x(), high.x(), horizontal_tick_step(low.x(), high.x(), sizes.x() * scale));
    set_axis(job, 'y', low.y(), high.y(), tick_step(high.y() - low.y(), std::min(10.0, sizes.y() * scale / line)));
    job.script += std::string("set size ratio -1\nset border 15 lc rgb '#404040'\nset tics out nomirror\n") +
                  "set xlabel '" + frame.right + " [" + unit.name + "]' noenhanced\nset ylabel '" + frame.up + " [" +
                  unit.name + "]' noenhanced\n";
    return unit;
  }

  std::string legend_below()
  {
    return "set key outside below center Left reverse samplen 2 height 1\n"; // without more height the two touch
  }

  std::string colour_bar(const GnuplotJob &job, const PictureFrame &frame)
  {
    constexpr double least = 200; // [pixel]
    if (frame.box.sizes().y() / frame.box.sizes().maxCoeff() * frame.longer_side >= least)
      return "";
    return "set rmargin at screen " + std::to_string(1 - 120.0 / job.width) + "\nset colorbox user origin screen " +
           std::to_string(1 - 100.0 / job.width) + "," + std::to_string(0.5 - 0.5 * least / job.height) +
           " size screen 0.02," + std::to_string(least / job.height) + "\n";
  }
} // namespace postprocess
