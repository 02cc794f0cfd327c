#include "postprocess/vtk/vtk_solid.h"

#include "postprocess/vtk/vtk_file.h"

#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>

namespace postprocess
{
  using namespace vtk_file;

  namespace
  {
    vtkSmartPointer<vtkCellArray> cells_of(const fem::SolidSnapshot &solid)
    {
      const auto nodes = static_cast<vtkIdType>(solid.element_nodes);
      auto       made  = vtkSmartPointer<vtkCellArray>::New();
      made->AllocateExact(static_cast<vtkIdType>(solid.size()), static_cast<vtkIdType>(solid.elements.size()));
      std::vector<vtkIdType> element(solid.elements.begin(), solid.elements.end());
      for (std::size_t e = 0; e < solid.size(); ++e)
        made->InsertNextCell(nodes, &element[e * static_cast<std::size_t>(nodes)]);
      return made;
    }

    bool is_declared(const FieldFile &file, const std::string &name)
    {
      return std::any_of(file.fields.begin(), file.fields.end(), [&](const Field &f) { return f.name == name; });
    }

    void add(vtkUnstructuredGrid             &grid,
             vtkDataSetAttributes            &values,
             const fem::SolidSnapshot::Field &field,
             const std::size_t                rows)
    {
      check_length("write_vtk_solid", field.name.c_str(), field.values.size(),
                   rows * static_cast<std::size_t>(field.components));
      const Array      array = make_array(field.name, field.values, field.components);
      const FieldFile &file  = field_file("solid");
      if (is_declared(file, field.name))
        {
          FieldWriter(file, &grid).add(array);
          return;
        }
      if (!field.unit.empty() && field.unit != "-")
        array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.unit.c_str());
      values.AddArray(array);
    }

    vtkSmartPointer<vtkUnstructuredGrid> grid_of(const fem::SolidSnapshot &solid)
    {
      auto              grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
      vtkNew<vtkPoints> points;
      points->SetData(make_array("place", solid.place, 3));
      grid->SetPoints(points);
      grid->SetCells(solid.element_type, cells_of(solid));
      for (const auto &field : solid.at_nodes)
        add(*grid, *grid->GetPointData(), field, solid.nodes());
      for (const auto &field : solid.of_elements)
        add(*grid, *grid->GetCellData(), field, solid.size());
      return grid;
    }
  } // namespace

  void write_vtk_solid(const std::filesystem::path &path, const fem::SolidSnapshot &solid, const double time)
  {
    write(path, grid_of(solid).Get(), time);
  }

  void write_vtk_solid_record(const std::filesystem::path    &path,
                              const fem::SolidSnapshot       &like,
                              const std::vector<std::string> &pieces)
  {
    write_record(path, grid_of(like).Get(), pieces);
  }
} // namespace postprocess
