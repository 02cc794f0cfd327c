#include "postprocess/pictures/specimen_picture.h"

#include "postprocess/pictures/gnuplot.h"
#include "postprocess/pictures/picture_axes.h"
#include "postprocess/pictures/picture_view.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>

namespace postprocess
{
  namespace
  {
    /** Closed polygons, each a block of its own. */
    std::string body_rows(const std::vector<std::vector<Eigen::Vector2d>> &bodies, const double scale)
    {
      std::string text;
      for (const auto &body : bodies)
        {
          for (const Eigen::Vector2d &corner : body)
            append_row(text, {scale * corner.x(), scale * corner.y()});
          append_row(text, {scale * body.front().x(), scale * body.front().y()});
          text += "\n\n";
        }
      return text;
    }

    std::string circle_rows(const dem::ParticleOutput      &particles,
                            const PictureView              &view,
                            const std::vector<std::size_t> &shown,
                            const double                    scale)
    {
      std::string text;
      for (const std::size_t i : shown)
        append_row(text, {scale * view.on_paper(i).x(), scale * view.on_paper(i).y(), scale * particles.radius[i],
                          particles.damage[i]});
      return text;
    }

    // Of the materials from the second on; the colours of damage and cracks are left out.
    constexpr std::array<const char *, 5> material_colours = {"#b36b00", "#2e7d32", "#6a3d9a", "#00838f", "#5d4037"};

    const char *colour_of(const std::int32_t material)
    {
      return material_colours[static_cast<std::size_t>(material - 1) % material_colours.size()];
    }

    /** "NAME" of "NAME+2", which is the same material by another number. */
    std::string without_number(const std::string &name)
    {
      const std::size_t plus     = name.rfind('+');
      const bool        numbered = plus != std::string::npos && plus > 0 && plus + 1 < name.size() &&
                            name.find_first_not_of("0123456789", plus + 1) == std::string::npos;
      return numbered ? name.substr(0, plus) : name;
    }

    /** The first number of a material that has several. */
    std::int32_t first_number(const std::int32_t material, const std::vector<std::string> &names)
    {
      if (static_cast<std::size_t>(material) >= names.size())
        return material;
      const auto first =
        std::find(names.begin(), names.end(), without_number(names[static_cast<std::size_t>(material)]));
      return first == names.end() ? material : static_cast<std::int32_t>(first - names.begin());
    }

    /** Dots on what is of that material, by any of its numbers. */
    std::string dot_rows(const dem::ParticleOutput      &particles,
                         const PictureView              &view,
                         const std::vector<std::size_t> &shown,
                         const std::vector<std::string> &names,
                         const std::int32_t              material,
                         const double                    scale)
    {
      std::string text;
      for (const std::size_t i : shown)
        if (first_number(particles.material[i], names) == material)
          append_row(text,
                     {scale * view.on_paper(i).x(), scale * view.on_paper(i).y(), 0.4 * scale * particles.radius[i]});
      return text;
    }

    /** Add dots on all materials but the first, each with its name in the legend. */
    void draw_materials(GnuplotJob                     &job,
                        const dem::ParticleOutput      &particles,
                        const PictureView              &view,
                        const std::vector<std::size_t> &shown,
                        const std::vector<std::string> &names,
                        const double                    scale)
    {
      const std::int32_t last =
        particles.material.empty() ? 0 : *std::max_element(particles.material.begin(), particles.material.end());
      for (std::int32_t material = 1; material <= last; ++material)
        {
          const std::string rows = dot_rows(particles, view, shown, names, material, scale);
          if (rows.empty())
            continue;
          const auto        number = static_cast<std::size_t>(material);
          const std::string data = "material" + std::to_string(material), colour = colour_of(material);
          const std::string name = number < names.size() ? names[number] : "material " + std::to_string(material);
          job.data[data]         = rows;
          job.script += ", '" + data + "' using 1:2:3 with circles lc rgb '" + colour +
                        "' notitle, NaN with points pt 7 ps 1 lc rgb '" + colour + "' title " + gnuplot_quoted(name) +
                        " noenhanced";
        }
    }

    /** A damaged or broken link that has opened: the face between its particles, seen as a segment across the link. */
    struct CrackSegment
    {
      Eigen::Vector2d start, along; ///< [m]
      double          opening;      ///< relative displacement of the two particles along the link [m]
      std::size_t     of = 0;       ///< number of the class of its link
    };

    /** Each class of links once, in the order of the pairs of materials. */
    std::vector<std::string> distinct(const std::vector<std::string> &classes)
    {
      std::vector<std::string> found;
      for (const std::string &name : classes)
        if (std::find(found.begin(), found.end(), name) == found.end())
          found.push_back(name);
      return found;
    }

    constexpr std::size_t unknown_class = 0;

    /** Of each pair of materials the number of its class among the distinct ones. */
    std::vector<std::size_t> numbers_of(const std::vector<std::string> &classes)
    {
      const std::vector<std::string> all = distinct(classes);
      std::vector<std::size_t>       numbers;
      for (const std::string &name : classes)
        numbers.push_back(static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin()));
      return numbers;
    }

    /** Of a link. @param of_pairs as above */
    std::size_t class_of(const dem::LinkOutput &links, const std::size_t l, const std::vector<std::size_t> &of_pairs)
    {
      const auto pair = l < links.pair.size() ? static_cast<std::size_t>(links.pair[l]) : of_pairs.size();
      return pair < of_pairs.size() ? of_pairs[pair] : unknown_class;
    }

    // Of the classes, from the first: apart from the colours of damage and materials, also for colour-blind readers.
    constexpr std::array<const char *, 5> class_colours = {"c1272d", "000000", "9c27b0", "00838f", "5d4037"};

    const char *colour_of_class(const std::size_t number) { return class_colours[number % class_colours.size()]; }

    /** Two particles that a link joins, or a particle and the image of another. */
    struct LinkedPair
    {
      Eigen::Vector3d place[2], displacement[2]; ///< when the specimen was made; since then [m]
      double          radius;                    ///< the smaller one [m]
    };

    /** What a link joins; one to a periodic image is seen twice, from either side. */
    std::vector<LinkedPair> pairs_of(const dem::ParticleOutput &particles,
                                     const dem::LinkOutput     &links,
                                     const std::size_t          l,
                                     const PictureView         &view)
    {
      const auto [i, j]   = links.ends[l];
      const double radius = std::min(particles.radius[i], particles.radius[j]);
      LinkedPair pair{{view.origin(i), view.origin(j)}, {particles.displacement[i], particles.displacement[j]}, radius};
      if (!view.leads_to_image(l))
        return {pair};
      const dem::LinkImage &image = view.image(l);
      LinkedPair            other = pair;
      pair.place[1] += image.at_start;
      pair.displacement[1] += image.now - image.at_start;
      other.place[0] -= image.at_start;
      other.displacement[0] -= image.now - image.at_start;
      return {pair, other};
    }

    /** @param normal of the crack, from one side to the other @param middle of its faces on paper @param radius of the smaller side */
    void add_crack(std::vector<CrackSegment> &cracks,
                   const PictureView         &view,
                   const Eigen::Vector3d     &normal,
                   const double               opening,
                   const Eigen::Vector2d     &middle,
                   const double               radius,
                   const std::size_t          of = unknown_class)
    {
      const Eigen::Vector2d across = view.projected(normal);
      if (opening <= 0 || across.norm() < 0.1) // closed, or seen from the front
        return;
      const Eigen::Vector2d along = Eigen::Vector2d(-across.y(), across.x()).normalized() * 2 * radius;
      cracks.push_back({middle - along / 2, along, opening, of});
    }

    void add_cracks_of_links(std::vector<CrackSegment>      &cracks,
                             const dem::ParticleOutput      &particles,
                             const dem::LinkOutput          &links,
                             const PictureView              &view,
                             const std::vector<std::string> &classes)
    {
      const std::vector<std::size_t> of_pairs = numbers_of(classes);
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          const bool has_crack = links.kind[l] == dem::LinkOutput::broken ||
                                 (links.kind[l] == dem::LinkOutput::cohesive && links.damage[l] > 0);
          if (!has_crack)
            continue;
          for (const LinkedPair &pair : pairs_of(particles, links, l, view))
            {
              if (!view.shows(pair.place[0]) || !view.shows(pair.place[1]))
                continue;
              const Eigen::Vector3d normal = (pair.place[1] - pair.place[0]).normalized();
              add_crack(cracks, view, normal, normal.dot(pair.displacement[1] - pair.displacement[0]),
                        0.5 * (view.on_paper(pair.place[0], pair.displacement[0]) +
                               view.on_paper(pair.place[1], pair.displacement[1])),
                        pair.radius, class_of(links, l, of_pairs));
            }
        }
    }

    /** Between particles and the surfaces that they were glued to. */
    void add_cracks_of_glue(std::vector<CrackSegment> &cracks,
                            const dem::ParticleOutput &particles,
                            const dem::GlueOutput     &glue,
                            const PictureView         &view)
    {
      for (std::size_t g = 0; g < glue.particle.size(); ++g)
        {
          if (!glue.torn[g] && !(glue.damage[g] > 0))
            continue;
          const std::size_t     i      = glue.particle[g];
          const Eigen::Vector3d at     = glue.anchor[g] - glue.moved[g];
          const Eigen::Vector3d normal = (at - view.origin(i)).normalized();
          if (view.shows(view.origin(i)))
            add_crack(cracks, view, normal, normal.dot(glue.moved[g] - particles.displacement[i]),
                      view.on_paper(at, glue.moved[g]), particles.radius[i]);
        }
    }

    std::vector<CrackSegment> find_cracks(const dem::ParticleOutput      &particles,
                                          const dem::LinkOutput          &links,
                                          const PictureView              &view,
                                          const std::vector<std::string> &classes)
    {
      std::vector<CrackSegment> cracks;
      add_cracks_of_links(cracks, particles, links, view, classes);
      add_cracks_of_glue(cracks, particles, links.glue, view);
      return cracks;
    }

    /** The opening that is drawn in full colour: few facets, of debris, are wider. */
    double wide_opening(std::vector<CrackSegment> cracks)
    {
      const auto wide = cracks.begin() + static_cast<std::ptrdiff_t>(cracks.size() * 9 / 10);
      std::nth_element(cracks.begin(), wide, cracks.end(),
                       [](const auto &a, const auto &b) { return a.opening < b.opening; });
      return wide->opening;
    }

    /** Rows of start, direction, and the colour of the class, the more opaque the wider (gnuplot's 0xAARRGGBB; AA = 0 is opaque). */
    std::string crack_rows(const std::vector<CrackSegment> &cracks, const double wide, const double scale)
    {
      constexpr double one_alpha = 1 << 24;

      std::string text;
      for (const CrackSegment &crack : cracks)
        {
          const double transparency = std::round(255 * (1 - std::min(1.0, crack.opening / wide)));
          if (transparency < 240) // the rest could not be seen
            append_row(text, {scale * crack.start.x(), scale * crack.start.y(), scale * crack.along.x(),
                              scale * crack.along.y(),
                              transparency * one_alpha + std::stoi(colour_of_class(crack.of), nullptr, 16)});
        }
      return text;
    }

    /** Add the crack faces, and to the legend what their colours mean. @param classes that there are, none: all are alike */
    void draw_cracks(GnuplotJob                      &job,
                     const std::vector<CrackSegment> &cracks,
                     const std::vector<std::string>  &classes,
                     const double                     scale)
    {
      const double      wide = wide_opening(cracks);
      const std::string full = length_text(wide);
      job.data["cracks"]     = crack_rows(cracks, wide, scale);
      job.script += ", 'cracks' using 1:2:3:4:5 with vectors nohead lw 2.5 lc rgb variable notitle";
      const auto name = [&](const std::size_t of, const std::string &title) {
        job.script += std::string(", NaN with lines lw 2.5 lc rgb '#") + colour_of_class(of) + "' title " +
                      gnuplot_quoted(title) + " noenhanced";
      };
      if (classes.size() < 2)
        return name(unknown_class, "crack faces, full red from " + full);
      for (std::size_t of = 0; of < classes.size(); ++of)
        {
          const auto count =
            std::count_if(cracks.begin(), cracks.end(), [&](const auto &each) { return each.of == of; });
          if (count > 0)
            name(of, std::to_string(count) + " crack faces of " + classes[of] + ", full colour from " + full);
        }
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
        const PictureView view(particles, slab);
        const auto        shown  = view.shown();
        const auto        cracks = find_cracks(particles, links, view, slab.classes);

        GnuplotJob          job;
        Eigen::AlignedBox2d seen = view.frame(shown);
        for (const auto &body : slab.bodies)
          for (const Eigen::Vector2d &corner : body)
            seen.extend(corner);
        const PictureFrame frame{seen, view.name_of_right(), view.name_of_up(), 760, 230, 150, 480};
        const double       scale = set_axes(job, frame).per_metre;
        job.data["particles"]    = circle_rows(particles, view, shown, scale);
        job.script += "set title " + gnuplot_quoted(title) + " noenhanced\nset cblabel 'Damage'\nset cbrange [0:1]\n" +
                      colour_bar(job, frame) +
                      "set palette defined (0 '#f0f0f0', 1 '#5b7fb0')\nset style fill solid 1 noborder\n" +
                      legend_below() + "plot ";
        if (!slab.bodies.empty())
          {
            job.data["bodies"] = body_rows(slab.bodies, scale);
            job.script += "'bodies' using 1:2 with filledcurves closed fc rgb '#c3ccd6' notitle, "
                          "'bodies' using 1:2 with lines lw 0.5 lc rgb '#7d8996' notitle, ";
          }
        job.script += "'particles' using 1:2:3:4 with circles lc palette notitle";
        draw_materials(job, particles, view, shown, slab.materials, scale);
        if (!cracks.empty())
          draw_cracks(job, cracks, distinct(slab.classes), scale);
        draw_with_gnuplot(path, job);
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }
} // namespace postprocess
