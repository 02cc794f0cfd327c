#include "dem/genesis/polyhedron.h"

#include "base/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace dem
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  namespace
  {
    /** What counts as the same place, of the body's size: corners written with seven digits lie in a plane so nearly. */
    constexpr double same = 1e-6;
    /** A body thinner than this part of its size is none. */
    constexpr double thinnest = 1e-5;

    std::string named(const std::size_t number) { return "corner " + std::to_string(number + 1); }

    /** Two unit vectors across a normal, right-handed with it. */
    std::pair<Vector3d, Vector3d> across(const Vector3d &normal)
    {
      const Vector3d first = normal.unitOrthogonal();
      return {first, normal.cross(first)};
    }
  } // namespace

  Polyhedron::Polyhedron(const std::vector<Vector3d> &corners)
    : corner(corners)
  {
    if (corner.size() < 4)
      throw base::InputError("a body in space has at least 4 corners, and " + std::to_string(corner.size()) +
                             " were given.");
    for (std::size_t i = 0; i < corner.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        size = std::max(size, (corner[i] - corner[j]).norm());
    for (std::size_t i = 0; i < corner.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!((corner[i] - corner[j]).norm() > same * size))
          throw base::InputError(named(j) + " and " + named(i) + " are the same place.");
    find_faces();
    refuse_corners_that_are_none();
    integrate();
  }

  std::vector<std::size_t>
  Polyhedron::face_through(const std::size_t i, const std::size_t j, const std::size_t k, Vector3d &normal) const
  {
    normal              = (corner[j] - corner[i]).cross(corner[k] - corner[i]);
    const double longer = std::max((corner[j] - corner[i]).norm(), (corner[k] - corner[i]).norm());
    if (normal.norm() <= same * longer * size) // the three lie on a line
      return {};
    normal.normalize();
    bool                     above = false, below = false;
    std::vector<std::size_t> in_plane;
    for (std::size_t c = 0; c < corner.size(); ++c)
      {
        const double height = normal.dot(corner[c] - corner[i]);
        if (std::abs(height) <= same * size)
          in_plane.push_back(c);
        else
          (height > 0 ? above : below) = true;
      }
    if (above == below) // a plane through the body, or a body that lies in it
      return {};
    if (above)
      normal = -normal;
    return in_plane;
  }

  bool Polyhedron::is_in_a_face(const std::array<std::size_t, 3> &three) const
  {
    return std::any_of(faces.begin(), faces.end(), [&](const Face &face) {
      return std::all_of(three.begin(), three.end(), [&](const std::size_t c) {
        return std::find(face.corners.begin(), face.corners.end(), c) != face.corners.end();
      });
    });
  }

  void Polyhedron::find_faces()
  {
    const std::size_t n = corner.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k)
          {
            if (is_in_a_face({i, j, k}))
              continue;
            Face face;
            face.corners = face_through(i, j, k, face.normal);
            if (face.corners.empty())
              continue;
            Vector3d middle = Vector3d::Zero();
            for (const std::size_t c : face.corners)
              middle += corner[c] / static_cast<double>(face.corners.size());
            const auto [first, second] = across(face.normal);
            const auto angle           = [&, first = first, second = second](const std::size_t c) {
              const Vector3d arm = corner[c] - middle;
              return std::atan2(second.dot(arm), first.dot(arm));
            };
            std::sort(face.corners.begin(), face.corners.end(),
                      [&](const std::size_t a, const std::size_t b) { return angle(a) < angle(b); });
            face.at = face.normal.dot(middle);
            faces.push_back(std::move(face));
          }
    if (faces.size() < 4)
      throw base::InputError("all corners lie in one plane: they bound no body.");
  }

  void Polyhedron::refuse_corners_that_are_none() const
  {
    std::vector<bool> stands_out(corner.size(), false);
    for (const Face &face : faces)
      for (std::size_t k = 0; k < face.corners.size(); ++k)
        {
          const std::size_t n      = face.corners.size();
          const Vector3d   &before = corner[face.corners[(k + n - 1) % n]], &here = corner[face.corners[k]],
                         &after = corner[face.corners[(k + 1) % n]];
          const Vector3d in = here - before, out = after - here;
          if (!(face.normal.dot(in.cross(out)) > same * in.norm() * out.norm()))
            throw base::InputError(named(face.corners[k]) +
                                   " does not stand out: it lies in a face or on an edge of the "
                                   "hull of the others. Leave it out.");
          stands_out[face.corners[k]] = true;
        }
    for (std::size_t c = 0; c < corner.size(); ++c)
      if (!stands_out[c])
        throw base::InputError("the body is not convex: " + named(c) +
                               " lies inside the hull of the others. Make it of several convex ones.");
  }

  void Polyhedron::integrate()
  {
    // Tetrahedra between a point inside and the triangles of each face: their volume and second moments are polynomials of their corners.
    Vector3d inside = Vector3d::Zero();
    for (const Vector3d &c : corner)
      inside += c / static_cast<double>(corner.size());
    Vector3d first  = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    for (const Face &face : faces)
      for (std::size_t k = 1; k + 1 < face.corners.size(); ++k)
        {
          const Vector3d a = corner[face.corners[0]] - inside, b = corner[face.corners[k]] - inside,
                         c = corner[face.corners[k + 1]] - inside, sum = a + b + c;
          const double six_volumes = a.dot(b.cross(c));
          own_volume += six_volumes / 6;
          first += six_volumes / 24 * sum;
          second +=
            six_volumes / 120 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
        }
    const Vector3d arm = first / own_volume;
    own_centroid       = inside + arm;
    own_moments        = second / own_volume - arm * arm.transpose();
    double narrowest   = std::numeric_limits<double>::infinity();
    for (const Face &face : faces)
      {
        double low = std::numeric_limits<double>::infinity();
        for (const Vector3d &c : corner)
          low = std::min(low, face.normal.dot(c));
        narrowest = std::min(narrowest, face.at - low);
      }
    if (!(narrowest > thinnest * size))
      throw base::InputError("the body is flat: its corners lie in one plane up to " + std::to_string(thinnest) +
                             " of its size.");
  }

  double Polyhedron::depth(const Vector3d &place) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Face &face : faces)
      least = std::min(least, face.at - face.normal.dot(place));
    return least;
  }

  PackedBody body_of(const Polyhedron &polyhedron)
  {
    PackedBody body;
    body.volume             = polyhedron.volume();
    body.centre             = polyhedron.centroid();
    const Matrix3d &moments = polyhedron.second_moments();
    body.inertia            = moments.trace() * Matrix3d::Identity() - moments;
    return body;
  }
} // namespace dem
