#pragma once

#include "dem/core/streaming.h"
#include "dem/kernels/kinematics.h"
#include "dem/kernels/particle_pass.h"

/**
 * The leap-frog step of one particle by the force that acts on it, however that was summed up (doc/theory/integration.md, 1 and 2).
 */
namespace dem::leap_frog
{
  /** tan(t/2)/(t/2) of a rotation vector's squared length; a short series for the angles of a stable step. */
  BRECCIA_KERNEL double arm_stretch(const double angle_squared)
  {
    if (angle_squared <= series_angle_squared) // remainder below 1e-16
      {
        const double inner = multiply_add(angle_squared, 17.0 / 20160, 1.0 / 120);
        return multiply_add(angle_squared, multiply_add(angle_squared, inner, 1.0 / 12), 1.0);
      }
    return half_tangent_factor(exact_rotation_coefficients(angle_squared), angle_squared);
  }

  /** Constant packs, one lane per component of a particle's record. */
  struct Lanes
  {
    Pack keep_pose, translates, rotates; ///< what of a pose stays, and which lanes are displaced and turned

    BRECCIA_KERNEL Lanes()
      : keep_pose(pack_of([](const int i) { return i < 3 || i == 6 ? 1.0 : 0.0; }))
      , translates(pack_of([](const int i) { return i < 3 ? 1.0 : 0.0; }))
      , rotates(pack_of([](const int i) { return i >= 3 && i < 6 ? 1.0 : 0.0; }))
    {
    }
  };

  /** Sums over a block, one lane per component. */
  struct Sums
  {
    Pack damping_before{0.0}, damping_after{0.0}, pushing_before{0.0}, pushing_after{0.0}, kinetic{0.0}, fastest{0.0};
  };

  template <bool damped>
  BRECCIA_KERNEL Pack damp(const Pack &acceleration, const Pack &velocity, const Pack &half_step, const Pack &damping)
  {
    if constexpr (!damped)
      return acceleration;
    const Pack ahead = acceleration * multiply_add(half_step, acceleration, velocity);
    return acceleration *
           (Pack(1.0) - select(ahead > Pack(0.0), damping, select(ahead < Pack(0.0), Pack(0.0) - damping, Pack(0.0))));
  }

  /** Velocity G x of the cell at a particle. */
  BRECCIA_KERNEL Pack cell_velocity(const Particles &p, const std::size_t at)
  {
    const double *rate = p.cell.rate.data(), *x = &p.pose[at];
    const Pack    in_plane = multiply_add(Pack(x[1]), load(rate + record_size), Pack(x[0]) * load(rate));
    return multiply_add(Pack(x[2]), load(rate + 2 * record_size), in_plane);
  }

  /** Constant packs of a step's length: half of the one before t_n, half of the one after, their sum, and the drift. */
  struct Lengths
  {
    Pack half_before, half_after, kick, drift;

    explicit Lengths(const StepHalves &step)
      : half_before(step.before)
      , half_after(step.after)
      , kick(step.before + step.after)
      , drift(2 * step.after)
    {
    }
  };

  /** Leap-frog step of one particle, all components at once. */
  template <bool damped, bool periodic, bool pushed>
  BRECCIA_KERNEL void integrate(Particles        &p,
                                const std::size_t i,
                                const Pack       &force,
                                const Lanes      &lanes,
                                const Lengths    &step,
                                const Pack       &damping,
                                const bool        streams,
                                Sums             &sums)
  {
    const std::size_t at           = record_size * i;
    const Pack        velocity     = load(&p.velocity[at]);
    const Pack        inverse_mass = load(&p.inverse_mass[at]);
    const Pack        mass = multiply_add(Pack(p.mass[i]), lanes.translates, Pack(p.inertia[i]) * lanes.rotates);
    const Pack        free = force * inverse_mass;
    const Pack        acceleration = damp<damped>(free, velocity, step.half_before, damping);
    const Pack        next         = multiply_add(step.kick, acceleration, velocity);
    const Pack        displacement = step.drift * next;

    const Vec<double, 3> rotation{{displacement[3], displacement[4], displacement[5]}};
    const double         stretch = arm_stretch(dot(rotation, rotation));
    Pack                 moved   = displacement;
    if constexpr (periodic)
      moved = multiply_add(step.drift, cell_velocity(p, at), moved);
    const Pack pose = multiply_add(moved, multiply_add(Pack(stretch), lanes.rotates, lanes.translates),
                                   load(&p.pose[at]) * lanes.keep_pose);
    store(pose, &p.pose[at]);
    store(next, &p.velocity[at]);
    put(moved, &p.motion[at], streams);
    put(force, &p.force[at], streams);

    sums.fastest = maximum(sums.fastest, displacement * displacement * lanes.translates);
    sums.kinetic = multiply_add(Pack(0.5) * mass * velocity, next, sums.kinetic);
    if constexpr (damped)
      {
        const Pack slowed   = acceleration - free; // zero where motion is prescribed
        sums.damping_before = multiply_add(step.half_before * mass * slowed, velocity, sums.damping_before);
        sums.damping_after  = multiply_add(step.half_after * mass * slowed, next, sums.damping_after);
      }
    if constexpr (pushed)
      {
        const Pack push     = load(&p.pushed[at]);
        sums.pushing_before = multiply_add(step.half_before * push, velocity, sums.pushing_before);
        sums.pushing_after  = multiply_add(step.half_after * push, next, sums.pushing_after);
      }
  }
} // namespace dem::leap_frog
