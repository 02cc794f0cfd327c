#pragma once

#include "dem/core/recycled.h"
#include "dem/facets/cell.h"
#include "dem/facets/facets_around.h"
#include "dem/facets/number_set.h"
#include "dem/facets/vertex_weights.h"

#include <cstdint>

namespace dem::cells
{
  /** Facets that lean from the tangential plane by less than 20 degrees are under the sphere, by more than 40 they are not. */
  extern const double upright, leaning; // their cosines
  /** Part of a contact that is spread over the area that counts [m^2]: below a quarter of the square around the sphere it fades into a point. */
  inline double spread_part(const double area, const double radius) { return std::min(area / (radius * radius), 1.0); }

  /** A facet seen in a plane. Of discs segments are strips without end. */
  struct Facet
  {
    Facet() = default;
    Facet(const FacetMesh                    &mesh,
          const std::vector<Eigen::Vector3d> &place,
          std::int32_t                        number_,
          const Tangents                     &tangents);

    /** Sides included. */
    bool holds(const Point &p) const;
    bool holds(const Polygon &cell) const;
    /** Integrals of the shape functions over a part of it; they add up to its area. */
    std::array<double, 3> integrals(const Area &over) const
    {
      const double second = over.size * shape[1].at_origin + shape[1].slope.dot(over.moment),
                   third  = corners == 3 ? over.size * shape[2].at_origin + shape[2].slope.dot(over.moment) : 0.0;
      return {over.size - second - third, second, third};
    }
    void cut_out_of(Polygon &polygon) const
    {
      for (std::size_t c = 0; c < static_cast<std::size_t>(corners) && polygon.count > 0; ++c)
        cut(polygon, shape[c], Side::surface);
    }

    std::int32_t             number  = -1;
    int                      corners = 0;
    double                   share   = 0; ///< 1: upright, 0: leans too much
    std::array<HalfPlane, 3> shape;       ///< functions of its corners: it is where none is negative
  };

  /** What of a facet is in the cell. */
  struct Covered
  {
    Facet               facet;
    Polygon             part;
    Point               low, high; ///< box around that
    Area                counted;
    std::array<Area, 2> glide; ///< how that changes as the contact glides along the axes
  };

  /** What of the surface lies under a cell, and the memory to find that again and again. */
  class Cover
  {
  public:
    /**
     * From facet to facet over shared corners: what lies behind a plate is not under the sphere.
     * @param cell where it is in the plane @param seen of a number the facet, nullptr where that never counts
     */
    template <typename Seen>
    void find(
      const FacetMesh &mesh, const FacetsAround &around, const Polygon &cell, const std::int32_t from, const Seen &seen)
    {
      under.clear();
      met.clear();
      met.add(from);
      open.assign(1, from);
      while (!open.empty())
        {
          const std::int32_t number = open.back();
          open.pop_back();
          const Facet *facet  = seen(number);
          const bool   inside = facet && add(*facet, cell);
          if (inside || number == from)
            around.each(mesh, number, [&](const std::int32_t other) {
              if (met.add(other))
                open.push_back(other);
            });
        }
    }

    /** @param whole cell [m^2] @param about the contact @return the part that counts [m^2]: all inside a surface, what is symmetric elsewhere */
    double count(double whole, const Point &about);

    const Recycled<Covered> &parts() const { return under; }

    /** Append weights of the vertices. @param spread part of the whole @param area that counts [m^2] */
    void add_weights(std::vector<VertexWeight> &weights, const FacetMesh &mesh, double spread, double area) const;

  private:
    bool add(const Facet &facet, const Polygon &cell);
    void count_symmetric(const Point &about);

    Recycled<Covered>         under;
    NumberSet                 met;
    std::vector<std::int32_t> open;
  };
} // namespace dem::cells
