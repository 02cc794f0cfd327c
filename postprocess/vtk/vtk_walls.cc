#include "postprocess/vtk/vtk_walls.h"

#include "dem/facets/surface.h"
#include "dem/specimen/observation.h"
#include "postprocess/vtk/vtk_file.h"

#include <vtkCellArray.h>
#include <vtkNew.h>

namespace postprocess
{
  using namespace vtk_file;

  void write_vtk_walls(const std::filesystem::path &path, const dem::ObservedSpecimen &specimen, const double time)
  {
    std::vector<Eigen::Vector3d>  place, force;
    std::vector<std::int32_t>     wall;
    vtkSmartPointer<vtkCellArray> facets = vtkSmartPointer<vtkCellArray>::New();
    bool                          lines  = false;
    for (std::size_t s = 0; s < specimen.surfaces().size(); ++s)
      {
        const dem::Surface &surface = specimen.surfaces().at(s);
        if (surface.mesh.is_plane())
          continue;
        const auto shift = static_cast<vtkIdType>(place.size());
        place.insert(place.end(), surface.place.begin(), surface.place.end());
        force.insert(force.end(), surface.force.begin(), surface.force.end());
        lines = surface.mesh.corners == 2;
        for (const auto &facet : surface.mesh.facet)
          {
            const vtkIdType corners[3] = {shift + facet[0], shift + facet[1], shift + facet[2]};
            facets->InsertNextCell(surface.mesh.corners, corners);
            wall.push_back(static_cast<std::int32_t>(s));
          }
      }
    vtkNew<vtkPolyData> data;
    data->SetPoints(make_points(place));
    if (lines)
      data->SetLines(facets);
    else
      data->SetPolys(facets);
    const FieldWriter writer(field_file("walls"), data);
    writer.add("force", force);
    writer.add("wall", wall);
    write(path, data, time);
  }
} // namespace postprocess
