#pragma once

#include "dem/kernels/link_ends.h"
#include "dem/kernels/link_history.h"
#include "dem/kernels/link_policy.h"
#include "dem/kernels/link_records.h"

#include <algorithm>
#include <type_traits>

/**
 * The link pass itself, for every law and policy. Only the sources in which a law's passes are compiled include this; a law with many
 * variants has one for each dimension, which side by side take half as long.
 */
namespace dem::link_update
{
  /** What a block sums up while it goes through its links. */
  struct BlockSums
  {
    LinkWork<Pack> work;
    PackMask       event{false};
    Pack stress_moment[9] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}; ///< sum l (x) f by rows; only if periodic
  };

  /** Constants of eight links that may join other materials each. */
  template <typename Law>
  BRECCIA_KERNEL auto gather_constants(const LinkLawOf<Law> &laws, const LinkSet &links, const std::size_t l)
  {
    Pack c[Law::records][pack_size];
    for (int lane = 0; lane < pack_size; ++lane)
      {
        const double *record = laws.record_of(static_cast<std::size_t>(links.pair[l + lane]));
        for (int r = 0; r < Law::records; ++r)
          c[r][lane] = load(record + pack_size * r);
      }
    for (int r = 0; r < Law::records; ++r)
      transpose(c[r]);
    return Law::gathered(c, laws.constants(0));
  }

  /** Where the links lie, and their shears at the end of the step; of laws without moments. */
  template <typename P>
  BRECCIA_KERNEL auto advance(const Ends                       &ends,
                              const Pack                       &eccentric,
                              const Pack                       &reference,
                              const Pack                       &inverse_reference,
                              typename P::template State<Pack> &state)
  {
    if constexpr (P::first_order)
      {
        const Pack ratio = P::Law::arm_ratio(state) * reference / branch_length<P>(ends);
        return advance_shear_first_order(pair_motion<P>(ends, eccentric / ratio), ratio, inverse_reference,
                                         state.shear);
      }
    else
      return advance_shear<P::rotations>(pair_motion<P>(ends, eccentric), inverse_reference, state.shear);
  }

  /** Lengths and directions of a frame, as the law takes them (doc/theory/links.md, 2). @param per_second one over the length of the step [1/s] */
  template <typename P, typename Frame>
  BRECCIA_KERNEL LinkMotion<Pack, P::across> stretch_of(
    const Frame &frame, const Pack &reference, const Pack &inverse_reference, const Pack &area, const double per_second)
  {
    LinkMotion<Pack, P::across> motion;
    motion.strain            = (frame.length - reference) * inverse_reference;
    motion.strain_before     = (frame.length_before - reference) * inverse_reference;
    motion.length            = frame.length;
    motion.reference         = reference;
    motion.inverse_reference = inverse_reference;
    motion.area              = area;
    if constexpr (P::Law::viscous)
      motion.per_second = per_second;
    return motion;
  }

  /** Law and forces of eight links that have moved. @param rests the resting shear of all is zero, and need not be written */
  template <typename P, typename Constants, typename Frame>
  BRECCIA_KERNEL void answer_pack(LinkSet                                &links,
                                  const HistoryColumns<P>                &history,
                                  const Constants                        &law,
                                  const std::size_t                       l,
                                  const Ends                             &ends,
                                  const Pack                             &eccentric,
                                  const Frame                            &frame,
                                  const LinkMotion<Pack, P::across>      &motion,
                                  const typename P::template State<Pack> &before,
                                  const bool                              rests,
                                  typename P::template State<Pack>       &state,
                                  BlockSums                              &sums)
  {
    const auto answer = P::Law::update(law, motion, state, sums.work);
    store_history<P>(history, l, before, state, rests);
    const Vec<Pack, 3> force = put_force<P>(frame, answer, eccentric, &links.force[record_size * l], links.streams);
    if constexpr (P::moment && P::dimension == 3)
      put_moment(frame, answer, &links.moment[half_record_size * l]);
    if (links.periodic)
      for (int i = 0; i < P::dimension; ++i)
        for (int j = 0; j < P::dimension; ++j)
          sums.stress_moment[3 * i + j] = multiply_add(ends.pose[i], force[j], sums.stress_moment[3 * i + j]);
    sums.event = sums.event || (answer.event && motion.area > Pack(0.0));
  }

  /** Eight links: kinematics, law, force. @tparam Constants of all, or the numbers of each */
  template <typename P, typename Constants>
  BRECCIA_KERNEL void update_pack(LinkSet                 &links,
                                  const HistoryColumns<P> &history,
                                  const Particles         &particles,
                                  const Constants         &law,
                                  const Pack              &signs,
                                  const std::size_t        l,
                                  BlockSums               &sums)
  {
    using State = typename P::template State<Pack>;
    Ends ends;
    gather<P>(particles, links, l, signs, ends);

    State state;
    load_history<P>(history, l, state);
    if constexpr (P::Law::has_rows)
      state.rows = {history.rows, l};
    const State before    = state;
    const Pack  reference = load(&links.reference_length[l]), area = load(&links.area[l]);
    const Pack  inverse_reference = Pack(1.0) / reference;
    const Pack  eccentric         = P::equal_radii ? Pack(0.0) : eccentricity<P>(ends, branch_length<P>(ends));
    if constexpr (P::moment && P::dimension == 3)
      {
        const auto              pair = moment_pair_motion<P>(ends, eccentric);
        const TurningLink<Pack> frame(pair, inverse_reference);
        auto                    motion = stretch_of<P>(frame, reference, inverse_reference, area, links.per_second);
        motion.shear_increment         = frame.across(frame.slip);
        motion.bending_increment       = frame.across(pair.turned);
        motion.twist_increment         = frame.along(pair.turned);
        bool rests                     = false;
        if constexpr (P::may_rest)
          rests = !any(P::Law::acts(state, motion.strain));
        for (int i = 0; i < State::shears; ++i)
          if (!rests || !is_resting_shear<P>(i))
            state.shear[i] = frame.carried(state.shear[i], frame.slip);
        for (int i = 0; i < State::bendings; ++i)
          state.bending[i] = frame.carried(state.bending[i], pair.turned);
        for (int i = 0; i < State::axes; ++i)
          state.axis[i] = frame.turned(state.axis[i]);
        if constexpr (State::axes > 0)
          motion.direction = frame.direction;
        answer_pack<P>(links, history, law, l, ends, eccentric, frame, motion, before, rests, state, sums);
      }
    else
      {
        const auto frame         = advance<P>(ends, eccentric, reference, inverse_reference, state);
        auto       motion        = stretch_of<P>(frame, reference, inverse_reference, area, links.per_second);
        motion.shear_increment   = frame.increment;
        motion.bending_increment = {};
        motion.twist_increment   = Pack(0.0);
        if constexpr (P::Law::directed)
          motion.direction = frame.direction;
        if constexpr (State::axes >
                      0) // of particles that do not turn: by the smallest rotation, to second order in the step
          {
            motion.direction = frame.direction;
            for (int i = 0; i < State::axes; ++i)
              {
                const auto lies = across(frame.direction, state.axis[i]);
                state.axis[i]   = (Pack(1.0) / square_root(maximum(dot(lies, lies), Pack(0.25)))) * lies;
              }
          }
        if constexpr (P::moment)
          {
            motion.bending_increment = {{ends.motion[5]}};
            for (int i = 0; i < State::bendings; ++i)
              state.bending[i] = state.bending[i] + motion.bending_increment;
          }
        answer_pack<P>(links, history, law, l, ends, eccentric, frame, motion, before, false, state, sums);
      }
  }

  /** Links ahead of the present one whose second ends are fetched: measured best between 64 and 128 on 10^6 particles. */
  constexpr std::size_t prefetch_distance = 64;

  /** First ends follow the links' order and come by themselves; second ends lie all over the particle columns. */
  BRECCIA_KERNEL void prefetch_second_ends(const LinkSet &links, const Particles &particles, const std::size_t l)
  {
    if (l >= links.second.size())
      return;
    for (int lane = 0; lane < pack_size; ++lane)
      {
        const std::size_t K = record_size * static_cast<std::size_t>(links.second[l + lane]);
        __builtin_prefetch(&particles.pose[K]);
        __builtin_prefetch(&particles.motion[K]);
      }
  }

  template <typename P>
  void update_block(LinkSet                          &links,
                    const Particles                  &particles,
                    const LinkLawOf<typename P::Law> &laws,
                    const LinkPart                   &part,
                    const std::size_t                 first_column)
  {
    BlockSums               sums;
    const HistoryColumns<P> history(links, first_column);
    const Pack              signs = difference_and_sum;
    const auto             &only  = laws.constants(0);
    for (std::size_t l = part.begin; l < part.end; l += pack_size)
      {
        prefetch_second_ends(links, particles, l + prefetch_distance);
        if constexpr (P::several_pairs)
          update_pack<P>(links, history, particles, gather_constants(laws, links, l), signs, l, sums);
        else
          update_pack<P>(links, history, particles, only, signs, l, sums);
      }

    if (links.streams)
      finish_streaming();
    if (!part.own)
      return;
    const std::size_t block   = part.block;
    LinkBlockAccount &account = links.accounts[block];
    account.friction += sum_of(sums.work.friction);
    account.damage += sum_of(sums.work.damage);
    account.released += sum_of(sums.work.released);
    if constexpr (P::Law::viscous)
      account.viscous += sum_of(sums.work.viscous);
    account.event = any(sums.event);
    if (links.periodic)
      for (int c = 0; c < 9; ++c)
        links.stress_moments[stress_record * block + c] = sum_of(sums.stress_moment[c]);
  }

  template <typename P>
  void link_pass(LinkSet &links, const Particles &particles, const LinkLaw &law, const LinkLines &lines)
  {
    const auto &laws  = static_cast<const LinkLawOf<typename P::Law> &>(law);
    const auto  parts = links.parts_between(lines);
    if (parts.second - parts.first ==
        1) // to make a team of threads, even of one, takes longer than the links of few particles
      return update_block<P>(links, particles, laws, links.part(parts.first), lines.first_column);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = parts.first; p < parts.second; ++p)
      update_block<P>(links, particles, laws, links.part(p), lines.first_column);
  }

  /** A mixture as a constant of the loop. */
  template <typename Continue>
  auto choose(const Mixture mixture, Continue &&next)
  {
    if (mixture == Mixture::equal)
      return next(std::integral_constant<Mixture, Mixture::equal>{});
    return mixture == Mixture::radii ? next(std::integral_constant<Mixture, Mixture::radii>{}) :
                                       next(std::integral_constant<Mixture, Mixture::materials>{});
  }

  /** Without rotations equal radii would save one division of a link: they take the pass of any radii, with the same bits. */
  template <typename Law, int dimension>
  LinkPass select(const bool rotates, const Mixture mixture)
  {
    if (rotates)
      return choose(mixture,
                    [](auto particles) -> LinkPass { return link_pass<Policy<Law, dimension, true, particles>>; });
    return mixture == Mixture::materials ? link_pass<Policy<Law, dimension, false, Mixture::materials>> :
                                           link_pass<Policy<Law, dimension, false, Mixture::radii>>;
  }
} // namespace dem::link_update

namespace dem
{
  template <typename Law>
  LinkPass link_pass_in_plane(const bool rotations, const Mixture mixture)
  {
    return link_update::select<Law, 2>(rotations, mixture);
  }

  template <typename Law>
  LinkPass link_pass_in_space(const bool rotations, const Mixture mixture)
  {
    return link_update::select<Law, 3>(rotations, mixture);
  }
} // namespace dem
