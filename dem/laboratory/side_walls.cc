#include "dem/laboratory/side_walls.h"

#include "dem/facets/surface.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dem
{
  using Eigen::Vector3d;

  SideWalls::SideWalls(Specimen &body_, const BodyExtent &body, const int axis, const LinkMaterials &contact)
    : specimen(&body_)
  {
    const int dimension = specimen->parameters().physics.dimension;
    for (int a = 0; a < dimension; ++a)
      {
        if (a == axis)
          continue;
        Pair pair{a, {}, body.length(a)};
        for (const std::size_t side : {0, 1})
          {
            Vector3d point = side == 0 ? body.low : body.high;
            if (dimension == 2)
              point[2] = 0;
            const std::string name = std::string(side == 0 ? "low " : "high ") + "xyz"[a] + " wall";
            pair.number[side] = specimen->surfaces().add({name, FacetMesh::plane(point, inward(pair, side)), contact});
          }
        pairs.push_back(pair);
      }
  }

  Vector3d SideWalls::inward(const Pair &pair, const std::size_t side) const
  {
    Vector3d direction   = Vector3d::Zero();
    direction[pair.axis] = side == 0 ? 1 : -1;
    return direction;
  }

  double SideWalls::distance(const Pair &pair) const
  {
    return pair.apart + specimen->surfaces().at(pair.number[1]).travel[pair.axis] -
           specimen->surfaces().at(pair.number[0]).travel[pair.axis];
  }

  double SideWalls::area(const Pair &pair, const EndPlanes &ends) const
  {
    double wide = specimen->parameters().physics.dimension == 2 ? specimen->parameters().thickness : 1.0;
    for (const Pair &other : pairs)
      if (other.axis != pair.axis)
        wide *= distance(other);
    return wide * (ends.high - ends.low);
  }

  double SideWalls::force(const Pair &pair, const std::size_t side) const
  {
    return -specimen->surfaces().at(pair.number[side]).total_force.dot(inward(pair, side));
  }

  void SideWalls::hold(const double pressure, const EndPlanes &ends, const double largest_speed, const double gain)
  {
    for (const Pair &pair : pairs)
      for (const std::size_t side : {0, 1})
        specimen->surfaces().hold_at_force(pair.number[side],
                                           {inward(pair, side), pressure * area(pair, ends), largest_speed, gain});
  }

  double SideWalls::pressure(const EndPlanes &ends) const
  {
    double sum = 0;
    for (const Pair &pair : pairs)
      for (const std::size_t side : {0, 1})
        sum += force(pair, side) / area(pair, ends);
    return sum / static_cast<double>(2 * pairs.size());
  }

  double SideWalls::error(const double wanted, const EndPlanes &ends) const
  {
    double worst = 0;
    for (const Pair &pair : pairs)
      for (const std::size_t side : {0, 1})
        worst = std::max(worst, std::abs(force(pair, side) / (wanted * area(pair, ends)) - 1));
    return worst;
  }
} // namespace dem
