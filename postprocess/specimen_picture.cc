#include "postprocess/specimen_picture.h"

#include "postprocess/gnuplot.h"
#include "postprocess/numeric_text.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    constexpr double millimetres = 1e3; // of a metre

    /** A slab with its numbers filled in, and the two axes of the picture. */
    class View
    {
    public:
      View(const dem::ParticleOutput &particles_, const PictureSlab &slab_)
        : particles(particles_)
        , slab(slab_)
        , right(slab.axis == 0 ? 1 : 0)
        , up(slab.axis == 2 ? 1 : 2)
      {
        if (slab.axis < 0 || slab.axis > 2)
          throw std::invalid_argument("the axis of the slab is 0, 1 or 2");
        if (particles.position.empty())
          throw std::invalid_argument("there is no particle");
        double lowest = origin(0)[slab.axis], highest = lowest, radii = 0;
        for (std::size_t i = 0; i < particles.position.size(); ++i)
          {
            lowest  = std::min(lowest, origin(i)[slab.axis]);
            highest = std::max(highest, origin(i)[slab.axis]);
            radii += particles.radius[i];
          }
        middle     = slab.position.value_or((lowest + highest) / 2);
        half_width = slab.thickness.value_or(4 * radii / particles.radius.size()) / 2;
      }

      bool shows(const std::size_t i) const { return std::fabs(origin(i)[slab.axis] - middle) <= half_width; }

      /** Farther from the eye, which looks along +y, and against x and z, so that the other two axes are right-handed.
       */
      bool is_behind(const std::size_t i, const std::size_t j) const
      {
        const double depth_i = origin(i)[slab.axis], depth_j = origin(j)[slab.axis];
        return slab.axis == 1 ? depth_i > depth_j : depth_i < depth_j;
      }

      Eigen::Vector2d on_paper(const std::size_t i) const
      {
        const Eigen::Vector3d drawn = origin(i) + slab.magnify * particles.displacement[i];
        return {drawn[right] * millimetres, drawn[up] * millimetres};
      }

      char name_of_right() const { return "xyz"[right]; }
      char name_of_up() const { return "xyz"[up]; }

    private:
      Eigen::Vector3d origin(const std::size_t i) const { return particles.position[i] - particles.displacement[i]; }

      const dem::ParticleOutput &particles;
      const PictureSlab         &slab;
      int                        right, up;
      double                     middle, half_width;
    };

    void append_row(std::string &text, const std::initializer_list<double> values)
    {
      for (const double value : values)
        numeric_text::append(text, value), text += ' ';
      text += '\n';
    }

    std::string circles(const dem::ParticleOutput &particles, const View &view)
    {
      std::vector<std::size_t> shown(particles.position.size());
      std::iota(shown.begin(), shown.end(), 0);
      shown.erase(std::remove_if(shown.begin(), shown.end(), [&](const auto i) { return !view.shows(i); }),
                  shown.end());
      std::sort(shown.begin(), shown.end(), [&](const auto i, const auto j) { return view.is_behind(i, j); });

      std::string text;
      for (const std::size_t i : shown)
        append_row(
          text, {view.on_paper(i).x(), view.on_paper(i).y(), particles.radius[i] * millimetres, particles.damage[i]});
      return text;
    }

    /** Start and direction of each broken link with both ends in the slab. */
    std::string broken_links(const dem::LinkOutput &links, const View &view)
    {
      std::string text;
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          const auto [first, second] = links.ends[l];
          if (links.kind[l] != dem::LinkOutput::broken || !view.shows(first) || !view.shows(second))
            continue;
          const Eigen::Vector2d from = view.on_paper(first), along = view.on_paper(second) - from;
          append_row(text, {from.x(), from.y(), along.x(), along.y()});
        }
      return text;
    }
  } // namespace

  std::string picture_of_specimen(const std::filesystem::path &path,
                                  const dem::ParticleOutput   &particles,
                                  const dem::LinkOutput       &links,
                                  const std::string           &title,
                                  const PictureSlab           &slab) noexcept
  {
    try
      {
        const View        view(particles, slab);
        const std::string shown = circles(particles, view), broken = broken_links(links, view);
        if (shown.empty())
          throw std::invalid_argument("there is no particle in the slab");

        GnuplotJob job;
        job.width = 900, job.height = 900;
        job.data = {{"particles", shown}, {"broken", broken}};
        job.script =
          "set title " + gnuplot_quoted(title) + " noenhanced\nset size ratio -1\nset border lc rgb '#404040'\n" +
          "set tics out nomirror\nset xlabel '" + view.name_of_right() + " [mm]'\nset ylabel '" + view.name_of_up() +
          " [mm]'\nset cblabel 'Damage'\nset cbrange [0:1]\n" +
          "set palette defined (0 '#f2f2f2', 0.5 '#9ebcda', 1 '#2a3f6f')\nset style fill solid 1 noborder\n" +
          "plot 'particles' using 1:2:3:4 with circles lc palette notitle";
        if (!broken.empty())
          job.script += ", 'broken' using 1:2:3:4 with vectors nohead lw 1.5 lc rgb '#D55E00' title 'broken links'";
        draw_with_gnuplot(path, job);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
