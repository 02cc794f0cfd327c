#pragma once

#include "postprocess/vtk/fields.h"

#include <Eigen/Core>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/** Columns as VTK arrays, and a VTK file written atomically: what the writers share. */
namespace postprocess::vtk_file
{
  using Array = vtkSmartPointer<vtkDataArray>;

  Array make_array(const std::string &name, const std::vector<double> &values);
  Array make_array(const std::string &name, const std::vector<std::int32_t> &values);
  Array make_array(const std::string &name, const std::vector<Eigen::Vector3d> &values);
  /** Symmetric tensor in VTK's order XX YY ZZ XY YZ XZ. */
  Array make_array(const std::string &name, const std::vector<Eigen::Matrix3d> &values);
  /** The same numbers, not copied: they must outlive what is written of them. */
  Array make_view(const std::string &name, const std::vector<double> &values);
  /** Rows of 1, 3 (vector) or 6 numbers (symmetric tensor, in VTK's order). */
  Array make_array(const std::string &name, const std::vector<float> &values, int components);
  Array make_numbers(const std::string &name, const std::vector<std::int64_t> &values);
  /** first, first + 1, ... */
  std::vector<std::int64_t> numbers_from(std::int64_t first, std::size_t count);

  /** Numbers of particles in a packing, from 0, as files have them: from 1. */
  std::vector<std::int64_t> ids_of(std::vector<std::int64_t> numbers);

  /** Names the components of a tensor as ParaView shows them. */
  void name_components(vtkDataArray &array);

  /** Adds arrays to a data set as its kind of file declares them: point or cell data, with the unit. */
  class FieldWriter
  {
  public:
    FieldWriter(const FieldFile &what, vtkDataSet *where)
      : file(what)
      , data(where)
    {
    }

    /** @throws std::logic_error if the field is not declared, or with other components */
    void add(const Array &array) const;

    template <typename Values>
    void add(const std::string &name, const Values &values) const
    {
      add(make_array(name, values));
    }

    /** Cell data that a link law or a material of its own declares, in its names. */
    void add_own(const Array &array, const std::string &unit) const;

  private:
    const FieldFile &file;
    vtkDataSet      *data;
  };

  vtkSmartPointer<vtkPoints> make_points(const std::vector<Eigen::Vector3d> &position);

  /** One vertex cell per point: what ParaView shows and picks, and its threshold filter works on. */
  vtkSmartPointer<vtkCellArray> one_vertex_each(std::size_t count);

  /** Refuse columns of unequal length. @throws std::invalid_argument naming the caller and the column. */
  void check_length(const char *caller, const char *column, std::size_t length, std::size_t expected);

  /** Write as .vtp or .vtu (binary, compressed by zlib) with its time [s]. @throws OutputError. */
  void write(const std::filesystem::path &path, vtkPolyData *data, double time);
  void write(const std::filesystem::path &path, vtkUnstructuredGrid *data, double time);

  /**
   * Write the record (.pvtp or .pvtu) of a data set whose pieces stand in several files, atomically.
   * @param like one of the pieces, for the names of the fields  @param pieces their files, relative to the record  @throws OutputError
   */
  void write_record(const std::filesystem::path &path, vtkPolyData *like, const std::vector<std::string> &pieces);
  void
  write_record(const std::filesystem::path &path, vtkUnstructuredGrid *like, const std::vector<std::string> &pieces);
} // namespace postprocess::vtk_file
