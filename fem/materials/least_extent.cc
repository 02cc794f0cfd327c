#include "fem/materials/least_extent.h"

#include <algorithm>
#include <vector>

namespace fem
{
  double least_extent(const ElementExtent &element)
  {
    if (element.n_vertices == 0)
      return element.mean_size;
    // The least width of a convex body lies across a face or across two edges: among the normals of two lines through vertices.
    std::vector<Eigen::Vector3d> lines;
    for (unsigned int v = 1; v < element.n_vertices; ++v)
      for (unsigned int w = 0; w < v; ++w)
        lines.push_back((element.vertices[v] - element.vertices[w]).normalized());
    const bool plane = std::all_of(lines.begin(), lines.end(), [](const auto &line) { return line.z() == 0; });
    double     least = element.along(Eigen::Vector3d::UnitX());
    const auto take  = [&](const Eigen::Vector3d &normal) {
      if (normal.norm() > 1e-6) // the lines are not parallel
        least = std::min(least, element.along(normal.normalized()));
    };
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (plane)
        take(lines[i].cross(Eigen::Vector3d::UnitZ()));
      else
        for (std::size_t j = 0; j < i; ++j)
          take(lines[i].cross(lines[j]));
    return least;
  }
}
