#pragma once

#include "dem/core/apart.h"
#include "dem/core/simd.h"
#include "dem/core/streaming.h"
#include "dem/core/vector.h"
#include "dem/kernels/half_records.h"
#include "dem/kernels/link_update_types.h"

/** What the link pass writes for the particles. @tparam P see dem/kernels/link_policy.h */
namespace dem::link_update
{
  /** Eight packs, one per quantity, as the records of eight links. @param streams see put() */
  BRECCIA_KERNEL void put_records(Pack (&out)[8], double *record, const bool streams)
  {
    transpose(out);
    if (streams)
      {
        double *const lines = apart(record);
        for (int lane = 0; lane < pack_size; ++lane)
          stream(out[lane], lines + record_size * lane);
      }
    else
      for (int lane = 0; lane < pack_size; ++lane)
        store(out[lane], record + record_size * lane);
  }

  /**
   * Force on the first end, half branch x force, eccentricity, and in the plane the moment at the contact point: what a particle needs
   * of its link, as records (doc/theory/links.md, 2).
   * @param streams see put()
   * @return the force, z only in space
   */
  template <typename P, typename Frame>
  BRECCIA_KERNEL Vec<Pack, 3> put_force(const Frame                      &frame,
                                        const LinkForce<Pack, P::across> &answer,
                                        const Pack                       &eccentric,
                                        double                           *record,
                                        const bool                        streams)
  {
    Pack out[8];
    for (auto &o : out)
      o = Pack(0.0);
    const Pack half_length = Pack(0.5) * frame.length;
    if constexpr (P::dimension == 3)
      {
        const Vec<Pack, 3> force  = multiply_add(answer.normal, frame.direction, answer.shear);
        const Vec<Pack, 3> couple = half_length * cross(frame.direction, answer.shear);
        for (int c = 0; c < 3; ++c)
          {
            out[c] = force[c];
            if constexpr (P::rotations)
              out[3 + c] = couple[c];
          }
      }
    else
      {
        out[0] = multiply_subtract(answer.normal, frame.direction[0], answer.shear[0] * frame.direction[1]);
        out[1] = multiply_add(answer.normal, frame.direction[1], answer.shear[0] * frame.direction[0]);
        if constexpr (P::rotations)
          out[5] = half_length * answer.shear[0];
        if constexpr (P::moment)
          out[7] = answer.bending_moment[0];
      }
    if constexpr (!P::equal_radii)
      out[6] = eccentric;
    const Vec<Pack, 3> force = {{out[0], out[1], out[2]}};
    put_records(out, record, streams);
    return force;
  }

  /** Moment on the first end at the contact point, in space, as half records. */
  template <typename Frame>
  BRECCIA_KERNEL void put_moment(const Frame &frame, const LinkForce<Pack, 3> &answer, double *record)
  {
    Pack out[3];
    for (int c = 0; c < 3; ++c)
      out[c] = multiply_add(answer.twisting_moment, frame.direction[c], answer.bending_moment[c]);
    store_half_records(out, record);
  }
} // namespace dem::link_update
