#include "postprocess/vtk/vtk_solid.h"

#include "postprocess/files/atomic_file.h"
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

    std::string record_of(const std::vector<fem::SolidSnapshot::Field> &fields, const char *const what)
    {
      std::string text = std::string("    <") + what + ">\n";
      for (const fem::SolidSnapshot::Field &field : fields)
        text += "      <PDataArray type=\"Float32\" Name=\"" + field.name + "\" NumberOfComponents=\"" +
                std::to_string(field.components) + "\"/>\n";
      return text + "    </" + what + ">\n";
    }
  } // namespace

  void write_vtk_solid(const std::filesystem::path &path, const fem::SolidSnapshot &solid, const double time)
  {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints>           points;
    points->SetData(make_array("place", solid.place, 3));
    grid->SetPoints(points);
    grid->SetCells(solid.element_type, cells_of(solid));
    for (const auto &field : solid.at_nodes)
      add(*grid, *grid->GetPointData(), field, solid.nodes());
    for (const auto &field : solid.of_elements)
      add(*grid, *grid->GetCellData(), field, solid.size());
    write(path, grid, time);
  }

  void write_vtk_solid_record(const std::filesystem::path    &path,
                              const fem::SolidSnapshot       &like,
                              const std::vector<std::string> &pieces)
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
                       "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PUnstructuredGrid GhostLevel=\"0\">\n" +
                       record_of(like.at_nodes, "PPointData") + record_of(like.of_elements, "PCellData") +
                       "    <PPoints>\n      <PDataArray type=\"Float32\" Name=\"place\" NumberOfComponents=\"3\"/>\n"
                       "    </PPoints>\n";
    for (const std::string &piece : pieces)
      text += "    <Piece Source=\"" + piece + "\"/>\n";
    write_text(path, text + "  </PUnstructuredGrid>\n</VTKFile>\n");
  }
} // namespace postprocess
