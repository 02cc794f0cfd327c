#include "dem/facets/facet_mesh.h"

#include "base/errors.h"
#include "dem/facets/slivers.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dem
{
  FacetMesh FacetMesh::plane(const Eigen::Vector3d &point, const Eigen::Vector3d &normal)
  {
    FacetMesh made;
    made.vertex  = {point};
    made.facet   = {{0, 0, 0}};
    made.corners = 1;
    made.normal  = normal.normalized();
    return made;
  }

  namespace
  {
    /** Facets thinner than this part of their length are none: round-off decides where their normal points. */
    constexpr double thinnest = 1e-10;

    bool has_area(const std::array<Eigen::Vector3d, 3> &x)
    {
      const Eigen::Vector3d a = x[1] - x[0], b = x[2] - x[0];
      const double          longest = std::max({a.norm(), b.norm(), (x[2] - x[1]).norm()});
      return a.cross(b).norm() > thinnest * longest * longest;
    }

    [[noreturn]] void refuse(const std::string &name, const std::string &why)
    {
      throw base::InputError("wall " + name + ": " + why);
    }

    void check_facet(const FacetMesh &mesh, const std::string &name, const std::size_t f)
    {
      const std::string              numbered = "facet " + std::to_string(f + 1);
      std::array<Eigen::Vector3d, 3> x;
      for (int c = 0; c < mesh.corners; ++c)
        {
          const std::int32_t v = mesh.facet[f][static_cast<std::size_t>(c)];
          if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertex.size())
            refuse(name, numbered + " has vertex " + std::to_string(v + 1) + ", and there are " +
                           std::to_string(mesh.vertex.size()) + ".");
          x[static_cast<std::size_t>(c)] = mesh.vertex[static_cast<std::size_t>(v)];
        }
      if (mesh.corners == 2 && !((x[1] - x[0]).norm() > 0))
        refuse(name, numbered + " has zero length: both its ends lie at one place. Take it out.");
      if (mesh.corners != 3 || has_area(x))
        return;
      std::ostringstream message;
      message << numbered << " has zero area: its corners (" << x[0].transpose() << "), (" << x[1].transpose() << "), ("
              << x[2].transpose() << ") m lie on one line. Take it out.";
      refuse(name, message.str());
    }

    void check_in_plane(const FacetMesh &mesh, const std::string &name)
    {
      if (mesh.corners == 3)
        refuse(name, "is made of triangles; in two dimensions a wall is made of segments.");
      if (mesh.normal.z() != 0)
        refuse(name, "in two dimensions its normal must lie in the plane, z = 0.");
      for (const Eigen::Vector3d &x : mesh.vertex)
        if (x.z() != 0)
          refuse(name, "in two dimensions it must lie in the plane z = 0.");
    }
  } // namespace

  std::size_t drop_slivers(FacetMesh &mesh)
  {
    const auto first   = std::remove_if(mesh.facet.begin(), mesh.facet.end(), [&](const auto &facet) {
      std::array<Eigen::Vector3d, 3> corner;
      for (std::size_t c = 0; c < 3; ++c)
        corner[c] = mesh.vertex.at(static_cast<std::size_t>(facet[c]));
      return !has_area(corner);
    });
    const auto dropped = static_cast<std::size_t>(mesh.facet.end() - first);
    mesh.facet.erase(first, mesh.facet.end());
    return dropped;
  }

  void check_facets(const FacetMesh &mesh, const std::string &name, const int dimension)
  {
    if (mesh.facet.empty())
      refuse(name, "has no facet.");
    for (std::size_t v = 0; v < mesh.vertex.size(); ++v)
      if (!mesh.vertex[v].allFinite())
        refuse(name, "vertex " + std::to_string(v + 1) + " is not at a finite place.");
    if (mesh.is_plane() && !(std::abs(mesh.normal.norm() - 1) < 1e-9))
      refuse(name, "the normal of a plane must have a direction.");
    if (dimension == 2)
      check_in_plane(mesh, name);
    else if (mesh.corners == 2)
      refuse(name, "is made of segments; in three dimensions a wall is made of triangles.");
    if (!mesh.outward.empty() && mesh.outward.size() != mesh.size())
      refuse(name, "has " + std::to_string(mesh.size()) + " facets, and says of " +
                     std::to_string(mesh.outward.size()) + " which way is out.");
    for (std::size_t f = 0; f < mesh.size(); ++f)
      check_facet(mesh, name, f);
  }

  Eigen::Vector3d facet_normal(const std::array<Eigen::Vector3d, 3> &corner, const bool segment)
  {
    const Eigen::Vector3d edge = corner[1] - corner[0];
    return segment ? Eigen::Vector3d(-edge.y(), edge.x(), 0).normalized() :
                     edge.cross(corner[2] - corner[0]).normalized();
  }

  FacetPoint closest_on_segment(const std::array<Eigen::Vector3d, 3> &corner, const Eigen::Vector3d &x)
  {
    const Eigen::Vector3d along = corner[1] - corner[0];
    const double          t     = std::min(std::max(along.dot(x - corner[0]) / along.squaredNorm(), 0.0), 1.0);
    return {corner[0] + t * along, {1 - t, t, 0}};
  }

  FacetPoint closest_on_triangle(const std::array<Eigen::Vector3d, 3> &corner, const Eigen::Vector3d &x)
  {
    const Eigen::Vector3d &a = corner[0], &b = corner[1], &c = corner[2];
    const Eigen::Vector3d  ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const double           d1 = ab.dot(ax), d2 = ac.dot(ax);
    if (d1 <= 0 && d2 <= 0)
      return {a, {1, 0, 0}};
    const double d3 = ab.dot(bx), d4 = ac.dot(bx);
    if (d3 >= 0 && d4 <= d3)
      return {b, {0, 1, 0}};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
      {
        const double t = d1 / (d1 - d3);
        return {a + t * ab, {1 - t, t, 0}};
      }
    const double d5 = ab.dot(cx), d6 = ac.dot(cx);
    if (d6 >= 0 && d5 <= d6)
      return {c, {0, 0, 1}};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
      {
        const double t = d2 / (d2 - d6);
        return {a + t * ac, {1 - t, 0, t}};
      }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
      {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {b + t * (c - b), {0, 1 - t, t}};
      }
    const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
    return {a + v * ab + w * ac, {1 - v - w, v, w}};
  }

  FacetPoint closest_on_facet(const FacetMesh                    &mesh,
                              const std::vector<Eigen::Vector3d> &vertex,
                              const std::size_t                   facet,
                              const Eigen::Vector3d              &x)
  {
    if (mesh.is_plane())
      return {x - mesh.normal.dot(x - vertex[0]) * mesh.normal, {1, 0, 0}};
    std::array<Eigen::Vector3d, 3> corner;
    for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
      corner[c] = vertex[static_cast<std::size_t>(mesh.facet[facet][c])];
    return mesh.corners == 2 ? closest_on_segment(corner, x) : closest_on_triangle(corner, x);
  }
} // namespace dem
