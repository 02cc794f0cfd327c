#pragma once

#include "dem/laboratory/membrane.h"
#include "dem/laboratory/particle_gauges.h"
#include "dem/laws/linear_contact.h"
#include "dem/specimen/specimen.h"

#include <array>
#include <cstddef>
#include <optional>

namespace dem
{
  /** What loads a specimen from two sides. */
  struct PressParameters
  {
    enum class Kind
    {
      platens, ///< two unbounded planes that press
      glued,   ///< two layers of particles that are held by platens and pulled apart
      rollers  ///< two rollers below and one above: a beam in three-point bending
    };

    Kind          kind      = Kind::platens;
    int           axis      = 2;                         ///< of the load
    LinkMaterials contact   = LinearContactParameters(); ///< of platens and rollers with particles
    double        smoothing = 0;                ///< depth at which the specimen's ends are cut off under platens [m]
    std::optional<std::array<double, 2>> stand; ///< where platens stand along the axis, low and high: cut off there [m]
    double                               layer  = 0;     ///< thickness of what is glued, from the outermost centre [m]
    bool                                 turns  = false; ///< each glued platen turns about its middle
    int                                  along  = 0;     ///< axis of the beam
    double                               span   = 0;     ///< between the rollers below [m]
    double                               roller = 0;     ///< radius [m]
    bool both = true; ///< both sides move, each at half the speed; otherwise the high one alone
  };

  /**
   * Both sides of a testing machine at a specimen. Forces and motion are positive in the sense of the load: platens come together, glued
   * ones part. The specimen must outlive it.
   */
  class Press
  {
  public:
    /** Before the first step. @throws base::InputError where there is nothing to load, or the machine does not fit the specimen */
    Press(Specimen &specimen, const PressParameters &parameters);

    /** From the next step on both sides move at this speed towards each other, or apart if glued [m/s]. */
    void move(double speed);
    /** Each side presses with this force from now on [N], platens only. @param largest_speed [m/s] @param gain see ForceServo */
    void hold(double force, double largest_speed, double gain);

    enum Side
    {
      low,
      high
    };
    double    force(Side side) const;                 ///< at t_n [N]
    double    approach() const;                       ///< that both have made since the start, at t_n + dt [m]
    EndPlanes planes() const;                         ///< of platens, where they are now
    double    height() const { return start_height; } ///< between them at the start [m]

    /** What lies in it: what an approach is divided by. */
    const PressParameters &what() const { return parameters; }
    void                   visit_state(base::StateVisitor &visitor);

  private:
    void            add_platens(const BodyExtent &body);
    void            add_layers(const ParticleKinematics &particles);
    void            add_rollers(const ParticleKinematics &particles, const BodyExtent &body);
    double          side_speed(Side side, double speed) const;
    Eigen::Vector3d inward(Side side) const;

    Specimen                  *specimen;
    PressParameters            parameters;
    std::array<std::size_t, 2> number{}; ///< of surfaces, or of grips
    std::array<double, 2>      place{};  ///< of platens at the start, along the axis [m]
    double                     start_height = 0;
    double                     glued_travel = 0, glued_speed = 0, glued_time = 0; ///< of grips, which do not know it
  };
} // namespace dem
