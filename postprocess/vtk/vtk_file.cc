#include "postprocess/vtk/vtk_file.h"

#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace postprocess::vtk_file
{
  namespace
  {
    template <typename VtkArray>
    vtkSmartPointer<VtkArray> make_empty(const std::string &name, const int components, const std::size_t tuples)
    {
      auto array = vtkSmartPointer<VtkArray>::New();
      array->SetName(name.c_str());
      array->SetNumberOfComponents(components);
      array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
      return array;
    }
  } // namespace

  Array make_array(const std::string &name, const std::vector<double> &values)
  {
    auto array = make_empty<vtkDoubleArray>(name, 1, values.size());
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
  }

  Array make_view(const std::string &name, const std::vector<double> &values)
  {
    constexpr int not_its_own = 1;
    auto          array       = make_empty<vtkDoubleArray>(name, 1, 0);
    // A writer only reads them, but VTK knows no array of constants.
    array->SetArray(const_cast<double *>(values.data()), static_cast<vtkIdType>(values.size()), not_its_own);
    return array;
  }

  Array make_array(const std::string &name, const std::vector<std::int32_t> &values)
  {
    auto array = make_empty<vtkIntArray>(name, 1, values.size());
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
  }

  Array make_array(const std::string &name, const std::vector<Eigen::Vector3d> &values)
  {
    auto array = make_empty<vtkDoubleArray>(name, 3, values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      array->SetTypedTuple(static_cast<vtkIdType>(i), values[i].data());
    return array;
  }

  Array make_array(const std::string &name, const std::vector<Eigen::Matrix3d> &values)
  {
    auto array = make_empty<vtkDoubleArray>(name, 6, values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        const Eigen::Matrix3d &t        = values[i];
        const double           tuple[6] = {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2)};
        array->SetTypedTuple(static_cast<vtkIdType>(i), tuple);
      }
    name_components(*array);
    return array;
  }

  Array make_array(const std::string &name, const std::vector<float> &values, const int components)
  {
    auto array = make_empty<vtkFloatArray>(name, components, values.size() / static_cast<std::size_t>(components));
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    name_components(*array);
    return array;
  }

  void name_components(vtkDataArray &array)
  {
    static constexpr const char *names[6] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    if (array.GetNumberOfComponents() == 6)
      for (int component = 0; component < 6; ++component)
        array.SetComponentName(component, names[component]);
  }

  void FieldWriter::add(const Array &array) const
  {
    const Field &field = file.field(array->GetName());
    if (array->GetNumberOfComponents() != field.components)
      throw std::logic_error("field \"" + field.name + "\" of " + file.name + " has " +
                             std::to_string(array->GetNumberOfComponents()) + " components, not as declared");
    if (!field.unit.empty() && field.unit != "-")
      array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.unit.c_str());
    vtkDataSetAttributes *const values = field.of == Field::Of::points ?
                                           static_cast<vtkDataSetAttributes *>(data->GetPointData()) :
                                           static_cast<vtkDataSetAttributes *>(data->GetCellData());
    if (field.components == 6 && values->GetTensors() == nullptr)
      values->SetTensors(array); // the first tensor is the one that filters take by themselves
    else
      values->AddArray(array);
  }

  void FieldWriter::add_own(const Array &array, const std::string &unit) const
  {
    if (!unit.empty() && unit != "-")
      array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
    data->GetCellData()->AddArray(array);
  }

  Array make_numbers(const std::string &name, const std::vector<std::int64_t> &values)
  {
    auto array = make_empty<vtkIdTypeArray>(name, 1, values.size());
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
  }

  std::vector<std::int64_t> numbers_from(const std::int64_t first, const std::size_t count)
  {
    std::vector<std::int64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
  }

  std::vector<std::int64_t> ids_of(std::vector<std::int64_t> numbers)
  {
    for (std::int64_t &number : numbers)
      ++number;
    return numbers;
  }

  vtkSmartPointer<vtkPoints> make_points(const std::vector<Eigen::Vector3d> &position)
  {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetData(make_array("position", position));
    return points;
  }

  vtkSmartPointer<vtkCellArray> one_vertex_each(const std::size_t count)
  {
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->AllocateExact(static_cast<vtkIdType>(count), static_cast<vtkIdType>(count));
    for (vtkIdType i = 0; i < static_cast<vtkIdType>(count); ++i)
      cells->InsertNextCell(1, &i);
    return cells;
  }

  void
  check_length(const char *const caller, const char *const column, const std::size_t length, const std::size_t expected)
  {
    if (length != expected)
      throw std::invalid_argument(std::string(caller) + ": " + column + " has " + std::to_string(length) +
                                  " entries, not " + std::to_string(expected));
  }

  namespace
  {
    void write_by(vtkXMLWriter &writer, const std::filesystem::path &path, vtkDataSet *const data, const double time)
    {
      data->GetFieldData()->AddArray(make_array("TimeValue", std::vector<double>{time}));

      AtomicFile                 target(path);
      vtkNew<vtkCallbackCommand> quiet; // errors come back as a code, and are then ours to report
      quiet->SetCallback([](vtkObject *, unsigned long, void *, void *) {});
      writer.AddObserver("ErrorEvent", quiet);
      writer.GetExecutive()->AddObserver("ErrorEvent", quiet);
      writer.SetFileName(target.partial().c_str());
      writer.SetInputDataObject(data);
      writer.SetDataModeToAppended();
      writer.EncodeAppendedDataOff();
      writer.SetCompressorTypeToZLib(); // what readers other than VTK's know, too
      writer.SetCompressionLevel(1);    // fast: higher ones hardly shrink random digits
      writer.SetHeaderTypeToUInt64();
      if (writer.Write() == 0 || writer.GetErrorCode() != vtkErrorCode::NoError)
        throw OutputError(path.string() +
                          ": cannot be written: " + vtkErrorCode::GetStringFromErrorCode(writer.GetErrorCode()) + ".");
      target.commit();
    }
  } // namespace

  void write(const std::filesystem::path &path, vtkPolyData *const data, const double time)
  {
    write_by(*vtkNew<vtkXMLPolyDataWriter>(), path, data, time);
  }

  void write(const std::filesystem::path &path, vtkUnstructuredGrid *const data, const double time)
  {
    write_by(*vtkNew<vtkXMLUnstructuredGridWriter>(), path, data, time);
  }

  namespace
  {
    /** A type of numbers by its name in files. */
    const char *type_in_files(vtkDataArray &array)
    {
      switch (array.GetDataType())
        {
        case VTK_DOUBLE:
          return "Float64";
        case VTK_FLOAT:
          return "Float32";
        case VTK_INT:
          return "Int32";
        case VTK_ID_TYPE:
          return "Int64\" IdType=\"1";
        default:
          throw std::logic_error(std::string("record: no name for the type of ") + array.GetDataTypeAsString());
        }
    }

    /** As a record has it: what each piece's array of this name is. */
    std::string record_of(vtkDataArray &array)
    {
      std::string text = "      <PDataArray type=\"" + std::string(type_in_files(array)) + "\" Name=\"" +
                         array.GetName() + "\" NumberOfComponents=\"" + std::to_string(array.GetNumberOfComponents()) +
                         "\"";
      for (int c = 0; c < array.GetNumberOfComponents(); ++c)
        if (const char *name = array.GetComponentName(c))
          text += " ComponentName" + std::to_string(c) + "=\"" + name + "\"";
      if (!array.HasInformation() || !array.GetInformation()->Has(vtkDataArray::UNITS_LABEL()))
        return text + "/>\n";
      return text + ">\n        <InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" +
             array.GetInformation()->Get(vtkDataArray::UNITS_LABEL()) + "</InformationKey>\n      </PDataArray>\n";
    }

    std::string record_of(vtkDataSetAttributes &values, const std::string &what)
    {
      std::string text = "    <" + what;
      if (vtkDataArray *const tensors = values.GetTensors())
        text += std::string(" Tensors=\"") + tensors->GetName() + "\"";
      text += ">\n";
      for (int a = 0; a < values.GetNumberOfArrays(); ++a)
        text += record_of(*values.GetArray(a));
      return text + "    </" + what + ">\n";
    }

    void write_record_of(const std::filesystem::path    &path,
                         vtkPointSet                    &like,
                         const std::string              &kind,
                         const std::vector<std::string> &pieces)
    {
      std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind +
                         "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <" + kind +
                         " GhostLevel=\"0\">\n" + record_of(*like.GetPointData(), "PPointData") +
                         record_of(*like.GetCellData(), "PCellData") + "    <PPoints>\n" +
                         record_of(*like.GetPoints()->GetData()) + "    </PPoints>\n";
      for (const std::string &piece : pieces)
        text += "    <Piece Source=\"" + piece + "\"/>\n";
      write_text(path, text + "  </" + kind + ">\n</VTKFile>\n");
    }
  } // namespace

  void write_record(const std::filesystem::path &path, vtkPolyData *const like, const std::vector<std::string> &pieces)
  {
    write_record_of(path, *like, "PPolyData", pieces);
  }

  void write_record(const std::filesystem::path    &path,
                    vtkUnstructuredGrid *const      like,
                    const std::vector<std::string> &pieces)
  {
    write_record_of(path, *like, "PUnstructuredGrid", pieces);
  }
} // namespace postprocess::vtk_file
