#pragma once

#include "postprocess/vtk/fields.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace postprocess
{
  /** Values carried by points in space, whatever they are: integration points, particles with tensors. */
  struct PointCloud
  {
    template <typename Value>
    using Columns = std::vector<std::pair<std::string, std::vector<Value>>>;

    std::vector<Eigen::Vector3d> place; ///< [m]
    Columns<double>              scalars;
    Columns<Eigen::Vector3d>     vectors;
    Columns<Eigen::Matrix3d>     tensors; ///< symmetric
  };

  /**
   * Write as points of a VTK file (.vtp) for ParaView.
   * @param what kind of file, which declares the columns
   * @throws OutputError; std::invalid_argument for columns that differ in length
   */
  void
  write_vtk_points(const std::filesystem::path &path, const FieldFile &what, const PointCloud &points, double time);
} // namespace postprocess
