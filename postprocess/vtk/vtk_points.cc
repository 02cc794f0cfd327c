#include "postprocess/vtk/vtk_points.h"

#include "postprocess/vtk/vtk_file.h"

#include <vtkNew.h>

namespace postprocess
{
  using namespace vtk_file;

  void write_vtk_points(const std::filesystem::path &path,
                        const FieldFile             &what,
                        const PointCloud            &points,
                        const double                 time)
  {
    const std::size_t   n = points.place.size();
    vtkNew<vtkPolyData> data;
    data->SetPoints(make_points(points.place));
    data->SetVerts(one_vertex_each(n));
    const FieldWriter writer(what, data);
    const auto        add = [&](const auto &columns) {
      for (const auto &[name, values] : columns)
        {
          check_length("write_vtk_points", name.c_str(), values.size(), n);
          writer.add(name, values);
        }
    };
    add(points.scalars);
    add(points.vectors);
    add(points.tensors);
    write(path, data, time);
  }
} // namespace postprocess
