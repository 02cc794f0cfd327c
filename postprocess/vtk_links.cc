#include "postprocess/vtk_links.h"

#include "postprocess/vtk_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <stdexcept>

namespace postprocess
{
  using namespace vtk_file;

  namespace
  {
    void check_columns(const dem::LinkOutput &links, const dem::ParticleOutput &particles)
    {
      const std::size_t n = links.ends.size();
      check_length("write_vtk_links", "kind", links.kind.size(), n);
      check_length("write_vtk_links", "normal_force", links.normal_force.size(), n);
      check_length("write_vtk_links", "shear_force", links.shear_force.size(), n);
      check_length("write_vtk_links", "normal_stress", links.normal_stress.size(), n);
      check_length("write_vtk_links", "shear_stress", links.shear_stress.size(), n);
      check_length("write_vtk_links", "normal_strain", links.normal_strain.size(), n);
      check_length("write_vtk_links", "damage", links.damage.size(), n);
      if (!links.law.empty())
        check_length("write_vtk_links", "law", links.law.size(), n);
      check_length("write_vtk_links", "radius of particles", particles.radius.size(), particles.position.size());
      check_length("write_vtk_links", "displacement of particles", particles.displacement.size(),
                   particles.position.size());
    }

    vtkSmartPointer<vtkCellArray> lines_between(const dem::LinkOutput &links, const std::size_t particles)
    {
      auto lines = vtkSmartPointer<vtkCellArray>::New();
      lines->AllocateExact(static_cast<vtkIdType>(links.ends.size()), static_cast<vtkIdType>(2 * links.ends.size()));
      for (const auto &ends : links.ends)
        {
          if (ends[0] >= particles || ends[1] >= particles)
            throw std::invalid_argument("write_vtk_links: a link ends at particle " +
                                        std::to_string(std::max(ends[0], ends[1])) + " of " +
                                        std::to_string(particles));
          const vtkIdType points[2] = {static_cast<vtkIdType>(ends[0]), static_cast<vtkIdType>(ends[1])};
          lines->InsertNextCell(2, points);
        }
      return lines;
    }

    std::vector<std::int32_t> broken_flags(const dem::LinkOutput &links)
    {
      std::vector<std::int32_t> flags;
      flags.reserve(links.kind.size());
      for (const std::int32_t kind : links.kind)
        flags.push_back(kind == dem::LinkOutput::broken ? 1 : 0);
      return flags;
    }
  } // namespace

  void write_vtk_links(const std::filesystem::path &path,
                       const dem::LinkOutput       &links,
                       const dem::ParticleOutput   &particles,
                       const double                 time)
  {
    check_columns(links, particles);

    vtkNew<vtkPolyData> data;
    data->SetPoints(make_points(particles.position));
    data->SetLines(lines_between(links, particles.position.size()));

    vtkPointData *const at_points = data->GetPointData();
    at_points->AddArray(make_numbering("id", particles.position.size()));
    at_points->AddArray(make_array("radius", particles.radius));
    at_points->AddArray(make_array("displacement", particles.displacement));

    vtkCellData *const at_lines = data->GetCellData();
    at_lines->AddArray(make_array("normal_force", links.normal_force));
    at_lines->AddArray(make_array("shear_force", links.shear_force));
    at_lines->AddArray(make_array("normal_stress", links.normal_stress));
    at_lines->AddArray(make_array("shear_stress", links.shear_stress));
    at_lines->AddArray(make_array("normal_strain", links.normal_strain));
    at_lines->AddArray(make_array("damage", links.damage));
    at_lines->AddArray(make_array("kind", links.kind));
    at_lines->AddArray(make_array("broken", broken_flags(links)));
    if (!links.law.empty())
      at_lines->AddArray(make_array("material_pair", links.law));
    write(path, data, time);
  }
} // namespace postprocess
