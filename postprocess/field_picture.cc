#include "postprocess/field_picture.h"

#include "postprocess/gnuplot.h"
#include "postprocess/numeric_text.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    constexpr double millimetres = 1e3; // of a metre

    void append_corner(std::string &text, const PictureFacet &facet, const std::size_t corner)
    {
      for (const double value :
           {facet.corner[corner][0] * millimetres, facet.corner[corner][1] * millimetres, facet.value})
        {
          numeric_text::append(text, value);
          text += ' ';
        }
      text += '\n';
    }

    /** A picture in the proportion of what it shows. */
    void set_size(GnuplotJob &job, const std::vector<PictureFacet> &facets)
    {
      constexpr int longer_side = 900, around_x = 220, around_y = 140, least = 260; // [pixel]
      double        low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
      for (const PictureFacet &facet : facets)
        for (const auto &corner : facet.corner)
          for (int i = 0; i < 2; ++i)
            {
              if (!std::isfinite(corner[static_cast<std::size_t>(i)]))
                throw std::invalid_argument("a corner is not a number");
              low[i]  = std::min(low[i], corner[static_cast<std::size_t>(i)]);
              high[i] = std::max(high[i], corner[static_cast<std::size_t>(i)]);
            }
      const double scale = longer_side / std::max(high[0] - low[0], high[1] - low[1]);
      job.width          = std::max(least, static_cast<int>((high[0] - low[0]) * scale)) + around_x;
      job.height         = std::max(least, static_cast<int>((high[1] - low[1]) * scale) + around_y);
    }
  } // namespace

  std::string picture_of_field(const std::filesystem::path     &path,
                               const std::vector<PictureFacet> &facets,
                               const FieldPicture              &what) noexcept
  {
    try
      {
        if (facets.empty())
          throw std::invalid_argument("there is nothing to draw");
        GnuplotJob job;
        set_size(job, facets);
        std::string &rows = job.data["facets"];
        for (const PictureFacet &facet : facets)
          {
            append_corner(rows, facet, 0);
            append_corner(rows, facet, 1);
            rows += '\n';
            append_corner(rows, facet, 3);
            append_corner(rows, facet, 2);
            rows += "\n\n";
          }
        std::string range = "set cbrange [";
        numeric_text::append(range, what.lowest);
        numeric_text::append(range += ':', what.highest);
        job.script = "set title " + gnuplot_quoted(what.title) + " noenhanced\nset pm3d map corners2color c1\n" +
                     "set size ratio -1\nset tics out nomirror\nset border 15 lc rgb '#404040'\nset xlabel '" +
                     what.right + " [mm]'\nset ylabel '" + what.up + " [mm]'\nset cblabel " +
                     gnuplot_quoted(what.label) + " noenhanced\n" + range + "]\n" +
                     "set palette defined (0 '#e8edf3', 0.5 '#e0a050', 0.9 '#c1272d', 1 '#400010')\n" +
                     "splot 'facets' using 1:2:3:3 with pm3d notitle\n";
        draw_with_gnuplot(path, job);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
