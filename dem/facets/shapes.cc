#include "dem/facets/shapes.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dem
{
  namespace
  {
    std::int32_t add_vertex(FacetMesh &mesh, const Eigen::Vector3d &x)
    {
      mesh.vertex.push_back(x);
      return static_cast<std::int32_t>(mesh.vertex.size()) - 1;
    }

    /** Two triangles between four vertices in a ring. */
    void add_quadrilateral(FacetMesh &mesh, const std::array<std::int32_t, 4> &ring)
    {
      mesh.facet.push_back({ring[0], ring[1], ring[2]});
      mesh.facet.push_back({ring[0], ring[2], ring[3]});
    }

    Eigen::Vector3d
    on_circle(const Eigen::Vector3d &first, const Eigen::Vector3d &second, const int k, const int around)
    {
      const double angle = 2 * M_PI * k / around;
      return std::cos(angle) * first + std::sin(angle) * second;
    }
  } // namespace

  FacetMesh plate(const Eigen::Vector3d &corner, const Eigen::Vector3d &a, const Eigen::Vector3d &b)
  {
    FacetMesh mesh;
    mesh.vertex = {corner, corner + a, corner + a + b, corner + b};
    add_quadrilateral(mesh, {0, 1, 2, 3});
    return mesh;
  }

  FacetMesh segment(const Eigen::Vector3d &from, const Eigen::Vector3d &to)
  {
    FacetMesh mesh;
    mesh.corners = 2;
    mesh.vertex  = {from, to};
    mesh.facet   = {{0, 1, 0}};
    return mesh;
  }

  FacetMesh box(const Eigen::Vector3d &low, const Eigen::Vector3d &high, const BoxSides &there)
  {
    FacetMesh mesh;
    for (int corner = 0; corner < 8; ++corner)
      add_vertex(mesh,
                 {corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(), corner & 4 ? high.z() : low.z()});
    constexpr std::array<std::int32_t, 4> side[6] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (std::size_t s = 0; s < 6; ++s)
      if (there[s])
        add_quadrilateral(mesh, side[s]);
    return mesh;
  }

  FacetMesh rectangle(const Eigen::Vector3d &low, const Eigen::Vector3d &high, const BoxSides &there)
  {
    FacetMesh mesh;
    mesh.corners = 2;
    mesh.vertex  = {{low.x(), low.y(), 0}, {high.x(), low.y(), 0}, {high.x(), high.y(), 0}, {low.x(), high.y(), 0}};
    const std::array<std::int32_t, 3> all[4] = {{3, 0, 0}, {1, 2, 0}, {0, 1, 0}, {2, 3, 0}};
    for (std::size_t s = 0; s < 4; ++s)
      if (there[s])
        mesh.facet.push_back(all[s]);
    return mesh;
  }

  FacetMesh cylinder(
    const Eigen::Vector3d &from, const Eigen::Vector3d &to, const double radius, const int around, const bool ends)
  {
    const Eigen::Vector3d axis = (to - from).normalized(), first = radius * axis.unitOrthogonal(),
                          second = axis.cross(first);
    FacetMesh mesh;
    for (int k = 0; k < around; ++k)
      {
        add_vertex(mesh, from + on_circle(first, second, k, around));
        add_vertex(mesh, to + on_circle(first, second, k, around));
      }
    for (int k = 0; k < around; ++k)
      {
        const int next = (k + 1) % around;
        add_quadrilateral(mesh, {2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
      }
    if (!ends)
      return mesh;
    const std::int32_t low = add_vertex(mesh, from), high = add_vertex(mesh, to);
    for (int k = 0; k < around; ++k)
      {
        const int next = (k + 1) % around;
        mesh.facet.push_back({low, 2 * next, 2 * k});
        mesh.facet.push_back({high, 2 * k + 1, 2 * next + 1});
      }
    return mesh;
  }

  FacetMesh circle(const Eigen::Vector3d &centre, const double radius, const int around)
  {
    FacetMesh mesh;
    mesh.corners = 2;
    for (int k = 0; k < around; ++k)
      {
        add_vertex(mesh,
                   centre + on_circle(radius * Eigen::Vector3d::UnitX(), radius * Eigen::Vector3d::UnitY(), k, around));
        mesh.facet.push_back({k, (k + 1) % around, 0});
      }
    return mesh;
  }
} // namespace dem
