#include "dem/laboratory/cylinder_wall.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/facets/surface.h"
#include "dem/grips/section.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr double half_side = M_PI / static_cast<double>(CylinderWall::sides); ///< [rad]
    /** Of the circle around it, the least section of what is called a cylinder; a square has 0.64. */
    constexpr double least_round = 0.8;
  } // namespace

  CylinderWall::CylinderWall(Specimen                 &body,
                             const ParticleKinematics &particles,
                             const int                 axis,
                             const LinkMaterials      &contact)
    : specimen(&body)
  {
    const BodyExtent extent(particles);
    const Vector3d   middle = 0.5 * (extent.low + extent.high);
    for (std::size_t side = 0; side < sides; ++side)
      {
        const double angle = 2 * half_side * static_cast<double>(side);
        outward[side].setZero();
        outward[side][(axis + 1) % 3] = std::cos(angle);
        outward[side][(axis + 2) % 3] = std::sin(angle);
        for (std::size_t i = 0; i < particles.position.size(); ++i)
          start = std::max(start, outward[side].dot(particles.position[i] - middle) + particles.radius[i]);
      }
    const double section = nominal_section({particles.position, particles.radius, 3, 0}, axis);
    if (section < least_round * M_PI * start * start)
      throw base::InputError("Laboratory/Confinement: a cylinder of radius " + base::number_text(start) +
                             " m goes around a specimen of section " + base::number_text(section) +
                             " m^2, of which it would touch the edges only. Take walls or a membrane.");
    for (std::size_t side = 0; side < sides; ++side)
      number[side] =
        specimen->surfaces().add({"cylinder wall " + std::to_string(side + 1),
                                  FacetMesh::plane(middle + start * outward[side], -outward[side]), contact});
  }

  double CylinderWall::radius() const { return start + specimen->surfaces().at(number[0]).travel.dot(outward[0]); }

  double CylinderWall::area(const EndPlanes &ends) const
  {
    return 2 * static_cast<double>(sides) * std::tan(half_side) * radius() * (ends.high - ends.low);
  }

  double CylinderWall::force() const
  {
    double sum = 0;
    for (std::size_t side = 0; side < sides; ++side)
      sum += specimen->surfaces().at(number[side]).total_force.dot(outward[side]);
    return sum;
  }

  double CylinderWall::pressure(const EndPlanes &ends) const { return force() / area(ends); }

  void CylinderWall::hold(const double pressure, const EndPlanes &ends, const double largest_speed, const double gain)
  {
    specimen->partners().find_surface_forces();
    double stiff = 0;
    for (const std::size_t plane : number)
      stiff += specimen->surfaces().at(plane).stiffness[0];
    const double lacking = pressure * area(ends) - force();
    double       inwards = std::copysign(largest_speed, lacking);
    if (stiff > 0)
      inwards = std::clamp(gain * lacking / (stiff * specimen->time_step()), -largest_speed, largest_speed);
    for (std::size_t side = 0; side < sides; ++side)
      specimen->surfaces().set_motion(number[side], -inwards * outward[side], Vector3d::Zero(),
                                      specimen->surfaces().at(number[side]).centre);
  }
} // namespace dem
