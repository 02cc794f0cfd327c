#include "dem/kernels/particle_pass.h"

#include "dem/core/streaming.h"
#include "dem/kernels/half_records.h"
#include "dem/kernels/kinematics.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    /** Constant packs of the step, one lane per component of a particle's record. */
    struct Lanes
    {
      Pack own_sign, other_sign;  ///< how a link's record counts at its first and at its second end
      Pack own_arm, other_arm;    ///< and how its eccentricity changes that: arms are (1 +- e) L/2
      Pack keep_pose, translates; ///< what of a pose stays, and which lanes are displaced
      Pack rotates, all_but_last;

      Lanes()
        : own_sign(pack_of([](const int i) { return i == 6 ? 0.0 : 1.0; }))
        , other_sign(pack_of([](const int i) { return i == 6         ? 0.0 :
                                                      i > 2 && i < 6 ? 1.0 :
                                                                       -1.0; }))
        , own_arm(pack_of([](const int i) { return i >= 3 && i < 6 ? 1.0 : 0.0; }))
        , other_arm(pack_of([](const int i) { return i >= 3 && i < 6 ? -1.0 : 0.0; }))
        , keep_pose(pack_of([](const int i) { return i < 3 || i == 6 ? 1.0 : 0.0; }))
        , translates(pack_of([](const int i) { return i < 3 ? 1.0 : 0.0; }))
        , rotates(pack_of([](const int i) { return i >= 3 && i < 6 ? 1.0 : 0.0; }))
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

    template <bool equal_radii>
    BRECCIA_KERNEL void add_links(const LinkSet &links, const std::size_t i, const Lanes &lanes, Pack &sum)
    {
      const double *force = links.force.data();
      each_own_link(links, i, [&](const std::size_t link) {
        add<equal_radii>(force + record_size * link, lanes.own_sign, lanes.own_arm, sum);
      });
      for (std::int32_t o = links.other_begin[i]; o < links.other_begin[i + 1]; ++o)
        add<equal_radii>(force + record_size * static_cast<std::size_t>(links.others[o]), lanes.other_sign,
                         lanes.other_arm, sum);
    }

    /** The same with moments at contact points: what a link does to its first end, it does to its second the other way round. */
    template <bool equal_radii>
    BRECCIA_KERNEL void
    add_links_with_moments(const LinkSet &links, const std::size_t i, const Lanes &lanes, Pack &sum, HalfPack &moments)
    {
      const double *force = links.force.data(), *moment = links.moment.data();
      each_own_link(links, i, [&](const std::size_t link) {
        add<equal_radii>(force + record_size * link, lanes.own_sign, lanes.own_arm, sum);
        moments += load_half(moment + half_record_size * link);
      });
      for (std::int32_t o = links.other_begin[i]; o < links.other_begin[i + 1]; ++o)
        {
          const auto link = static_cast<std::size_t>(links.others[o]);
          add<equal_radii>(force + record_size * link, lanes.other_sign, lanes.other_arm, sum);
          moments -= load_half(moment + half_record_size * link);
        }
    }

    /** Of a set that may carry moments or not. */
    template <bool equal_radii, bool moments>
    BRECCIA_KERNEL void
    add_set(const LinkSet &links, const std::size_t i, const Lanes &lanes, Pack &sum, HalfPack &moment)
    {
      if constexpr (moments)
        if (links.moments_apart)
          return add_links_with_moments<equal_radii>(links, i, lanes, sum, moment);
      add_links<equal_radii>(links, i, lanes, sum);
    }

    /** With the moments at contact points: of links in the plane they stand last in their records, of those in space apart. */
    BRECCIA_KERNEL Pack with_moments(const Pack &force, const HalfPack &apart, const Lanes &lanes)
    {
      return multiply_add(force, lanes.all_but_last, last_at_rotations(force)) + at_rotations(apart);
    }

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
      return acceleration * (Pack(1.0) - select(ahead > Pack(0.0), damping,
                                                select(ahead < Pack(0.0), Pack(0.0) - damping, Pack(0.0))));
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

    template <bool with_contacts, bool damped, bool equal_radii, bool moments, Surroundings surroundings>
    void particle_pass(Particles                         &particles,
                       const LinkSet                     &bonds,
                       const LinkSet                     *contacts,
                       const base::Column                &surfaces,
                       const StepHalves                  &step,
                       const double                       damping,
                       const Eigen::Vector3d             &gravity,
                       std::vector<ParticleBlockAccount> &accounts)
    {
      const auto blocks = static_cast<std::ptrdiff_t>(accounts.size());
#pragma omp parallel for schedule(static)
      for (std::ptrdiff_t b = 0; b < blocks; ++b)
        {
          const Lanes       lanes;
          const Lengths     lengths(step);
          const Pack        coefficient(damping);
          const Pack        fall = pack_of([&](const int lane) { return lane < 3 ? gravity[lane] : 0.0; });
          Sums              sums;
          const std::size_t begin = static_cast<std::size_t>(b) * particles_per_block,
                            end   = std::min(begin + particles_per_block, particles.count);
          for (std::size_t i = begin; i < end; ++i)
            {
              Pack     force(0.0);
              HalfPack moment(0.0);
              add_set<equal_radii, moments>(bonds, i, lanes, force, moment);
              if constexpr (with_contacts)
                add_set<equal_radii, moments>(*contacts, i, lanes, force, moment);
              if constexpr (moments)
                force = with_moments(force, moment, lanes);
              constexpr bool touched = surroundings == Surroundings::touched;
              constexpr bool pushed  = surroundings == Surroundings::pushed || touched;
              if constexpr (surroundings == Surroundings::weight || pushed)
                force = multiply_add(Pack(particles.mass[i]), fall, force);
              if constexpr (touched)
                force += load(&surfaces[record_size * i]);
              if constexpr (pushed)
                force += load(&particles.pushed[record_size * i]);
              integrate<damped, surroundings == Surroundings::periodic, pushed>(particles, i, force, lanes, lengths,
                                                                                coefficient, bonds.streams, sums);
            }
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
