#include "dem/facets/vertex_weights.h"

namespace dem
{
  using Eigen::Vector3d;

  void add(std::vector<VertexWeight> &weights, const std::int32_t vertex, const double weight)
  {
    for (VertexWeight &known : weights)
      if (known.vertex == vertex)
        {
          known.weight += weight;
          return;
        }
    weights.push_back({vertex, weight});
  }

  Vector3d mean(const std::vector<VertexWeight> &weights, const std::vector<Vector3d> &place)
  {
    Vector3d sum = Vector3d::Zero();
    for (const VertexWeight &each : weights)
      sum += each.weight * place[static_cast<std::size_t>(each.vertex)];
    return sum;
  }
} // namespace dem
