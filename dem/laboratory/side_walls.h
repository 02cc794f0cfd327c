#pragma once

#include "dem/laboratory/membrane.h"
#include "dem/laboratory/particle_gauges.h"
#include "dem/model/materials.h"
#include "dem/specimen/specimen.h"

#include <array>
#include <cstddef>
#include <vector>

namespace dem
{
  /**
   * Rigid walls at the sides of a specimen between platens, each pair held at a pressure by servos (ForceServo): in the plane two, in
   * space four. The specimen must outlive them.
   */
  class SideWalls
  {
  public:
    /** Before the first step: they touch the outermost particles. @param axis of the load, along which there are none */
    SideWalls(Specimen &specimen, const BodyExtent &body, int axis, const LinkMaterials &contact);

    /** From the next step on. @param pressure [Pa] @param largest_speed [m/s] @param gain see ForceServo */
    void hold(double pressure, const EndPlanes &ends, double largest_speed, double gain);
    /** Mean of the forces on the walls over the areas that they cover between the platens and each other, at t_n [Pa]. */
    double pressure(const EndPlanes &ends) const;
    /** Largest deviation of a wall's pressure from the given one, of that [-]. */
    double error(double pressure, const EndPlanes &ends) const;

  private:
    struct Pair
    {
      int                        axis;
      std::array<std::size_t, 2> number; ///< of surfaces: low, high
      double                     apart;  ///< at the start [m]
    };

    Eigen::Vector3d inward(const Pair &pair, std::size_t side) const;
    double          distance(const Pair &pair) const; ///< of its two walls now [m]
    /** That a wall of a pair presses on: as high as the specimen, as wide as the other pair is apart [m^2]. */
    double area(const Pair &pair, const EndPlanes &ends) const;
    /** Force on a wall, outwards [N]. */
    double force(const Pair &pair, std::size_t side) const;

    Specimen         *specimen;
    std::vector<Pair> pairs;
  };
} // namespace dem
