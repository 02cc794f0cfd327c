#include "coupling/surface/interior.h"

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    /** No edge of a regular mesh runs along it. */
    const Vector3d ray_in_space = Vector3d(0.5417, 0.3391, 0.7691), ray_in_the_plane = Vector3d(0.8467, 0.5321, 0);

    /** Whether the ray from x meets the triangle; T. Moller, B. Trumbore, J. Graphics Tools 2 (1997) 21-28. */
    bool meets(const Vector3d &x, const Vector3d &a, const Vector3d &b, const Vector3d &c)
    {
      const Vector3d ab = b - a, ac = c - a, across = ray_in_space.cross(ac), from = x - a, turned = from.cross(ab);
      const double   det = ab.dot(across);
      if (det == 0)
        return false;
      const double u = from.dot(across) / det, v = ray_in_space.dot(turned) / det;
      return u >= 0 && v >= 0 && u + v < 1 && ac.dot(turned) / det > 0;
    }

    /** The same of a segment. */
    bool meets(const Vector3d &x, const Vector3d &a, const Vector3d &b)
    {
      const Vector3d along = b - a, from = a - x;
      const double   det = ray_in_the_plane.cross(along).z();
      if (det == 0)
        return false;
      const double at = from.cross(along).z() / det, part = from.cross(ray_in_the_plane).z() / det;
      return at > 0 && part >= 0 && part < 1;
    }
  } // namespace

  Interior::Interior(dem::FacetMesh mesh)
    : facets(std::move(mesh))
  {
    for (const Vector3d &x : facets.vertex)
      around.extend(x);
  }

  bool Interior::holds(const Vector3d &x) const
  {
    if (!around.contains(x))
      return false;
    bool inside = false;
    for (const auto &facet : facets.facet)
      {
        const auto corner = [&](const std::size_t c) -> const Vector3d & {
          return facets.vertex[static_cast<std::size_t>(facet[c])];
        };
        if (facets.corners == 3 ? meets(x, corner(0), corner(1), corner(2)) : meets(x, corner(0), corner(1)))
          inside = !inside;
      }
    return inside;
  }
} // namespace coupling
