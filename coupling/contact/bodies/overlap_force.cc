#include "coupling/contact/bodies/overlap_force.h"

namespace coupling::bodies
{
  using Eigen::Vector3d;

  namespace
  {
    /** Barycentric coordinates of a simplex, and the depth in it, as linear functions of the place. */
    struct Coordinates
    {
      Coordinates(const BodyMesh &mesh, const BodySimplex &of, const Simplex &here)
        : simplex(here)
      {
        for (int c = 0; c < simplex.corners; ++c)
          {
            slope[c] = simplex.slope(c);
            depth[c] = mesh.depth[static_cast<std::size_t>(of.vertex[c])];
            depth_slope += depth[c] * slope[c];
          }
      }

      double at(const int c, const Vector3d &x) const
      {
        const int other = c == 0 ? 1 : 0; // a corner where the coordinate is zero
        return slope[c].dot(x - simplex.corner[other]);
      }
      double depth_at(const Vector3d &x) const { return depth[0] + depth_slope.dot(x - simplex.corner[0]); }

      Simplex                 simplex;
      std::array<Vector3d, 4> slope;
      std::array<double, 4>   depth{};
      Vector3d                depth_slope = Vector3d::Zero();
    };

    bool on_surface(const OverlapPiece &piece, const BodySimplex &of) { return (of.surface >> piece.side & 1) != 0; }
    bool at_the_end(const OverlapPiece &piece, const BodySimplex &of) { return (of.inward >> piece.side & 1) != 0; }

    /** Integral over a piece of the product of two linear functions given at its corners, over its size. */
    double mean_product(const std::array<double, 3> &f, const std::array<double, 3> &g, const int corners)
    {
      double products = 0, sum_f = 0, sum_g = 0;
      for (int c = 0; c < corners; ++c)
        {
          products += f[c] * g[c];
          sum_f += f[c];
          sum_g += g[c];
        }
      return (products + sum_f * sum_g) / (corners * (corners + 1));
    }

    /** What acts on the corners of one simplex by the slope of the potential. @param k half the stiffness */
    void add_potential(const Coordinates &own,
                       const Coordinates &other,
                       const BodySimplex &of,
                       const int          which,
                       const Overlap     &overlap,
                       const double       k,
                       OverlapForce      &found)
    {
      const int corners = own.simplex.corners;
      for (int c = 0; c < corners; ++c)
        found.force[which][c] = k * overlap.volume * found.weight[which][c] * own.depth_slope;
      for (const OverlapPiece &piece : overlap.pieces)
        {
          if (piece.of != which || !on_surface(piece, of))
            continue;
          std::array<double, 3> depth{};
          for (int p = 0; p < corners - 1; ++p)
            depth[p] = other.depth_at(piece.corner[p]);
          for (int c = 0; c < corners; ++c)
            {
              std::array<double, 3> coordinate{};
              for (int p = 0; p < corners - 1; ++p)
                coordinate[p] = own.at(c, piece.corner[p]);
              found.force[which][c] -= k * mean_product(coordinate, depth, corners - 1) * piece.area;
            }
        }
    }

    /** Across the intersection of both surfaces, from the first body to the second. */
    Vector3d direction(const Vector3d &area, const Coordinates &first, const Coordinates &second)
    {
      if (area.squaredNorm() > 0)
        return area.normalized();
      const Vector3d across = second.depth_slope - first.depth_slope;
      return across.squaredNorm() > 0 ? Vector3d(across.normalized()) : Vector3d::Zero();
    }
  } // namespace

  OverlapForce overlap_force(const BodyMesh       &mesh,
                             const BodySimplex    &first,
                             const BodySimplex    &second,
                             const BodyContactForm form,
                             const double          stiffness,
                             Overlap              &overlap)
  {
    OverlapForce  found;
    const Simplex first_here = mesh.at(first), second_here = mesh.at(second);
    find_overlap(first_here, second_here, overlap);
    if (overlap.pieces.empty())
      return found;
    const Coordinates one(mesh, first, first_here), two(mesh, second, second_here);
    found.inside_out     = !(one.simplex.volume() > 0 && two.simplex.volume() > 0);
    const int    corners = mesh.corners;
    const double k = stiffness * (corners == 3 ? mesh.thickness : 1.0), units = corners == 3 ? mesh.thickness : 1.0;
    double       sizes = 0;
    for (const OverlapPiece &piece : overlap.pieces)
      {
        const BodySimplex &of = piece.of == 0 ? first : second;
        found.too_deep        = found.too_deep || at_the_end(piece, of);
        if (!on_surface(piece, of))
          continue;
        found.area += (piece.of == 0 ? units : -units) * piece.area;
        sizes += piece.area.norm();
      }
    found.volume    = units * overlap.volume;
    found.place     = overlap.centroid;
    found.stiffness = 0.5 * k * sizes;
    for (int c = 0; c < corners; ++c)
      {
        found.weight[0][c] = one.at(c, overlap.centroid);
        found.weight[1][c] = two.at(c, overlap.centroid);
      }
    if (form == BodyContactForm::potential)
      {
        add_potential(one, two, first, 0, overlap, 0.5 * k, found);
        add_potential(two, one, second, 1, overlap, 0.5 * k, found);
        found.stored = 0.5 * k * overlap.volume * (one.depth_at(overlap.centroid) + two.depth_at(overlap.centroid));
      }
    else
      {
        const Vector3d push = k * overlap.volume * direction(found.area, one, two);
        for (int c = 0; c < corners; ++c)
          {
            found.force[0][c] = -found.weight[0][c] * push;
            found.force[1][c] = found.weight[1][c] * push;
          }
      }
    for (int c = 0; c < corners; ++c)
      found.on_first += found.force[0][c];
    return found;
  }
} // namespace coupling::bodies
