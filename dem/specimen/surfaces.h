#pragma once

#include "dem/specimen/results.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  struct ForceServo;
  struct SpecimenCore;
  struct Surface;
  struct SurfaceParameters;

  /** The surfaces that particles of a specimen touch, as they are. Valid as long as the specimen. */
  class SurfaceReadings
  {
  public:
    explicit SurfaceReadings(SpecimenCore &specimen)
      : core(&specimen)
    {
    }

    std::size_t size() const;
    /** A surface's vertices, the forces on it at t_n and the impulses that it has taken. */
    const Surface           &at(std::size_t number) const;
    std::vector<WallContact> contacts() const; ///< at t_n; called by all ranks, which have their own alone until then
    /** How often facets near particles were searched, and how many pairs were tested for it, since the start. */
    std::array<std::int64_t, 2> searches() const;

  protected:
    SpecimenCore *core;
  };

  /** Walls, and boundaries of a partner's body. Valid as long as the specimen. */
  class Surfaces : public SurfaceReadings
  {
  public:
    explicit Surfaces(SpecimenCore &specimen)
      : SurfaceReadings(specimen)
    {
    }

    /**
     * A surface that particles touch from now on; it rests until it is moved.
     * @return its number, from 0 @throws base::InputError for a degenerate facet; in a periodic cell; and before the first step for
     * particles behind it or in it by more than half their radius
     */
    std::size_t add(const SurfaceParameters &surface);
    /** Move it as a rigid body: velocity [m/s] and spin [rad/s] of the step to come. @param about where the axis passes now [m]; moves with it */
    void set_motion(std::size_t            surface,
                    const Eigen::Vector3d &velocity,
                    const Eigen::Vector3d &spin  = {0, 0, 0},
                    const Eigen::Vector3d &about = {0, 0, 0});
    /** Move it so that it bears a force from now on; call it again for another force. @throws base::InputError for an unusable servo */
    void hold_at_force(std::size_t surface, const ForceServo &servo);
    /** Each vertex moves on its own [m/s] from the next step on. @throws base::InputError for another number of them, or for a plane */
    void set_vertex_velocities(std::size_t surface, const std::vector<Eigen::Vector3d> &velocity);
    /**
     * Before the first step: particles that reach through the surface are cut off at it, so that they touch it without force (smoothing of
     * a specimen's ends). @throws base::InputError once there was a step, and for a surface whose contacts are spread or of a skin
     */
    void cut_off(std::size_t surface);
  };
} // namespace dem
