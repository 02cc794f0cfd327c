#pragma once

#include "dem/kernels/kinematics.h"
#include "dem/kernels/link_pass.h"

#include <algorithm>
#include <type_traits>

/**
 * The link pass itself, for every policy. Only the two files that compile it include this, one for each dimension: together they
 * take longer than any other, side by side half as long.
 */
namespace dem::link_update
{
  enum class Damage
  {
    none,            ///< omega keeps its value
    normal,          ///< driven by the normal strain
    normal_and_shear ///< driven by normal and shear strain: the total shear strain is stored too
  };

  /** What the pass is compiled for. `contact`: no cohesion, deleted as soon as it opens. `periodic`: second ends are images. */
  template <int     dimension_,
            bool    rotations_,
            Damage  damage_,
            bool    sliding_,
            Mixture mixture_,
            bool    contact_,
            bool    periodic_>
  struct Policy
  {
    static constexpr int    dimension        = dimension_;
    static constexpr bool   rotations        = rotations_;
    static constexpr Damage damage           = damage_;
    static constexpr bool   sliding          = sliding_;
    static constexpr bool   equal_radii      = mixture_ == Mixture::equal;
    static constexpr bool   several_laws     = mixture_ == Mixture::materials;
    static constexpr bool   contact          = contact_;
    static constexpr bool   periodic         = periodic_;
    static constexpr int    shear_components = dimension == 3 ? 3 : 1;
    static constexpr int    stored_shears    = damage == Damage::normal_and_shear ? 2 : 1; ///< elastic, total
  };

  /** Differences and sums of the two ends' records of eight links, one pack per quantity. */
  struct Ends
  {
    Pack pose[8];       ///< branch (3) | sum of tau theta (3) | r_K - r_J | -
    Pack motion[8];     ///< branch increment (3) | sum of theta (3) | - -
    Pack half_twist[8]; ///< - - - | difference (first - second) of tau theta (3) | - -; unequal radii only
  };

  inline const Pack difference_and_sum([](auto lane) { return lane < 3 || lane > 5 ? -1.0 : 1.0; });

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
        ends.pose[lane]   = pose_K + signs * pose_J;
        ends.motion[lane] = load(motion + K) + signs * load(motion + J);
        if constexpr (P::periodic)
          {
            const std::size_t image = record_size * static_cast<std::size_t>(links.image[l + lane]);
            ends.pose[lane] += load(&particles.cell.offset[image]);
            ends.motion[lane] += load(&particles.cell.motion[image]);
          }
        if constexpr (P::rotations && !P::equal_radii)
          ends.half_twist[lane] = pose_J - pose_K;
      }
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
      return Pack(0.5) * (ends.pose[3 + c] + eccentric * ends.half_twist[3 + c]);
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

  /**
       * Force on the first end, half branch x force, eccentricity: what a particle needs of its link, as records.
       * @return the force, z only in space
       */
  template <typename P, typename Frame>
  BRECCIA_KERNEL Vec<Pack, 3> put_force(const Frame                                  &frame,
                                        const CpmResponse<Pack, P::shear_components> &r,
                                        const Pack                                   &area,
                                        const Pack                                   &eccentric,
                                        double                                       *record)
  {
    Pack out[8];
    for (auto &o : out)
      o = Pack(0.0);
    const Pack half_length = Pack(0.5) * frame.length;
    if constexpr (P::dimension == 3)
      {
        const Vec<Pack, 3> shear  = area * r.shear_stress;
        const Vec<Pack, 3> force  = (area * r.normal_stress) * frame.direction + shear;
        const Vec<Pack, 3> couple = half_length * cross(frame.direction, shear);
        for (int c = 0; c < 3; ++c)
          {
            out[c] = force[c];
            if constexpr (P::rotations)
              out[3 + c] = couple[c];
          }
      }
    else
      {
        const Pack normal = area * r.normal_stress, shear = area * r.shear_stress[0];
        out[0] = normal * frame.direction[0] - shear * frame.direction[1];
        out[1] = normal * frame.direction[1] + shear * frame.direction[0];
        if constexpr (P::rotations)
          out[5] = half_length * shear;
      }
    if constexpr (!P::equal_radii)
      out[6] = eccentric;
    const Vec<Pack, 3> force = {{out[0], out[1], out[2]}};
    transpose(out);
    for (int lane = 0; lane < pack_size; ++lane)
      store(out[lane], record + record_size * lane);
    return force;
  }

  /** What a block sums up while it goes through its links. */
  struct BlockSums
  {
    Pack     plastic_work{0.0}, damage_work{0.0};
    PackMask exhausted{false};
  };

  struct PeriodicBlockSums : BlockSums
  {
    Pack stress_moment[9] = {Pack(0.0), Pack(0.0), Pack(0.0), Pack(0.0), Pack(0.0),
                             Pack(0.0), Pack(0.0), Pack(0.0), Pack(0.0)}; ///< sum l (x) f, by rows
  };

  template <typename P>
  using Sums = std::conditional_t<P::periodic, PeriodicBlockSums, BlockSums>;

  template <typename P>
  using State = CpmState<Pack, P::shear_components>;

  template <typename P>
  BRECCIA_KERNEL void load_state(const LinkSet    &links,
                                 const std::size_t l,
                                 State<P>         &state,
                                 Vec<Pack, P::shear_components> (&shear)[P::stored_shears])
  {
    state.kappa  = load(&links.kappa[l]);
    state.damage = P::contact ? Pack(1.0) : load(&links.damage[l]);
    for (int c = 0; c < P::shear_components; ++c)
      {
        shear[0][c] = load(&links.elastic_shear[c][l]);
        if constexpr (P::stored_shears == 2)
          shear[1][c] = load(&links.total_shear[c][l]);
      }
  }

  template <typename P>
  BRECCIA_KERNEL void store_state(LinkSet          &links,
                                  const std::size_t l,
                                  const State<P>   &state,
                                  const State<P>   &before,
                                  const Vec<Pack, P::shear_components> (&shear)[P::stored_shears])
  {
    if constexpr (P::damage != Damage::none)
      if (any(state.kappa > before.kappa))
        {
          store(state.kappa, &links.kappa[l]);
          store(state.damage, &links.damage[l]);
        }
    for (int c = 0; c < P::shear_components; ++c)
      {
        store(state.elastic_shear[c], &links.elastic_shear[c][l]);
        if constexpr (P::stored_shears == 2)
          store(shear[1][c], &links.total_shear[c][l]);
      }
  }

  /**
       * What makes the law's sigma_T . d eps_p, with the stress after the return, into the same with the mean of the stresses before and
       * after the step: then the account balances to second order in the step, as the leap-frog work of the link forces does.
       */
  template <typename Constants, int m>
  BRECCIA_KERNEL Pack mean_stress_correction(const Constants    &law,
                                             const Vec<Pack, m> &trial,
                                             const Vec<Pack, m> &increment,
                                             const Vec<Pack, m> &after)
  {
    const Vec<Pack, m> before = trial - increment;
    return Pack(0.5 * law.G) * dot(before - after, trial - after);
  }

  /** Constants of eight links that may join other materials each. Of the second record only what the policy looks at. */
  template <typename P>
  BRECCIA_KERNEL CpmNumbers<Pack> gather_constants(const CpmTable &laws, const LinkSet &links, const std::size_t l)
  {
    Pack c[2][pack_size];
    for (int lane = 0; lane < pack_size; ++lane)
      {
        const double *record = laws.record_of(static_cast<std::size_t>(links.law[l + lane]));
        c[0][lane]           = load(record);
        if constexpr (P::damage != Damage::none)
          c[1][lane] = load(record + pack_size);
      }
    transpose(c[0]);
    if constexpr (P::damage != Damage::none)
      transpose(c[1]);
    else
      c[1][0] = c[1][1] = Pack(0.0);
    return {c[0][0], c[0][1], c[0][2], c[0][7], c[0][3],    c[0][4],
            c[0][5], c[1][0], c[1][1], c[0][6], laws[0].law}; // the shape of softening is one for all
  }

  /** Eight links: kinematics, law, force. @tparam Constants CpmConstants of all, or the numbers of each */
  template <typename P, typename Constants>
  BRECCIA_KERNEL void update_pack(LinkSet          &links,
                                  const Particles  &particles,
                                  const Constants  &law,
                                  const Pack       &signs,
                                  const std::size_t l,
                                  Sums<P>          &sums)
  {
    Ends ends;
    gather<P>(particles, links, l, signs, ends);

    State<P>                       state;
    Vec<Pack, P::shear_components> shear[P::stored_shears];
    load_state<P>(links, l, state, shear);
    const State<P> before    = state;
    const Pack     reference = load(&links.reference_length[l]), area = load(&links.area[l]);
    const Pack     inverse_reference = Pack(1.0) / reference;

    const auto branch_length = [&] {
      Pack squared = ends.pose[0] * ends.pose[0] + ends.pose[1] * ends.pose[1];
      if constexpr (P::dimension == 3)
        squared = squared + ends.pose[2] * ends.pose[2];
      return square_root(squared);
    };
    const Pack eccentric = P::equal_radii ? Pack(0.0) : eccentricity<P>(ends, branch_length());
    const auto frame     = advance_shear<P::rotations>(pair_motion<P>(ends, eccentric), inverse_reference, shear);
    const Pack strain    = (frame.length - reference) * inverse_reference;

    state.elastic_shear = shear[0];
    const Pack total_squared =
      P::stored_shears == 2 ? dot(shear[P::stored_shears - 1], shear[P::stored_shears - 1]) : Pack(0.0);
    constexpr bool damages  = P::damage != Damage::none;
    const auto     response = Cpm<damages, P::sliding>::update(law, strain, total_squared, state);
    store_state<P>(links, l, state, before, shear);
    const Vec<Pack, 3> force = put_force<P>(frame, response, area, eccentric, &links.force[record_size * l]);
    if constexpr (P::periodic)
      for (int i = 0; i < P::dimension; ++i)
        for (int j = 0; j < P::dimension; ++j)
          sums.stress_moment[3 * i + j] += ends.pose[i] * force[j];

    const Pack volume = area * reference;
    if constexpr (P::sliding)
      if (any(response.slides))
        {
          const Pack work =
            response.plastic_work + mean_stress_correction(law, shear[0], frame.increment, state.elastic_shear);
          // Below zero where one step reverses the stress: energy that the step made, not the link. The balance shows it.
          sums.plastic_work += volume * maximum(work, Pack(0.0));
        }
    if constexpr (P::damage == Damage::normal_and_shear)
      sums.damage_work += volume * response.damage_work;
    if constexpr (P::contact)
      sums.exhausted = sums.exhausted || (strain > Pack(0.0) && area > Pack(0.0));
    else if constexpr (damages)
      sums.exhausted =
        sums.exhausted || (state.kappa > Pack(law.kappa_broken) && strain > Pack(0.0) && area > Pack(0.0));
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
  void update_block(LinkSet &links, const Particles &particles, const CpmTable &laws, const std::size_t block)
  {
    Sums<P>             sums;
    const Pack          signs = difference_and_sum;
    const CpmConstants &only  = laws[0];
    const std::size_t   begin = block * links_per_block, end = std::min(begin + links_per_block, links.first.size());
    for (std::size_t l = begin; l < end; l += pack_size)
      {
        prefetch_second_ends(links, particles, l + prefetch_distance);
        if constexpr (P::several_laws)
          update_pack<P>(links, particles, gather_constants<P>(laws, links, l), signs, l, sums);
        else
          update_pack<P>(links, particles, only, signs, l, sums);
      }

    LinkBlockAccount &account = links.accounts[block];
    if constexpr (P::sliding)
      account.plastic_work += stdx::reduce(sums.plastic_work);
    if constexpr (P::damage == Damage::normal_and_shear)
      account.damage_work += stdx::reduce(sums.damage_work);
    account.exhausted = any(sums.exhausted);
    if constexpr (P::periodic)
      for (int c = 0; c < 9; ++c)
        links.stress_moments[stress_record * block + c] = stdx::reduce(sums.stress_moment[c]);
  }

  template <typename P>
  void link_pass(LinkSet &links, const Particles &particles, const CpmTable &laws)
  {
    const auto blocks = static_cast<std::ptrdiff_t>(links.blocks());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t b = 0; b < blocks; ++b)
      update_block<P>(links, particles, laws, static_cast<std::size_t>(b));
  }

  /** Turn a run-time choice into a compile-time one: continue with std::true_type or std::false_type. */
  template <typename Continue>
  auto choose(const bool choice, Continue &&next)
  {
    return choice ? next(std::true_type{}) : next(std::false_type{});
  }

  /** The same of a mixture. */
  template <typename Continue>
  auto choose(const Mixture mixture, Continue &&next)
  {
    if (mixture == Mixture::equal)
      return next(std::integral_constant<Mixture, Mixture::equal>{});
    return mixture == Mixture::radii ? next(std::integral_constant<Mixture, Mixture::radii>{}) :
                                       next(std::integral_constant<Mixture, Mixture::materials>{});
  }

  template <int dimension, bool contact, Damage damage>
  LinkPass select(const Physics &physics, const Mixture mixture)
  {
    return choose(physics.rotations, [&](auto rotations) {
      return choose(physics.friction, [&](auto sliding) {
        return choose(mixture, [&](auto particles) {
          return choose(physics.periodic, [&](auto periodic) -> LinkPass {
            return link_pass<Policy<dimension, rotations, damage, sliding, particles, contact, periodic>>;
          });
        });
      });
    });
  }

  template <int dimension>
  LinkPass select_bonds(const Physics &physics, const Mixture mixture, const bool shear_damages)
  {
    if (!physics.damage)
      return select<dimension, false, Damage::none>(physics, mixture);
    return shear_damages ? select<dimension, false, Damage::normal_and_shear>(physics, mixture) :
                           select<dimension, false, Damage::normal>(physics, mixture);
  }

  template <int dimension>
  LinkPass select_contacts(const Physics &physics, const Mixture mixture)
  {
    return select<dimension, true, Damage::none>(physics, mixture);
  }
} // namespace dem::link_update
