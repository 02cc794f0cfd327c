#pragma once

#include "dem/core/apart.h"
#include "dem/kernels/kinematics.h"
#include "dem/kernels/moment_kinematics.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

/** What the link pass reads of the two ends of eight links. @tparam P see dem/kernels/link_policy.h */
namespace dem::link_update
{
  /** Differences and sums of the two ends' records of eight links, one pack per quantity. */
  struct Ends
  {
    Pack pose[8];       ///< branch (3) | sum of tau theta (3) | r_K - r_J | -
    Pack motion[8];     ///< branch increment (3) | sum of theta, with moments difference (second - first) (3) | - -
    Pack half_twist[8]; ///< - - - | difference (first - second) of tau theta (3) | - -; unequal radii only
  };

  inline const Pack difference_and_sum = pack_of([](const int lane) { return lane < 3 || lane > 5 ? -1.0 : 1.0; });

  /** Second ends are images of particles. */
  BRECCIA_KERNEL void reach_to_images(const Particles &particles, const LinkSet &links, const std::size_t l, Ends &ends)
  {
    const std::int32_t *images = apart(&links.image[l]);
    for (int lane = 0; lane < pack_size; ++lane)
      {
        const std::size_t image = record_size * static_cast<std::size_t>(images[lane]);
        ends.pose[lane] += load(&particles.cell.offset[image]);
        ends.motion[lane] += load(&particles.cell.motion[image]);
      }
  }

  template <typename P>
  BRECCIA_KERNEL void
  gather(const Particles &particles, const LinkSet &links, const std::size_t l, const Pack &signs, Ends &ends)
  {
    const std::int32_t *first = &links.first[l], *second = &links.second[l];
    const double       *pose = particles.pose.data(), *motion = particles.motion.data();
    for (int lane = 0; lane < pack_size; ++lane)
      {
        const std::size_t J = record_size * static_cast<std::size_t>(first[lane]),
                          K = record_size * static_cast<std::size_t>(second[lane]);
        const Pack pose_J = load(pose + J), pose_K = load(pose + K);
        ends.pose[lane] = multiply_add(signs, pose_J, pose_K);
        if constexpr (P::moment)
          ends.motion[lane] = load(motion + K) - load(motion + J);
        else
          ends.motion[lane] = multiply_add(signs, load(motion + J), load(motion + K));
        if constexpr (P::rotations && !P::equal_radii)
          ends.half_twist[lane] = pose_J - pose_K;
      }
    if (links.periodic)
      reach_to_images(particles, links, l, ends);
    transpose(ends.pose);
    transpose(ends.motion);
    if constexpr (P::rotations && !P::equal_radii)
      transpose(ends.half_twist);
  }

  /** (r_J - r_K)/L, by which the contact point lies off the middle of the branch; arms are (1 +- this) L/2. */
  template <typename P>
  BRECCIA_KERNEL Pack eccentricity(const Ends &ends, const Pack &length)
  {
    if constexpr (P::equal_radii)
      return Pack(0.0);
    else
      return (Pack(0.0) - ends.pose[6]) / length;
  }

  template <typename P>
  BRECCIA_KERNEL Pack arm_rotation(const Ends &ends, const int c, const Pack &eccentric)
  {
    if constexpr (P::equal_radii)
      return Pack(0.5) * ends.pose[3 + c];
    else
      return Pack(0.5) * multiply_add(eccentric, ends.half_twist[3 + c], ends.pose[3 + c]);
  }

  template <typename P>
  BRECCIA_KERNEL auto pair_motion(const Ends &ends, const Pack &eccentric)
  {
    if constexpr (P::dimension == 3)
      {
        PairMotion<Pack> m;
        for (int c = 0; c < 3; ++c)
          {
            m.branch[c]    = ends.pose[c];
            m.increment[c] = ends.motion[c];
            if constexpr (P::rotations)
              {
                m.mean_rotation[c] = Pack(0.5) * ends.motion[3 + c];
                m.arm_rotation[c]  = arm_rotation<P>(ends, c, eccentric);
              }
          }
        return m;
      }
    else
      return PlanePairMotion<Pack>{
        {{ends.pose[0], ends.pose[1]}}, {{ends.motion[0], ends.motion[1]}}, arm_rotation<P>(ends, 2, eccentric)};
  }

  /** Motion in space of pairs whose links carry moments. */
  template <typename P>
  BRECCIA_KERNEL MomentPairMotion<Pack> moment_pair_motion(const Ends &ends, const Pack &eccentric)
  {
    MomentPairMotion<Pack> m;
    for (int c = 0; c < 3; ++c)
      {
        m.branch[c]       = ends.pose[c];
        m.increment[c]    = ends.motion[c];
        m.arm_rotation[c] = arm_rotation<P>(ends, c, eccentric);
        m.spin[c]         = Pack(0.5) * ends.pose[3 + c];
        m.turned[c]       = ends.motion[3 + c];
      }
    return m;
  }

  template <typename P>
  BRECCIA_KERNEL Pack branch_length(const Ends &ends)
  {
    Vec<Pack, P::dimension> branch;
    for (int c = 0; c < P::dimension; ++c)
      branch[c] = ends.pose[c];
    return square_root(dot(branch, branch));
  }
} // namespace dem::link_update
