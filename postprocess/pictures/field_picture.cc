#include "postprocess/pictures/field_picture.h"

#include "postprocess/files/numeric_text.h"
#include "postprocess/pictures/gnuplot.h"
#include "postprocess/pictures/picture_axes.h"

#include <cmath>
#include <exception>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    void append_corner(std::string &text, const PictureFacet &facet, const std::size_t corner, const double scale)
    {
      for (const double value : {scale * facet.corner[corner][0], scale * facet.corner[corner][1], facet.value})
        {
          numeric_text::append(text, value);
          text += ' ';
        }
      text += '\n';
    }

    /** Closed polygons, each a block of its own: otherwise gnuplot joins them to a net. */
    std::string outlines(const std::vector<PictureCircle> &circles, const double scale)
    {
      constexpr int corners = 48;
      std::string   text;
      for (const PictureCircle &circle : circles)
        {
          for (int k = 0; k <= corners; ++k)
            {
              const double angle = 2 * M_PI * k / corners;
              for (const double value : {scale * (circle.centre[0] + circle.radius * std::cos(angle)),
                                         scale * (circle.centre[1] + circle.radius * std::sin(angle)), 0.0})
                {
                  numeric_text::append(text, value);
                  text += ' ';
                }
              text += '\n';
            }
          text += "\n\n";
        }
      return text;
    }

    Eigen::AlignedBox2d box_of(const std::vector<PictureFacet> &facets, const std::vector<PictureCircle> &circles)
    {
      Eigen::AlignedBox2d box;
      for (const PictureFacet &facet : facets)
        for (const auto &corner : facet.corner)
          {
            if (!std::isfinite(corner[0]) || !std::isfinite(corner[1]))
              throw std::invalid_argument("a corner is not a number");
            box.extend(Eigen::Vector2d(corner[0], corner[1]));
          }
      for (const PictureCircle &circle : circles)
        for (const double side : {-circle.radius, circle.radius})
          box.extend(Eigen::Vector2d(circle.centre[0] + side, circle.centre[1] + side));
      return box;
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
        GnuplotJob   job;
        const double scale =
          set_axes(job, {box_of(facets, what.circles), what.right, what.up, 900, 320, 140, 260}).per_metre;
        std::string &rows = job.data["facets"];
        for (const PictureFacet &facet : facets)
          {
            append_corner(rows, facet, 0, scale);
            append_corner(rows, facet, 1, scale);
            rows += '\n';
            append_corner(rows, facet, 3, scale);
            append_corner(rows, facet, 2, scale);
            rows += "\n\n";
          }
        std::string tick;
        numeric_text::append(tick, what.tick);
        std::string range = "set cbrange [";
        numeric_text::append(range, what.lowest);
        numeric_text::append(range += ':', what.highest);
        job.script += "set title " + gnuplot_quoted(what.title) + " noenhanced\nset pm3d map corners2color c1\n" +
                      "set cblabel " + gnuplot_quoted(what.label) + " noenhanced\n" + range + "]\n" +
                      "set lmargin at screen " + std::to_string(150.0 / job.width) + "\nset rmargin at screen " +
                      std::to_string(1 - 150.0 / job.width) + "\nset colorbox user origin screen " +
                      std::to_string(1 - 130.0 / job.width) + ",0.3 size screen 0.02,0.45\nset cbtics " + tick +
                      "\nset tics scale 0.15\n" + // as high for a thin bar
                      "set palette defined (0 '#e8edf3', 0.5 '#e0a050', 0.9 '#c1272d', 1 '#400010')\n" +
                      "splot 'facets' using 1:2:3:3 with pm3d notitle";
        if (!what.circles.empty())
          {
            job.data["circles"] = outlines(what.circles, scale);
            job.script += ", 'circles' using 1:2:3 with lines lc rgb '#404040' notitle";
          }
        job.script += '\n';
        draw_with_gnuplot(path, job);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
