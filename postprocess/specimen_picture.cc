#include "postprocess/specimen_picture.h"

#include "postprocess/gnuplot.h"
#include "postprocess/numeric_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
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

      /** Farther from the eye, which looks along y, and against x and z, so that the other two axes go right and up. */
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

      Eigen::Vector2d projected(const Eigen::Vector3d &vector) const { return {vector[right], vector[up]}; }

      /** Where the particle was when the specimen was made. */
      Eigen::Vector3d origin(const std::size_t i) const { return particles.position[i] - particles.displacement[i]; }

      char name_of_right() const { return "xyz"[right]; }
      char name_of_up() const { return "xyz"[up]; }

    private:
      const dem::ParticleOutput &particles;
      const PictureSlab         &slab;
      int                        right, up;
      double                     middle, half_width;
    };

    void append_row(std::string &text, const std::initializer_list<double> values)
    {
      for (const double value : values)
        {
          numeric_text::append(text, value);
          text += ' ';
        }
      text += '\n';
    }

    /** Particles in the slab, the farthest first, so that nearer ones are drawn over them. */
    std::vector<std::size_t> shown_particles(const dem::ParticleOutput &particles, const View &view)
    {
      std::vector<std::size_t> shown;
      for (std::size_t i = 0; i < particles.position.size(); ++i)
        if (view.shows(i))
          shown.push_back(i);
      if (shown.empty())
        throw std::invalid_argument("there is no particle in the slab");
      std::stable_sort(shown.begin(), shown.end(), [&](const auto i, const auto j) { return view.is_behind(i, j); });
      return shown;
    }

    /** What the picture shows [mm]: all circles, but debris only near the specimen. */
    Eigen::AlignedBox2d
    frame_of(const dem::ParticleOutput &particles, const View &view, const std::vector<std::size_t> &shown)
    {
      Eigen::AlignedBox2d now, at_first;
      for (const std::size_t i : shown)
        {
          const Eigen::Vector2d radius = Eigen::Vector2d::Constant(particles.radius[i] * millimetres);
          const Eigen::Vector2d before = view.projected(view.origin(i)) * millimetres;
          now.extend(view.on_paper(i) - radius).extend(view.on_paper(i) + radius);
          at_first.extend(before - radius).extend(before + radius);
        }
      const Eigen::Vector2d margin = Eigen::Vector2d::Constant(at_first.sizes().maxCoeff() / 5);
      return now.intersection(Eigen::AlignedBox2d(at_first.min() - margin, at_first.max() + margin));
    }

    std::string
    circle_rows(const dem::ParticleOutput &particles, const View &view, const std::vector<std::size_t> &shown)
    {
      std::string text;
      for (const std::size_t i : shown)
        append_row(
          text, {view.on_paper(i).x(), view.on_paper(i).y(), particles.radius[i] * millimetres, particles.damage[i]});
      return text;
    }

    /** Dots on what is not of the first material: place, colour by material. */
    std::string dot_rows(const dem::ParticleOutput &particles, const View &view, const std::vector<std::size_t> &shown)
    {
      constexpr std::array<double, 5> colours = {0xb36b00, 0x2e7d32, 0x6a3d9a, 0x00838f, 0x5d4037};

      std::string text;
      for (const std::size_t i : shown)
        if (!particles.material.empty() && particles.material[i] > 0)
          append_row(text, {view.on_paper(i).x(), view.on_paper(i).y(),
                            colours[static_cast<std::size_t>(particles.material[i] - 1) % colours.size()]});
      return text;
    }

    /** A damaged or broken link that has opened: its facet seen as a segment across the link. */
    struct CrackSegment
    {
      Eigen::Vector2d start, along; ///< [mm]
      double          opening;      ///< relative displacement of the two particles along the link [m]
    };

    std::vector<CrackSegment>
    find_cracks(const dem::ParticleOutput &particles, const dem::LinkOutput &links, const View &view)
    {
      std::vector<CrackSegment> cracks;
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          const auto [i, j]    = links.ends[l];
          const bool has_crack = links.kind[l] == dem::LinkOutput::broken ||
                                 (links.kind[l] == dem::LinkOutput::cohesive && links.damage[l] > 0);
          if (!has_crack || !view.shows(i) || !view.shows(j))
            continue;
          const Eigen::Vector3d normal  = (view.origin(j) - view.origin(i)).normalized();
          const double          opening = normal.dot(particles.displacement[j] - particles.displacement[i]);
          const Eigen::Vector2d across  = view.projected(normal);
          if (opening <= 0 || across.norm() < 0.1) // closed, or seen from the front
            continue;
          const double          size  = 2 * std::min(particles.radius[i], particles.radius[j]) * millimetres;
          const Eigen::Vector2d along = Eigen::Vector2d(-across.y(), across.x()).normalized() * size;
          cracks.push_back({(view.on_paper(i) + view.on_paper(j) - along) / 2, along, opening});
        }
      return cracks;
    }

    /** The opening that is drawn in full red: few facets, of debris, are wider. */
    double wide_opening(std::vector<CrackSegment> cracks)
    {
      const auto wide = cracks.begin() + static_cast<std::ptrdiff_t>(cracks.size() * 9 / 10);
      std::nth_element(cracks.begin(), wide, cracks.end(),
                       [](const auto &a, const auto &b) { return a.opening < b.opening; });
      return wide->opening;
    }

    /** Rows of start, direction, and red, the more opaque the wider (gnuplot's 0xAARRGGBB; AA = 0 is opaque). */
    std::string crack_rows(const std::vector<CrackSegment> &cracks, const double wide)
    {
      constexpr double red = 0xc1272d, one_alpha = 1 << 24;

      std::string text;
      for (const CrackSegment &crack : cracks)
        {
          const double transparency = std::round(255 * (1 - std::min(1.0, crack.opening / wide)));
          if (transparency < 240) // the rest could not be seen
            append_row(text, {crack.start.x(), crack.start.y(), crack.along.x(), crack.along.y(),
                              transparency * one_alpha + red});
        }
      return text;
    }

    /** Script lines of the frame, and a picture in its proportion. */
    void set_frame(GnuplotJob &job, const Eigen::AlignedBox2d &box)
    {
      constexpr int longer_side = 760, shortest_width = 520, left_and_right = 190, above_and_below = 130; // [pixel]
      const double  scale = longer_side / box.sizes().maxCoeff();
      job.width           = std::max(shortest_width, static_cast<int>(box.sizes().x() * scale) + left_and_right);
      job.height          = static_cast<int>(box.sizes().y() * scale) + above_and_below;
      const auto range    = [&](const char axis, const int d) {
        job.script += std::string("set ") + axis + "range [";
        numeric_text::append(job.script, box.min()[d]);
        numeric_text::append(job.script += ':', box.max()[d]);
        job.script += "]\n";
      };
      range('x', 0);
      range('y', 1);
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
        const View view(particles, slab);
        const auto shown  = shown_particles(particles, view);
        const auto cracks = find_cracks(particles, links, view);

        GnuplotJob job;
        set_frame(job, frame_of(particles, view, shown));
        job.data["particles"] = circle_rows(particles, view, shown);
        job.script += "set title " + gnuplot_quoted(title) +
                      " noenhanced\nset size ratio -1\nset border lc rgb '#404040'\n" +
                      "set tics out nomirror\nset xlabel '" + view.name_of_right() + " [mm]'\nset ylabel '" +
                      view.name_of_up() + " [mm]'\nset cblabel 'Damage'\nset cbrange [0:1]\n" +
                      "set palette defined (0 '#f0f0f0', 1 '#5b7fb0')\nset style fill solid 1 noborder\n" +
                      "set key outside below center Left reverse\n" +
                      "plot 'particles' using 1:2:3:4 with circles lc palette notitle";
        if (const std::string dots = dot_rows(particles, view, shown); !dots.empty())
          {
            job.data["materials"] = dots;
            job.script += ", 'materials' using 1:2:3 with points pt 7 ps 0.7 lc rgb variable notitle, "
                          "NaN with points pt 7 ps 0.7 lc rgb '#b36b00' title 'not of the first material'";
          }
        if (!cracks.empty())
          {
            const double wide  = wide_opening(cracks);
            job.data["cracks"] = crack_rows(cracks, wide);
            job.script += ", 'cracks' using 1:2:3:4:5 with vectors nohead lw 2.5 lc rgb variable notitle, " +
                          std::string("NaN with lines lw 2.5 lc rgb '#c1272d' title 'open links, full red from ") +
                          numeric_text::rounded(wide * 1e6) + " µm'";
          }
        draw_with_gnuplot(path, job);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
