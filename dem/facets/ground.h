#pragma once

#include "dem/facets/cell.h"
#include "dem/facets/facets_around.h"
#include "dem/facets/vertex_weights.h"

#include <cstdint>

namespace dem::cells
{
  /** Facets that lean from the tangential plane by less than 20 degrees are under the sphere, by more than 40 they are not. */
  extern const double upright, leaning; // their cosines
  /** What is left of a cell fades into a point below this part of the square around the sphere. */
  constexpr double smallest_part = 0.25;

  /** A facet seen in the tangential plane. In the plane segments become strips as wide as the sphere. */
  struct Facet
  {
    Facet(const FacetMesh                    &mesh,
          const std::vector<Eigen::Vector3d> &place,
          const std::int32_t                  number_,
          const Tangents                     &tangents,
          const double                        half)
      : number(number_)
      , corners(mesh.corners)
    {
      for (int c = 0; c < corners; ++c)
        {
          x[c]      = place[static_cast<std::size_t>(mesh.facet[static_cast<std::size_t>(number)][c])];
          corner[c] = tangents.of(x[c]);
        }
      if (corners == 3)
        outline.count = 3, outline.corner[0] = corner[0], outline.corner[1] = corner[1], outline.corner[2] = corner[2];
      else
        for (const auto &[end, side] : {std::pair(0, -half), {1, -half}, {1, half}, {0, half}})
          outline.add({corner[end].x(), side});
      size = area_of(outline).size;
      if (size < 0)
        std::reverse(outline.corner.begin(), outline.corner.begin() + outline.count);
    }

    /** Unit; of any sign. */
    Eigen::Vector3d normal() const
    {
      const Eigen::Vector3d edge = x[1] - x[0];
      return (corners == 3 ? edge.cross(Eigen::Vector3d(x[2] - x[0])) : Eigen::Vector3d(-edge.y(), edge.x(), 0))
        .normalized();
    }

    /** Shape functions there. */
    std::array<double, 3> shape(const Point &p) const
    {
      if (corners == 2)
        {
          const double along = (p.x() - corner[0].x()) / (corner[1].x() - corner[0].x());
          return {1 - along, along, 0};
        }
      const double b = turn(p - corner[0], corner[2] - corner[0]) / (2 * size),
                   c = turn(corner[1] - corner[0], p - corner[0]) / (2 * size);
      return {1 - b - c, b, c};
    }

    std::int32_t                   number;
    int                            corners;
    std::array<Eigen::Vector3d, 3> x;
    std::array<Point, 3>           corner;
    Polygon                        outline;
    double                         size; ///< signed
  };

  /** What of a facet is in the cell. */
  struct Covered
  {
    Facet   facet;
    Polygon part;
    double  share; ///< 1: upright, 0: leans too much
    Area    counted;
  };

  /** Whether the point lies in the facet, sides included. */
  bool holds(const Facet &facet, const Point &p);

  /** The plane in which a sphere stands, and its cell there. */
  struct Ground
  {
    Ground(const FacetMesh                    &mesh_,
           const std::vector<Eigen::Vector3d> &place_,
           const Tangents                     &tangents_,
           const Polygon                      &cell_,
           const double                        half_)
      : mesh(mesh_)
      , place(place_)
      , tangents(tangents_)
      , cell(cell_)
      , half(half_)
    {
    }
    Facet facet(const std::int32_t number) const { return {mesh, place, number, tangents, half}; }
    /** 1: upright, 0: leans too much. */
    double share(const Facet &of) const;
    double square() const { return 4 * half * half; } ///< around the sphere [m^2]
    /** Whether all of the cell lies in this facet. */
    bool lies_in(std::int32_t facet) const;
    /** What of the facets is in the cell, from facet to facet over shared corners: what lies behind a plate is not under the sphere. */
    std::vector<Covered> covered(const FacetsAround &around, std::int32_t from) const;

    const FacetMesh                    &mesh;
    const std::vector<Eigen::Vector3d> &place;
    Tangents                            tangents;
    Polygon                             cell;
    double                              half; ///< radius [m]
  };

  /** @return what counts of the cell [m^2]: all of it inside a surface, what is symmetric elsewhere */
  double count(std::vector<Covered> &under, double whole);

  /** Weights of the vertices under the cell. @param spread part of the whole @param area that counts [m^2] */
  void add_spread(std::vector<VertexWeight>  &weights,
                  const FacetMesh            &mesh,
                  const std::vector<Covered> &under,
                  double                      spread,
                  double                      area);
} // namespace dem::cells
