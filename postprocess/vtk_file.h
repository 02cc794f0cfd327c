#pragma once

#include <Eigen/Core>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/** Columns as VTK arrays, and a VTK file written atomically: what vtk_particles and vtk_links share. */
namespace postprocess::vtk_file
{
  using Array = vtkSmartPointer<vtkDataArray>;

  Array make_array(const std::string &name, const std::vector<double> &values);
  Array make_array(const std::string &name, const std::vector<std::int32_t> &values);
  Array make_array(const std::string &name, const std::vector<Eigen::Vector3d> &values);
  /** Symmetric tensor in VTK's order XX YY ZZ XY YZ XZ. */
  Array make_array(const std::string &name, const std::vector<Eigen::Matrix3d> &values);
  /** first, first + 1, ... */
  Array make_numbering(const std::string &name, std::size_t count);

  vtkSmartPointer<vtkPoints> make_points(const std::vector<Eigen::Vector3d> &position);

  /** One vertex cell per point: what ParaView shows and picks, and its threshold filter works on. */
  vtkSmartPointer<vtkCellArray> one_vertex_each(std::size_t count);

  /** Refuse columns of unequal length. @throws std::invalid_argument naming the caller and the column. */
  void check_length(const char *caller, const char *column, std::size_t length, std::size_t expected);

  /** Write as .vtp (binary, compressed by LZ4) with its time [s]. @throws OutputError. */
  void write(const std::filesystem::path &path, vtkPolyData *data, double time);
} // namespace postprocess::vtk_file
