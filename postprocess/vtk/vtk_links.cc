#include "postprocess/vtk/vtk_links.h"

#include "postprocess/vtk/vtk_file.h"

#include <vtkCellArray.h>
#include <vtkNew.h>

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

    /** The points of the file, and which two of them each link joins. */
    struct Points
    {
      Points(const dem::LinkOutput &links, const dem::ParticleOutput &particles, const Images &images)
        : position(particles.position)
        , displacement(particles.displacement)
        , radius(particles.radius)
      {
        for (std::size_t i = 0; i < position.size(); ++i)
          id.push_back(static_cast<std::int32_t>(i) + 1);
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
  } // namespace

  void write_vtk_links(const std::filesystem::path &path,
                       const dem::LinkOutput       &links,
                       const dem::ParticleOutput   &particles,
                       const double                 time,
                       const Images                &images,
                       const Classes               &classes)
  {
    check_columns(links, particles, images, classes);

    const Points        points(links, particles, images);
    vtkNew<vtkPolyData> data;
    data->SetPoints(make_points(points.position));
    data->SetLines(points.lines);

    const FieldWriter values(field_file("links"), data);
    values.add("id", points.id);
    values.add("radius", points.radius);
    values.add("displacement", points.displacement);
    const dem::GlueOutput &glue = links.glue;
    const std::size_t      more = glue.particle.size();
    values.add("normal_force", joined(links.normal_force, glue.normal_force));
    values.add("shear_force", joined(links.shear_force, glue.shear_force));
    values.add("normal_stress", joined(links.normal_stress, glue.normal_stress));
    values.add("shear_stress", joined(links.shear_stress, glue.shear_stress));
    values.add("normal_strain", joined(links.normal_strain, glue.normal_strain));
    values.add("damage", joined(links.damage, glue.damage));
    values.add("kind", kinds(links));
    values.add("broken", broken_flags(links));
    if (more > 0)
      values.add("surface", joined(std::vector<std::int32_t>(links.kind.size(), -1), glue.surface));
    if (!links.pair.empty())
      values.add("material_pair", joined(links.pair, std::vector<std::int32_t>(more, -1)));
    if (!classes.empty())
      values.add("class", joined(classes, Classes(more, -1)));
    if (!images.empty())
      values.add("to_image", joined(image_flags(images), std::vector<std::int32_t>(more, 0)));
    for (std::size_t c = 0; c < links.quantities.size(); ++c)
      values.add_own(links.quantities[c].name, links.quantities[c].unit,
                     joined(links.history[c], std::vector<double>(more, 0.0)));
    write(path, data, time);
  }
} // namespace postprocess
