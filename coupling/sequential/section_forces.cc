#include "coupling/sequential/section_forces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace coupling
{
  std::vector<SectionForce> section_forces(const Sections                     &sections,
                                           const std::vector<Eigen::Vector3d> &place,
                                           const std::vector<double>          &volume,
                                           const std::vector<Eigen::Matrix3d> &stress)
  {
    const double              thickness = (sections.high - sections.low) / sections.count;
    std::vector<SectionForce> slabs(static_cast<std::size_t>(sections.count));
    for (std::size_t s = 0; s < slabs.size(); ++s)
      slabs[s].place = sections.low + (static_cast<double>(s) + 0.5) * thickness;
    for (std::size_t i = 0; i < place.size(); ++i)
      {
        const double    along       = std::floor((place[i][sections.axis] - sections.low) / thickness);
        SectionForce   &slab        = slabs[static_cast<std::size_t>(std::clamp(along, 0.0, sections.count - 1.0))];
        Eigen::Vector3d arm         = place[i] - sections.centre;
        arm[sections.axis]          = place[i][sections.axis] - slab.place;
        const Eigen::Vector3d force = volume[i] / thickness * stress[i].col(sections.axis);
        slab.volume += volume[i];
        slab.force += force;
        slab.moment += arm.cross(force);
      }
    return slabs;
  }
} // namespace coupling
