#include "dem/facets/flat_faces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    std::size_t index(const std::int32_t number) { return static_cast<std::size_t>(number); }

    std::vector<Vector3d> normals(const FacetMesh &mesh)
    {
      std::vector<Vector3d> found(mesh.size());
      for (std::size_t f = 0; f < mesh.size(); ++f)
        {
          std::array<Vector3d, 3> corner;
          for (std::size_t c = 0; c < 3; ++c)
            corner[c] =
              mesh.vertex[index(mesh.facet[f][std::min<std::size_t>(c, static_cast<std::size_t>(mesh.corners) - 1)])];
          found[f] = facet_normal(corner, mesh.corners == 2);
        }
      return found;
    }

    /** Corners of the side across from a corner; of a segment twice the other end. */
    std::pair<std::int32_t, std::int32_t> side(const FacetMesh &mesh, const std::size_t facet, const std::size_t across)
    {
      const auto n = static_cast<std::size_t>(mesh.corners);
      return std::minmax({mesh.facet[facet][(across + 1) % n], mesh.facet[facet][(across + n - 1) % n]});
    }
  } // namespace

  FlatFaces::FlatFaces(const FacetMesh &mesh, const FacetsAround &around)
    : face(mesh.size(), -1)
    , rim(mesh.size(), {false, false, false})
    , tip(rim)
    , seen(mesh.size())
  {
    join(mesh, around);
    find_rims(mesh);
    see(mesh);
  }

  void FlatFaces::join(const FacetMesh &mesh, const FacetsAround &around)
  {
    constexpr double            rounding_of_meshes = 1e-6;
    const std::vector<Vector3d> normal             = normals(mesh);
    std::vector<char>           alone; // of each face
    std::vector<std::int32_t>   open;
    for (std::size_t f = 0; f < mesh.size(); ++f)
      {
        if (face[f] >= 0)
          continue;
        face[f] = static_cast<std::int32_t>(alone.size());
        alone.push_back(1);
        plane.emplace_back(mesh.vertex[index(mesh.facet[f][0])], normal[f], mesh.corners == 2);
        open.assign(1, static_cast<std::int32_t>(f));
        while (!open.empty())
          {
            const std::int32_t one = open.back();
            open.pop_back();
            around.each(mesh, one, [&](const std::int32_t other) {
              if (normal[index(one)].cross(normal[index(other)]).norm() > rounding_of_meshes || face[index(other)] >= 0)
                return;
              face[index(other)] = face[f];
              open.push_back(other);
            });
          }
      }
    for (std::size_t f = 0; f < mesh.size(); ++f)
      around.each(mesh, static_cast<std::int32_t>(f), [&](const std::int32_t other) {
        if (face[index(other)] != face[f] && std::fabs(normal[f].dot(normal[index(other)])) > cells::leaning)
          alone[index(face[f])] = 0;
      });
    for (std::int32_t &of : face)
      if (alone[index(of)] == 0)
        of = -1;
  }

  void FlatFaces::find_rims(const FacetMesh &mesh)
  {
    std::map<std::pair<std::int32_t, std::pair<std::int32_t, std::int32_t>>, int> uses;
    const auto corners = static_cast<std::size_t>(mesh.corners);
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t c = 0; c < corners && face[f] >= 0; ++c)
        ++uses[{face[f], side(mesh, f, c)}];
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t c = 0; c < corners && face[f] >= 0; ++c)
        rim[f][c] = uses[{face[f], side(mesh, f, c)}] == 1;
    std::set<std::pair<std::int32_t, std::int32_t>> ends; // corners of each face
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t c = 0; c < corners; ++c)
        if (rim[f][c])
          {
            const auto [a, b] = side(mesh, f, c);
            ends.insert({{face[f], a}, {face[f], b}});
          }
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t c = 0; c < corners; ++c)
        tip[f][c] = ends.count({face[f], mesh.facet[f][c]}) > 0;
  }

  void FlatFaces::see(const FacetMesh &mesh)
  {
    for (std::size_t f = 0; f < mesh.size(); ++f)
      if (face[f] >= 0)
        seen[f] = cells::Facet(mesh, mesh.vertex, static_cast<std::int32_t>(f), plane[index(face[f])]);
  }

  bool FlatFaces::on_rim(const std::int32_t facet, const std::array<double, 3> &weight) const
  {
    for (std::size_t c = 0; c < weight.size(); ++c)
      if ((rim[index(facet)][c] && weight[c] == 0) || (tip[index(facet)][c] && weight[c] == 1))
        return true;
    return false;
  }

  bool FlatFaces::beyond_rim(const FacetMesh             &mesh,
                             const std::vector<Vector3d> &place,
                             const Vector3d              &centre,
                             const NearPoint             &point) const
  {
    const std::size_t f = index(point.facet);
    for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
      {
        if (!rim[f][c] || point.point.weight[c] > 0)
          continue;
        const auto [a, b]    = side(mesh, f, c);
        const Vector3d along = (place[index(b)] - place[index(a)]).normalized(); // of a segment zero
        Vector3d       in    = place[index(mesh.facet[f][c])] - place[index(a)];
        in -= in.dot(along) * along;
        if (in.dot(centre - point.point.place) < 0)
          return true;
      }
    return false;
  }

  void FlatFaces::keep_nearest(const FacetMesh             &mesh,
                               const std::vector<Vector3d> &place,
                               const Vector3d              &centre,
                               std::vector<NearPoint>      &near) const
  {
    std::sort(near.begin(), near.end(), [](const NearPoint &a, const NearPoint &b) {
      return a.distance != b.distance ? a.distance < b.distance : a.facet < b.facet;
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < near.size(); ++k)
      {
        const std::int32_t of = face[index(near[k].facet)];
        const bool known      = of >= 0 && std::any_of(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(kept),
                                                       [&](const NearPoint &n) { return face[index(n.facet)] == of; });
        if (!known || beyond_rim(mesh, place, centre, near[k]))
          near[kept++] = near[k];
      }
    near.erase(near.begin() + static_cast<std::ptrdiff_t>(kept), near.end());
  }
} // namespace dem
