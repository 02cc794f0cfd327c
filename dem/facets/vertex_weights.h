#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dem
{
  /** Part of a vertex in the place of a contact. */
  struct VertexWeight
  {
    std::int32_t vertex;
    double       weight;
  };

  void add(std::vector<VertexWeight> &weights, std::int32_t vertex, double weight);
  /** Sum of weight and vertex [m]. */
  Eigen::Vector3d mean(const std::vector<VertexWeight> &weights, const std::vector<Eigen::Vector3d> &place);
} // namespace dem
