#include "dem/kernels/particle_pass.h"

#include "dem/kernels/half_records.h"
#include "dem/kernels/leap_frog.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    /** Constant packs of the gathering, one lane per component of a particle's record. */
    struct Lanes
    {
      Pack own_sign, other_sign; ///< how a link's record counts at its first and at its second end
      Pack own_arm, other_arm;   ///< and how its eccentricity changes that: arms are (1 +- e) L/2
      Pack all_but_last;

      Lanes()
        : own_sign(pack_of([](const int i) { return i == 6 ? 0.0 : 1.0; }))
        , other_sign(pack_of([](const int i) { return i == 6         ? 0.0 :
                                                      i > 2 && i < 6 ? 1.0 :
                                                                       -1.0; }))
        , own_arm(pack_of([](const int i) { return i >= 3 && i < 6 ? 1.0 : 0.0; }))
        , other_arm(pack_of([](const int i) { return i >= 3 && i < 6 ? -1.0 : 0.0; }))
        , all_but_last(pack_of([](const int i) { return i < 7 ? 1.0 : 0.0; }))
      {
      }
    };

    /** Add a link's record to a sum, as it counts at one of its ends. */
    template <bool equal_radii>
    BRECCIA_KERNEL void add(const double *record, const Pack &sign, const Pack &arm, Pack &sum)
    {
      const Pack weight = equal_radii ? sign : multiply_add(Pack(record[6]), arm, sign);
      sum               = multiply_add(weight, load(record), sum);
    }

    /** Go through the links whose first end is a particle: line after line where all links obey one law. */
    template <typename Use>
    BRECCIA_KERNEL void each_own_link(const LinkSet &links, const std::size_t i, const Use &use)
    {
      if (links.owned.empty())
        for (std::int32_t l = links.own_begin[i]; l < links.own_begin[i + 1]; ++l)
          use(static_cast<std::size_t>(l));
      else
        for (std::int32_t o = links.own_begin[i]; o < links.own_begin[i + 1]; ++o)
          use(links.own(o));
    }

    /**
     * How far ahead of the present one records are fetched, by links, entries of `others`, and particles: measured on 10^6 particles
     * (doc/theory/numbers.md, 3). Processors fetch rows of lines by themselves, but mostly not past a page of 4 KiB, which is 64 records.
     */
    constexpr std::size_t own_ahead = 96, others_ahead = 64, particles_ahead = 16;

    /** Fetch a record of a link, and of its moment if there is one, that will be added up soon. */
    template <bool moments_apart>
    BRECCIA_KERNEL void fetch(const LinkSet &links, const std::size_t link)
    {
      __builtin_prefetch(links.force.data() + record_size * link);
      if constexpr (moments_apart)
        __builtin_prefetch(links.moment.data() + half_record_size * link);
    }

    /** Fetch what moves a particle. */
    BRECCIA_KERNEL void fetch(const Particles &particles, const std::size_t i)
    {
      for (const base::Column *records : {&particles.pose, &particles.velocity, &particles.inverse_mass})
        __builtin_prefetch(records->data() + record_size * i);
    }

    /**
     * Add what the links of a set do to a particle, and with moments_apart the moments at their contact points: what a link does to its
     * first end, it does to its second the other way round.
     */
    template <bool equal_radii, bool moments_apart, bool ahead>
    BRECCIA_KERNEL void
    add_links(const LinkSet &links, const std::size_t i, const Lanes &lanes, Pack &sum, HalfPack &moments)
    {
      const double *force = links.force.data(), *moment = links.moment.data();
      each_own_link(links, i, [&](const std::size_t link) {
        if constexpr (ahead)
          if (link + own_ahead < links.count)
            fetch<moments_apart>(links, link + own_ahead);
        add<equal_radii>(force + record_size * link, lanes.own_sign, lanes.own_arm, sum);
        if constexpr (moments_apart)
          moments += load_half(moment + half_record_size * link);
      });
      const std::size_t end = static_cast<std::size_t>(links.other_begin[i + 1]), all = links.others.size();
      for (auto o = static_cast<std::size_t>(links.other_begin[i]); o < end; ++o)
        {
          const auto link = static_cast<std::size_t>(links.others[o]);
          if constexpr (ahead)
            if (o + others_ahead < all)
              fetch<moments_apart>(links, static_cast<std::size_t>(links.others[o + others_ahead]));
          add<equal_radii>(force + record_size * link, lanes.other_sign, lanes.other_arm, sum);
          if constexpr (moments_apart)
            moments -= load_half(moment + half_record_size * link);
        }
    }

    /** Of a set that may carry moments or not. */
    template <bool equal_radii, bool moments, bool ahead>
    BRECCIA_KERNEL void
    add_set(const LinkSet &links, const std::size_t i, const Lanes &lanes, Pack &sum, HalfPack &moment)
    {
      if constexpr (moments)
        if (links.moments_apart)
          return add_links<equal_radii, true, ahead>(links, i, lanes, sum, moment);
      add_links<equal_radii, false, ahead>(links, i, lanes, sum, moment);
    }

    /** With the moments at contact points: of links in the plane they stand last in their records, of those in space apart. */
    BRECCIA_KERNEL Pack with_moments(const Pack &force, const HalfPack &apart, const Lanes &lanes)
    {
      return multiply_add(force, lanes.all_but_last, last_at_rotations(force)) + at_rotations(apart);
    }

    /** What a step does to particles, the same for all of them. */
    struct StepOfPass
    {
      StepOfPass(const StepHalves &halves, const double damping, const Eigen::Vector3d &gravity, const bool streams)
        : lengths(halves)
        , coefficient(damping)
        , fall(pack_of([&](const int lane) { return lane < 3 ? gravity[lane] : 0.0; }))
        , streams(streams)
      {
      }

      const Lanes              lanes;
      const leap_frog::Lanes   moving;
      const leap_frog::Lengths lengths;
      const Pack               coefficient, fall;
      const bool               streams;
    };

    /** Add up what acts on a particle, and move it. @tparam ahead fetch what comes: links do not stay in the caches */
    template <bool with_contacts, bool damped, bool equal_radii, bool moments, Surroundings surroundings, bool ahead>
    BRECCIA_KERNEL void move_particle(Particles          &particles,
                                      const std::size_t   i,
                                      const LinkSet      &bonds,
                                      const LinkSet      *contacts,
                                      const base::Column &surfaces,
                                      const StepOfPass   &step,
                                      leap_frog::Sums    &sums)
    {
      if constexpr (ahead)
        if (i + particles_ahead < particles.count)
          fetch(particles, i + particles_ahead);
      Pack     force(0.0);
      HalfPack moment(0.0);
      add_set<equal_radii, moments, ahead>(bonds, i, step.lanes, force, moment);
      if constexpr (with_contacts)
        add_set<equal_radii, moments, ahead>(*contacts, i, step.lanes, force, moment);
      if constexpr (moments)
        force = with_moments(force, moment, step.lanes);
      constexpr bool touched = surroundings == Surroundings::touched;
      constexpr bool pushed  = surroundings == Surroundings::pushed || touched;
      if constexpr (surroundings == Surroundings::weight || pushed)
        force = multiply_add(Pack(particles.mass[i]), step.fall, force);
      if constexpr (touched)
        force += load(&surfaces[record_size * i]);
      if constexpr (pushed)
        force += load(&particles.pushed[record_size * i]);
      leap_frog::integrate<damped, surroundings == Surroundings::periodic, pushed>(
        particles, i, force, step.moving, step.lengths, step.coefficient, step.streams, sums);
    }

    template <bool with_contacts, bool damped, bool equal_radii, bool moments, Surroundings surroundings>
    void particle_pass(Particles                         &particles,
                       const LinkSet                     &bonds,
                       const LinkSet                     *contacts,
                       const base::Column                &surfaces,
                       const StepHalves                  &halves,
                       const double                       damping,
                       const Eigen::Vector3d             &gravity,
                       const ParticleBlocks              &blocks,
                       std::vector<ParticleBlockAccount> &accounts)
    {
      const auto first = static_cast<std::ptrdiff_t>(blocks.begin), last = static_cast<std::ptrdiff_t>(blocks.end);
      const bool ahead = bonds.fetches_ahead || (with_contacts && contacts->fetches_ahead);
#pragma omp parallel for schedule(static)
      for (std::ptrdiff_t b = first; b < last; ++b)
        {
          const StepOfPass  step(halves, damping, gravity, bonds.streams);
          leap_frog::Sums   sums;
          const std::size_t begin = static_cast<std::size_t>(b) * particles_per_block,
                            end   = std::min(begin + particles_per_block, particles.count);
          if (ahead)
            for (std::size_t i = begin; i < end; ++i)
              move_particle<with_contacts, damped, equal_radii, moments, surroundings, true>(
                particles, i, bonds, contacts, surfaces, step, sums);
          else
            for (std::size_t i = begin; i < end; ++i)
              move_particle<with_contacts, damped, equal_radii, moments, surroundings, false>(
                particles, i, bonds, contacts, surfaces, step, sums);
          if (bonds.streams)
            finish_streaming();
          accounts[b] = {sum_of(sums.damping_before), sum_of(sums.damping_after), sum_of(sums.kinetic),
                         sum_of(sums.pushing_before), sum_of(sums.pushing_after), sum_of(sums.fastest)};
        }
    }

    template <bool with_contacts, bool damped, bool equal_radii, bool moments>
    ParticlePass select_surroundings(const Surroundings surroundings)
    {
      switch (surroundings)
        {
        case Surroundings::weight:
          return particle_pass<with_contacts, damped, equal_radii, moments, Surroundings::weight>;
        case Surroundings::pushed:
          return particle_pass<with_contacts, damped, equal_radii, moments, Surroundings::pushed>;
        case Surroundings::touched:
          return particle_pass<with_contacts, damped, equal_radii, moments, Surroundings::touched>;
        case Surroundings::periodic:
          return particle_pass<with_contacts, damped, equal_radii, moments, Surroundings::periodic>;
        default:
          return particle_pass<with_contacts, damped, equal_radii, moments, Surroundings::free>;
        }
    }

    template <bool with_contacts, bool damped>
    ParticlePass select_links(const bool equal_radii, const bool moments, const Surroundings surroundings)
    {
      if (moments)
        return equal_radii ? select_surroundings<with_contacts, damped, true, true>(surroundings) :
                             select_surroundings<with_contacts, damped, false, true>(surroundings);
      return equal_radii ? select_surroundings<with_contacts, damped, true, false>(surroundings) :
                           select_surroundings<with_contacts, damped, false, false>(surroundings);
    }
  } // namespace

  ParticlePass select_particle_pass(
    const bool contacts, const bool damped, const bool equal_radii, const bool moments, const Surroundings surroundings)
  {
    if (contacts)
      return damped ? select_links<true, true>(equal_radii, moments, surroundings) :
                      select_links<true, false>(equal_radii, moments, surroundings);
    return damped ? select_links<false, true>(equal_radii, moments, surroundings) :
                    select_links<false, false>(equal_radii, moments, surroundings);
  }
} // namespace dem
