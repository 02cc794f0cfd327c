#pragma once

#include "dem/specimen/grip.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dem
{
  struct SpecimenCore;

  /** What the grips of a specimen feel, at t_n of the last step. Valid as long as the specimen. */
  class GripReadings
  {
  public:
    explicit GripReadings(SpecimenCore &specimen)
      : core(&specimen)
    {
    }

    /** Force that the grip exerts on its particles [N]. */
    Eigen::Vector3d reaction(std::size_t grip) const;
    /** Sum of the moments that the grip exerts on its particles about their own centres [N m]. */
    Eigen::Vector3d reaction_moment(std::size_t grip) const;
    /** Moment of all that the grip exerts on its particles in prescribed directions, about a point [m], [N m]. */
    Eigen::Vector3d reaction_moment(std::size_t grip, const Eigen::Vector3d &about) const;

  protected:
    SpecimenCore *core;
  };

  /** Groups of particles with prescribed motion. Valid as long as the specimen. */
  class Grips : public GripReadings
  {
  public:
    explicit Grips(SpecimenCore &specimen)
      : GripReadings(specimen)
    {
    }

    /** Prescribe motion of a group from now on. @return its number, from 0 @throws base::InputError in a periodic cell, or for a pebble */
    std::size_t add(const Grip &grip);
    void        set_velocity(std::size_t grip, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    /** The same for each of the grip's particles on its own, in the order of Grip::particles. @throws base::InputError for another number of them */
    void set_velocities(std::size_t                         grip,
                        const std::vector<Eigen::Vector3d> &velocity,
                        const std::vector<Eigen::Vector3d> &spin);
  };
} // namespace dem
