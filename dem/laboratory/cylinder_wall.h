#pragma once

#include "dem/laboratory/membrane.h"
#include "dem/laboratory/particle_gauges.h"
#include "dem/model/materials.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace dem
{
  /**
   * A rigid jacket around an upright cylinder between two platens: a prism of planes that all move inwards or outwards alike, as a servo
   * has it that holds the mean pressure on them (doc/theory/laboratory.md, 4). The specimen must outlive it.
   */
  class CylinderWall
  {
  public:
    /** How many planes there are: the prism deviates from a circle by a thousandth of its radius. */
    static constexpr std::size_t sides = 72;

    /** Before the first step: it touches the outermost particle. @param axis of the load @throws base::InputError where the specimen is no cylinder about it */
    CylinderWall(Specimen &specimen, const ParticleKinematics &particles, int axis, const LinkMaterials &contact);

    /** For the step to come. @param pressure [Pa] @param largest_speed [m/s] @param gain as of ForceServo */
    void hold(double pressure, const EndPlanes &ends, double largest_speed, double gain);
    /** Mean of the normal force over the area between the platens, at t_n [Pa]. */
    double pressure(const EndPlanes &ends) const;
    double radius() const; ///< from the axis to the planes [m]

  private:
    double area(const EndPlanes &ends) const; ///< of the prism between the platens [m^2]
    double force() const;                     ///< on all planes, outwards [N]

    Specimen                          *specimen;
    std::array<std::size_t, sides>     number{};  ///< of surfaces
    std::array<Eigen::Vector3d, sides> outward;   ///< unit
    double                             start = 0; ///< radius then [m]
  };
} // namespace dem
