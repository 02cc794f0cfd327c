#include "dem/genesis/convex_body.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr double      most_pebbles   = 1e7;
    constexpr std::size_t fewest_pebbles = 3; // fewer do not show which way a body is turned

    std::variant<Polygon, Polyhedron> shape_of(const std::vector<Vector3d> &corners, const int dimension)
    {
      if (dimension == 3)
        return Polyhedron(corners);
      std::vector<Eigen::Vector2d> in_plane;
      for (const Vector3d &c : corners)
        in_plane.emplace_back(c.head<2>());
      return convex_polygon(in_plane);
    }

    /** A lattice that reaches beyond the body on all sides, and where its origin is: a particle near its middle. */
    struct LatticeAround
    {
      std::vector<Vector3d> places;
      Vector3d              origin, edge; ///< of a cell [m]
    };

    LatticeAround lattice_around(const ConvexBody &body, const double radius, const Filling filling)
    {
      const bool         plane = body.dimension() == 2, close = filling == Filling::close;
      const auto         kind = plane ? (close ? Lattice::hexagonal : Lattice::square) :
                                        (close ? Lattice::face_centred_cubic : Lattice::simple_cubic);
      const Vector3d     unit = *make_lattice(kind, radius, {1, 1, 1}).periodic_cell;
      std::array<int, 3> half{0, 0, 0}, cells{1, 1, 1};
      double             count = 1;
      for (int d = 0; d < body.dimension(); ++d)
        count *= 2 * body.reach() / unit[d] + 4;
      if (!(count <= most_pebbles))
        throw base::InputError("pebbles of radius " + base::number_text(radius) + " m in a body that reaches " +
                               base::number_text(body.reach()) +
                               " m from its centre: more than ten million. Check the units (metres).");
      for (int d = 0; d < body.dimension(); ++d)
        {
          half[d]  = static_cast<int>(std::ceil(body.reach() / unit[d])) + 1;
          cells[d] = 2 * half[d] + 1;
        }
      const Packing made = make_lattice(kind, radius, cells);
      Vector3d      edge = unit;
      if (plane)
        edge[2] = 0;
      return {made.centre, made.centre[0] + edge.cwiseProduct(Vector3d(half[0], half[1], half[2])), edge};
    }

    std::vector<Vector3d>
    wholly_inside(const ConvexBody &body, const LatticeAround &lattice, const Vector3d &shift, const double radius)
    {
      constexpr double      touching = 1 - 1e-9; // a pebble that touches a face is inside
      std::vector<Vector3d> found;
      for (const Vector3d &place : lattice.places)
        if (body.depth(place + shift) >= touching * radius)
          found.emplace_back(place + shift);
      return found;
    }
  } // namespace

  ConvexBody::ConvexBody(const std::vector<Vector3d> &corners, const int dimension)
    : shape(shape_of(corners, dimension))
    , as_body(std::visit([](const auto &s) { return body_of(s); }, shape))
  {
    for (Vector3d arm : corners)
      {
        arm -= as_body.centre;
        if (dimension == 2)
          arm[2] = 0;
        largest_arm = std::max(largest_arm, arm.norm());
      }
  }

  double ConvexBody::depth(const Vector3d &place) const
  {
    if (const auto *polygon = std::get_if<Polygon>(&shape))
      return polygon->depth(place.head<2>());
    return std::get<Polyhedron>(shape).depth(place);
  }

  Packing filled_with_pebbles(const ConvexBody &body, const double radius, const Filling filling)
  {
    const LatticeAround   lattice = lattice_around(body, radius, filling);
    const int             phases  = body.dimension() == 2 ? 4 : 8;
    std::vector<Vector3d> most;
    for (int phase = 0; phase < phases; ++phase)
      {
        const Vector3d half(phase & 1, (phase >> 1) & 1, (phase >> 2) & 1);
        const Vector3d shift = body.properties().centre - lattice.origin - 0.5 * half.cwiseProduct(lattice.edge);
        auto           found = wholly_inside(body, lattice, shift, radius);
        if (found.size() > most.size())
          most = std::move(found);
      }
    if (most.size() < fewest_pebbles)
      throw base::InputError(std::to_string(most.size()) + " pebbles of radius " + base::number_text(radius) +
                             " m find room in it, it needs " + std::to_string(fewest_pebbles) + ". Take smaller ones.");
    Packing packing;
    packing.centre = std::move(most);
    packing.radius.assign(packing.centre.size(), radius);
    packing.clump.assign(packing.centre.size(), 0);
    packing.bodies = {body.properties()};
    return packing;
  }
} // namespace dem
