#include "postprocess/vtk/vtk_links.h"

#include "postprocess/vtk/vtk_file.h"

#include <vtkCellArray.h>

#include <algorithm>
#include <stdexcept>

namespace postprocess
{
  using namespace vtk_file;

  namespace
  {
    using Images  = std::vector<dem::LinkImage>;
    using Classes = std::vector<std::int32_t>;

    void check_columns(const dem::LinkOutput     &links,
                       const dem::ParticleOutput &particles,
                       const Images              &images,
                       const Classes             &classes)
    {
      const std::size_t n = links.ends.size();
      check_length("write_vtk_links", "kind", links.kind.size(), n);
      check_length("write_vtk_links", "normal_force", links.normal_force.size(), n);
      check_length("write_vtk_links", "shear_force", links.shear_force.size(), n);
      check_length("write_vtk_links", "normal_stress", links.normal_stress.size(), n);
      check_length("write_vtk_links", "shear_stress", links.shear_stress.size(), n);
      check_length("write_vtk_links", "normal_strain", links.normal_strain.size(), n);
      check_length("write_vtk_links", "damage", links.damage.size(), n);
      if (!links.pair.empty())
        check_length("write_vtk_links", "pair", links.pair.size(), n);
      if (!images.empty())
        check_length("write_vtk_links", "images", images.size(), n);
      if (!classes.empty())
        check_length("write_vtk_links", "classes", classes.size(), n);
      check_length("write_vtk_links", "radius of particles", particles.radius.size(), particles.position.size());
      check_length("write_vtk_links", "displacement of particles", particles.displacement.size(),
                   particles.position.size());
    }

    /** What a file shows: all links, or those of one rank. */
    struct Shown
    {
      const dem::LinkOutput     &links;
      const dem::ParticleOutput &particles;
      const Images              &images;
      const Classes             &classes;
      std::vector<std::int64_t>  ids;   ///< of particles, from 1
      std::vector<std::int64_t>  lines; ///< of links of one rank
      bool                       several_pairs, glued, periodic, classed, in_pieces;
    };

    /** The points of the file, and which two of them each link joins. */
    struct Points
    {
      explicit Points(const Shown &shown)
        : position(shown.particles.position)
        , displacement(shown.particles.displacement)
        , radius(shown.particles.radius)
        , id(shown.ids.begin(), shown.ids.end())
      {
        const dem::LinkOutput     &links     = shown.links;
        const dem::ParticleOutput &particles = shown.particles;
        const Images              &images    = shown.images;
        lines->AllocateExact(static_cast<vtkIdType>(links.ends.size()), static_cast<vtkIdType>(2 * links.ends.size()));
        for (std::size_t l = 0; l < links.ends.size(); ++l)
          {
            const auto &ends = links.ends[l];
            if (ends[0] >= particles.position.size() || ends[1] >= particles.position.size())
              throw std::invalid_argument("write_vtk_links: a link ends at particle " +
                                          std::to_string(std::max(ends[0], ends[1])) + " of " +
                                          std::to_string(particles.position.size()));
            const bool        is_other = !images.empty() && images[l].is_other();
            const std::size_t second   = is_other ? add_image(images[l], ends[1]) : ends[1];
            const vtkIdType   joins[2] = {static_cast<vtkIdType>(ends[0]), static_cast<vtkIdType>(second)};
            lines->InsertNextCell(2, joins);
          }
        for (std::size_t b = 0; b < links.glue.particle.size(); ++b)
          {
            const vtkIdType joins[2] = {static_cast<vtkIdType>(links.glue.particle[b]),
                                        static_cast<vtkIdType>(position.size())};
            position.push_back(links.glue.anchor[b]);
            displacement.push_back(links.glue.moved[b]);
            radius.push_back(0);
            id.push_back(-1);
            lines->InsertNextCell(2, joins);
          }
      }

      std::vector<Eigen::Vector3d>  position, displacement;
      std::vector<double>           radius;
      std::vector<std::int32_t>     id; ///< of the particle, from 1
      vtkSmartPointer<vtkCellArray> lines = vtkSmartPointer<vtkCellArray>::New();

    private:
      std::size_t add_image(const dem::LinkImage &image, const std::size_t particle)
      {
        position.push_back(position[particle] + image.now);
        displacement.push_back(displacement[particle] + image.now - image.at_start);
        radius.push_back(radius[particle]);
        id.push_back(id[particle]);
        return position.size() - 1;
      }
    };

    std::vector<std::int32_t> image_flags(const Images &images)
    {
      std::vector<std::int32_t> flags;
      for (const dem::LinkImage &image : images)
        flags.push_back(image.is_other() ? 1 : 0);
      return flags;
    }

    /** Of links between particles, and after them of glue. */
    template <typename Value>
    std::vector<Value> joined(std::vector<Value> of_links, const std::vector<Value> &of_glue)
    {
      of_links.insert(of_links.end(), of_glue.begin(), of_glue.end());
      return of_links;
    }

    /** The same in place of copies where there is no glue. */
    Array numbers_of(const std::string &name, const std::vector<double> &of_links, const std::vector<double> &of_glue)
    {
      return of_glue.empty() ? make_view(name, of_links) : make_array(name, joined(of_links, of_glue));
    }

    std::vector<std::int32_t> kinds(const dem::LinkOutput &links)
    {
      std::vector<std::int32_t> all = links.kind;
      for (const std::int32_t torn : links.glue.torn)
        all.push_back(torn == 1 ? dem::LinkOutput::broken : dem::LinkOutput::cohesive);
      return all;
    }

    std::vector<std::int32_t> broken_flags(const dem::LinkOutput &links)
    {
      std::vector<std::int32_t> flags;
      for (const std::int32_t kind : kinds(links))
        flags.push_back(kind == dem::LinkOutput::broken ? 1 : 0);
      return flags;
    }

    /** Cell data that only some files have. */
    void add_occasional(const FieldWriter &values, const Shown &shown)
    {
      const dem::LinkOutput &links = shown.links;
      const std::size_t      more  = links.glue.particle.size();
      if (shown.glued)
        values.add("surface", joined(std::vector<std::int32_t>(links.kind.size(), -1), links.glue.surface));
      if (shown.several_pairs)
        values.add("material_pair", joined(links.pair, std::vector<std::int32_t>(more, -1)));
      if (shown.classed)
        values.add("class", joined(shown.classes, Classes(more, -1)));
      if (shown.periodic)
        values.add("to_image", joined(image_flags(shown.images), std::vector<std::int32_t>(more, 0)));
      if (shown.in_pieces)
        values.add(make_numbers("line", shown.lines));
      for (std::size_t c = 0; c < links.quantities.size(); ++c)
        values.add_own(numbers_of(links.quantities[c].name, links.history[c], std::vector<double>(more, 0.0)),
                       links.quantities[c].unit);
    }

    /** As long as what is shown stays: its numbers are not all copied. */
    vtkSmartPointer<vtkPolyData> data_of(const Shown &shown)
    {
      const dem::LinkOutput &links = shown.links;
      const dem::GlueOutput &glue  = links.glue;
      check_columns(links, shown.particles, shown.images, shown.classes);

      const Points ends(shown);
      auto         data = vtkSmartPointer<vtkPolyData>::New();
      data->SetPoints(make_points(ends.position));
      data->SetLines(ends.lines);

      const FieldWriter values(field_file("links"), data);
      values.add("id", ends.id);
      values.add("radius", ends.radius);
      values.add("displacement", ends.displacement);
      values.add(numbers_of("normal_force", links.normal_force, glue.normal_force));
      values.add(numbers_of("shear_force", links.shear_force, glue.shear_force));
      values.add(numbers_of("normal_stress", links.normal_stress, glue.normal_stress));
      values.add(numbers_of("shear_stress", links.shear_stress, glue.shear_stress));
      values.add(numbers_of("normal_strain", links.normal_strain, glue.normal_strain));
      values.add(numbers_of("damage", links.damage, glue.damage));
      values.add("kind", kinds(links));
      values.add("broken", broken_flags(links));
      add_occasional(values, shown);
      return data;
    }

    vtkSmartPointer<vtkPolyData>
    data_of(const dem::RankOutput &shown, const ImagesOfCell &images, const ClassesOfLinks &classes)
    {
      const Images  no_images;
      const Classes no_classes;
      return data_of({shown.links, shown.points, images ? *images : no_images, classes ? *classes : no_classes,
                      ids_of(shown.number_of_point), shown.line, shown.several_materials, shown.glued,
                      images.has_value(), classes.has_value(), true});
    }
  } // namespace

  void write_vtk_links(const std::filesystem::path &path,
                       const dem::LinkOutput       &links,
                       const dem::ParticleOutput   &particles,
                       const double                 time,
                       const Images                &images,
                       const Classes               &classes)
  {
    const auto data = data_of({links,
                               particles,
                               images,
                               classes,
                               numbers_from(1, particles.position.size()),
                               {},
                               !links.pair.empty(),
                               !links.glue.particle.empty(),
                               !images.empty(),
                               !classes.empty(),
                               false});
    write(path, data.Get(), time);
  }

  void write_vtk_links(const std::filesystem::path &path,
                       const dem::RankOutput       &shown,
                       const double                 time,
                       const ImagesOfCell          &images,
                       const ClassesOfLinks        &classes)
  {
    write(path, data_of(shown, images, classes).Get(), time);
  }

  void write_vtk_links_record(const std::filesystem::path    &path,
                              const dem::RankOutput          &like,
                              const ImagesOfCell             &images,
                              const ClassesOfLinks           &classes,
                              const std::vector<std::string> &pieces)
  {
    write_record(path, data_of(like, images, classes).Get(), pieces);
  }
} // namespace postprocess
