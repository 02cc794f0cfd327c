#include "postprocess/pictures/packing_picture.h"

#include "postprocess/files/numeric_text.h"
#include "postprocess/pictures/gnuplot.h"
#include "postprocess/pictures/picture_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

namespace postprocess
{
  namespace
  {
    void append_circle(std::string &text, const std::array<double, 4> &values)
    {
      for (const double value : values)
        {
          numeric_text::append(text, value);
          text += ' ';
        }
      text += '\n';
    }

    /** Discs, or spheres that the middle plane cuts: their sections. */
    struct DiscSections
    {
      std::vector<std::size_t> particle;
      std::vector<double>      radius; ///< [m]
      Eigen::AlignedBox2d      box;
      double                   middle   = 0; ///< z of the cut [m]
      bool                     in_space = false;
    };

    DiscSections disc_sections(const dem::Packing &packing)
    {
      double low = packing.centre[0].z(), high = low;
      for (const Eigen::Vector3d &x : packing.centre)
        {
          low  = std::min(low, x.z());
          high = std::max(high, x.z());
        }
      const double middle = 0.5 * (low + high);
      DiscSections found;
      found.middle   = middle;
      found.in_space = high > low;
      for (std::size_t i = 0; i < packing.size(); ++i)
        {
          const double away    = packing.centre[i].z() - middle,
                       squared = packing.radius[i] * packing.radius[i] - away * away;
          if (squared <= 0)
            continue;
          const double          r = std::sqrt(squared);
          const Eigen::Vector2d x = packing.centre[i].head<2>();
          found.particle.push_back(i);
          found.radius.push_back(r);
          found.box.extend(x - Eigen::Vector2d::Constant(r)).extend(x + Eigen::Vector2d::Constant(r));
        }
      return found;
    }

    /** Of spheres, where they are cut; discs are whole. */
    std::string title_of(const std::string &title, const DiscSections &sections)
    {
      return sections.in_space ? title + ": cut at z = " + length_text(sections.middle) : title;
    }

    std::string circles_of_packing(const dem::Packing &packing,
                                   const DiscSections &sections,
                                   const double        scale,
                                   const bool          by_material)
    {
      std::string text;
      for (std::size_t k = 0; k < sections.particle.size(); ++k)
        {
          const std::size_t i = sections.particle[k];
          append_circle(text,
                        {{scale * packing.centre[i].x(), scale * packing.centre[i].y(), scale * sections.radius[k],
                          by_material ? packing.material[i] : 2e3 * packing.radius[i]}});
        }
      return text;
    }

    std::string colours_of_packing(const dem::Packing &packing, const bool by_material)
    {
      if (by_material)
        return "unset colorbox\nset palette defined (0 '#d9cfb8', 1 '#5b7fb0', 2 '#b36b00', 3 '#2e7d32')\n"
               "set cbrange [0:3]\n";
      const auto [smallest, largest] = std::minmax_element(packing.radius.begin(), packing.radius.end());
      std::string text = "set cblabel 'Diameter [mm]'\nset palette defined (0 '#e3d9c3', 1 '#b36b00', 2 '#5b3a1a')\n";
      if (*largest < 1.05 * *smallest)
        return text;
      text += "set cbrange [";
      numeric_text::append(text, 2e3 * *smallest);
      text += ':';
      numeric_text::append(text, 2e3 * *largest);
      return text + "]\n";
    }
  } // namespace

  std::string
  picture_of_packing(const std::filesystem::path &path, const dem::Packing &packing, const std::string &title) noexcept
  {
    try
      {
        const DiscSections sections    = disc_sections(packing);
        const bool         by_material = packing.material_names.size() > 1;
        GnuplotJob         job;
        const PictureFrame frame{sections.box, 'x', 'y', 760, 230, 150, 480};
        const double       scale = set_axes(job, frame).per_metre;
        job.data["particles"]    = circles_of_packing(packing, sections, scale, by_material);
        job.script += "set title " + gnuplot_quoted(title_of(title, sections)) + " noenhanced\n" +
                      colours_of_packing(packing, by_material) + (by_material ? "" : colour_bar(job, frame)) +
                      "set style fill solid 1 noborder\nunset key\n"
                      "plot 'particles' using 1:2:3:4 with circles lc palette notitle";
        draw_with_gnuplot(path, job);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
