#pragma once

#include "dem/model/particles.h"
#include "dem/specimen/grip.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * The face of a grip that turns freely about the middle of its particles (doc/theory/laboratory-test.md, 1). Turns are small: the
   * particles keep on a plane, u = theta . (x - middle) along its normal, with x as it was at the start. Particles whose spin is prescribed
   * turn with it. The face has the particles' inertia and no other, and no damping.
   */
  class TurningFace
  {
  public:
    /** @param members of the grip, in the particles' order @throws base::InputError where they lie on a line */
    TurningFace(const Grip &grip, const std::vector<std::int32_t> &members, const Particles &particles, int dimension);

    /** Turn faster by the forces and moments that act on the members at t_n, for a time [s]. */
    void push(const std::vector<std::int32_t> &members, const Particles &particles, double time);
    /** What the turn adds to six rates of a member [m/s, rad/s]. */
    std::array<double, 6> rates(std::size_t member) const;

    Eigen::Vector2d slope_rate = Eigen::Vector2d::Zero(); ///< of theta [1/s]; part of the state

  private:
    int                          normal;
    std::array<bool, 2>          spins; ///< about the axes across: members turn with the face
    std::vector<Eigen::Vector2d> arms;  ///< [m]
    Eigen::Matrix2d              inverse_inertia;
  };
} // namespace dem
