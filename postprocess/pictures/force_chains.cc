#include "postprocess/pictures/force_chains.h"

#include "postprocess/files/numeric_text.h"
#include "postprocess/pictures/gnuplot.h"
#include "postprocess/pictures/picture_axes.h"
#include "postprocess/pictures/picture_view.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    /** Widths of lines; each is a class of forces. */
    constexpr int    widths = 8;
    constexpr double widest = 6, least_part = 0.02;

    struct Chain
    {
      Eigen::Vector2d from, to; ///< [m]
      double          force;    ///< tension positive [N]
    };

    std::vector<Chain> chains_of(const dem::ParticleOutput           &particles,
                                 const dem::LinkOutput               &links,
                                 const std::vector<dem::WallContact> &walls,
                                 const PictureView                   &view,
                                 const PictureSlab                   &slab)
    {
      std::vector<Chain> found;
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          const auto [i, j] = links.ends[l];
          if (links.normal_force[l] != 0 && view.shows(i) && view.shows(j) &&
              (slab.images.empty() || !view.leads_to_image(l)))
            found.push_back({view.on_paper(i), view.on_paper(j), links.normal_force[l]});
        }
      for (const dem::WallContact &touch : walls)
        if (view.shows(touch.particle))
          found.push_back(
            {view.on_paper(touch.particle), view.projected(touch.place),
             std::copysign(touch.force.norm(), touch.force.dot(touch.place - particles.position[touch.particle]))});
      return found;
    }

    std::string chain_rows(
      const std::vector<Chain> &chains, const int width, const bool tension, const double largest, const double scale)
    {
      std::string text;
      for (const Chain &chain : chains)
        {
          const double part = std::abs(chain.force) / largest;
          const int    own  = std::min(widths - 1, static_cast<int>(part * widths));
          if (own != width || (chain.force > 0) != tension || part < least_part)
            continue;
          const Eigen::Vector2d along = chain.to - chain.from;
          append_row(text, {scale * chain.from.x(), scale * chain.from.y(), scale * along.x(), scale * along.y()});
        }
      return text;
    }

    /** Lines of one sign, thin ones first; @return whether there is any */
    bool add_chains(
      GnuplotJob &job, const std::vector<Chain> &chains, const bool tension, const double largest, const double scale)
    {
      bool any = false;
      for (int width = 0; width < widths; ++width)
        {
          const std::string rows = chain_rows(chains, width, tension, largest, scale);
          if (rows.empty())
            continue;
          any                    = true;
          const std::string name = (tension ? "tension" : "compression") + std::to_string(width);
          job.data[name]         = rows;
          job.script += ", '" + name + "' using 1:2:3:4 with vectors nohead lw " +
                        numeric_text::rounded(widest * (width + 0.5) / widths) + " lc rgb '" +
                        (tension ? "#d55e00" : "#0072b2") + "' notitle";
        }
      return any;
    }

    void draw_forces(const std::filesystem::path         &path,
                     const dem::ParticleOutput           &particles,
                     const dem::LinkOutput               &links,
                     const std::vector<dem::WallContact> &walls,
                     const std::string                   &title,
                     const PictureSlab                   &slab)
    {
      const PictureView view(particles, slab);
      const auto        shown   = view.shown();
      const auto        chains  = chains_of(particles, links, walls, view, slab);
      double            largest = 0;
      for (const Chain &chain : chains)
        largest = std::max(largest, std::abs(chain.force));
      if (!(largest > 0))
        throw std::invalid_argument("no force acts between the particles that are shown");
      GnuplotJob         job;
      const PictureFrame frame{view.frame(shown), view.name_of_right(), view.name_of_up(), 760, 130, 160, 480};
      const double       scale = set_axes(job, frame).per_metre;
      std::string        outlines;
      for (const std::size_t i : shown)
        append_row(outlines, {scale * view.on_paper(i).x(), scale * view.on_paper(i).y(), scale * particles.radius[i]});
      job.data["particles"] = outlines;
      job.script += "set title " + gnuplot_quoted(title) +
                    " noenhanced\nset style fill solid 1 border lc rgb '#e0e0e0'\n" + legend_below() +
                    "plot 'particles' using 1:2:3 with circles fc "
                    "rgb '#fafafa' notitle";
      const std::string width  = numeric_text::rounded(widest);
      const bool        pushed = add_chains(job, chains, false, largest, scale);
      const bool        pulled = add_chains(job, chains, true, largest, scale);
      const std::string size   = numeric_text::rounded(largest) + " N";
      if (pushed)
        job.script += ", NaN with lines lw " + width + " lc rgb '#0072b2' title 'compression, this wide: " + size + "'";
      if (pulled)
        job.script += ", NaN with lines lw " + width + " lc rgb '#d55e00' title 'tension, this wide: " + size + "'";
      draw_with_gnuplot(path, job);
    }
  } // namespace

  std::string picture_of_forces(const std::filesystem::path         &path,
                                const dem::ParticleOutput           &particles,
                                const dem::LinkOutput               &links,
                                const std::vector<dem::WallContact> &walls,
                                const std::string                   &title,
                                const PictureSlab                   &slab) noexcept
  {
    try
      {
        draw_forces(path, particles, links, walls, title, slab);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
