#include "dem/facets/pressure.h"

#include <array>

namespace dem
{
  namespace
  {
    struct QuadraturePoint
    {
      double weight; ///< of the facet's area
      double corner[3];
    };

    // Six points of a triangle, exact to the fourth order: D. A. Dunavant, Int. J. Numer. Meth. Engng 21 (1985) 1129-1148.
    constexpr double          w1 = 0.223381589678011, a1 = 0.445948490915965, b1 = 1 - 2 * a1;
    constexpr double          w2 = 0.109951743655322, a2 = 0.091576213509771, b2 = 1 - 2 * a2;
    constexpr QuadraturePoint of_triangle[] = {{w1, {b1, a1, a1}}, {w1, {a1, b1, a1}}, {w1, {a1, a1, b1}},
                                               {w2, {b2, a2, a2}}, {w2, {a2, b2, a2}}, {w2, {a2, a2, b2}}};
    // Three of a segment, after Gauss.
    constexpr double          g            = 0.112701665379258;
    constexpr QuadraturePoint of_segment[] = {
      {5.0 / 18, {1 - g, g, 0}}, {8.0 / 18, {0.5, 0.5, 0}}, {5.0 / 18, {g, 1 - g, 0}}};

    /** Place of a vertex's entry: there is one each, in the order in which they come. */
    std::size_t place_of(std::vector<VertexPart> &parts, const std::size_t from, const std::int32_t vertex)
    {
      for (std::size_t k = from; k < parts.size(); ++k)
        if (parts[k].vertex == vertex)
          return k;
      parts.push_back({vertex, 0, Eigen::Vector3d::Zero(), 0});
      return parts.size() - 1;
    }
  } // namespace

  PressedPatch press(const Surface                &surface,
                     const std::vector<NearPoint> &near,
                     const Eigen::Vector3d        &centre,
                     const double                  radius,
                     const double                  thickness,
                     std::vector<VertexPart>      &parts)
  {
    const double bedding = surface.law.linear()->normal / surface.skin; // [N/m^3]
    const bool   plane   = surface.mesh.corners == 2;
    const auto  *first   = plane ? std::begin(of_segment) : std::begin(of_triangle);
    const auto  *last    = plane ? std::end(of_segment) : std::end(of_triangle);
    const auto   from    = parts.size();
    PressedPatch patch;
    for (const NearPoint &point : near)
      {
        const auto                 facet  = static_cast<std::size_t>(point.facet);
        const auto                &corner = surface.mesh.facet[facet];
        std::array<std::size_t, 3> entry{}; // of its corners, once it has been touched
        bool                       touched = false;
        for (const QuadraturePoint *q = first; q != last; ++q)
          {
            Eigen::Vector3d branch = -centre;
            for (int c = 0; c < surface.mesh.corners; ++c)
              branch += q->corner[c] * surface.place[static_cast<std::size_t>(corner[static_cast<std::size_t>(c)])];
            const double distance = branch.norm(), overlap = radius - distance;
            if (overlap <= 0)
              continue;
            const double          spring = bedding * thickness * q->weight * surface.area[facet];
            const Eigen::Vector3d push   = spring * overlap / distance * branch; // on the surface
            for (std::size_t c = 0; !touched && c < static_cast<std::size_t>(surface.mesh.corners); ++c)
              entry[c] = place_of(parts, from, corner[c]);
            touched = true;
            for (int c = 0; c < surface.mesh.corners; ++c)
              {
                VertexPart &part = parts[entry[static_cast<std::size_t>(c)]];
                part.weight += q->corner[c] * spring * overlap;
                part.force += q->corner[c] * push;
                part.stiffness += q->corner[c] * spring;
              }
            patch.push -= push;
            patch.total += spring * overlap;
            patch.stiffness += spring;
            patch.spring += 0.5 * spring * overlap * overlap;
            patch.place += spring * overlap * (centre + branch);
            if (overlap > patch.deepest)
              {
                patch.deepest = overlap;
                patch.facet   = point.facet;
              }
          }
      }
    if (!patch.touches())
      return patch;
    patch.place /= patch.total;
    for (std::size_t k = from; k < parts.size(); ++k)
      parts[k].weight /= patch.total;
    return patch;
  }
} // namespace dem
