#pragma once

#include "coupling/contact/bodies/body_mesh.h"

#include <Eigen/Geometry>

namespace coupling::bodies
{
  /** Two simplices that may overlap, by their numbers in the mesh. */
  struct NearSimplices
  {
    std::int32_t first, second;

    bool operator<(const NearSimplices &o) const { return first != o.first ? first < o.first : second < o.second; }
  };

  /**
   * Which simplices of different bodies are near each other. The list holds all pairs whose boxes meet, each grown by a part of its own
   * size, and is good while every vertex is within what the boxes around it have grown by. Boxes are sorted into a grid: linear in the
   * number of simplices.
   */
  class NearBodies
  {
  public:
    /** @param same_body pairs of one body as well, unless their elements share a vertex */
    explicit NearBodies(const bool same_body)
      : same(same_body)
    {
    }

    /** Pairs that may overlap where all vertices are now: first of the lower body, ascending. */
    const std::vector<NearSimplices> &update(const BodyMesh &mesh);
    /** Whether the boxes around a pair of the list meet where their vertices were at its update. */
    bool meet(const NearSimplices &pair) const
    {
      return boxes[static_cast<std::size_t>(pair.first)].intersects(boxes[static_cast<std::size_t>(pair.second)]);
    }
    /** Places have changed otherwise than by steps. */
    void         forget() { reference.clear(); }
    std::int64_t searches() const { return search_count; }

  private:
    using Box = Eigen::AlignedBox3d;

    bool good(const BodyMesh &mesh) const;
    void search(const BodyMesh &mesh);
    void list_simplices();

    bool                         same;
    std::vector<Eigen::Vector3d> reference; ///< places when the list was made
    std::vector<double>          reach;     ///< of each vertex, from there [m]
    std::vector<NearSimplices>   pairs;
    std::vector<std::int32_t>    listed; ///< simplices of the pairs, ascending
    std::vector<Box>             boxes;  ///< around all simplices; those of the listed are up to date
    std::int64_t                 search_count = 0;
  };
} // namespace coupling::bodies
