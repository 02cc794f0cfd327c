#pragma once

#include "dem/laws/cpm_extended.h"
#include "dem/laws/cpm_links.h"

namespace dem
{
  /** What bonds and contacts with options share. */
  struct CpmExtendedLinks : CpmLinks
  {
    using Constants = CpmExtendedConstants;

    static constexpr bool viscous = true;
    static constexpr int  records = 3;

    /** All numbers of Cpm, then those of the options. */
    static void put(const CpmExtendedConstants &k, double *record)
    {
      put_records<2>(k, record);
      const double options[] = {k.yield_strain, k.hardening,        k.log_speed, k.damage_time, k.damage_exponent,
                                k.plastic_time, k.plastic_exponent, k.prestress, k.prestrain,   k.undamaged};
      std::copy(std::begin(options), std::end(options), record + 10);
    }

    struct Gathered : CpmNumbers<Pack>, CpmOptionNumbers<Pack>
    {
    };

    BRECCIA_KERNEL static Gathered gathered(const Pack (&c)[records][pack_size], const CpmExtendedConstants &first)
    {
      return {{c[0][0], c[0][1], c[0][2], c[0][7], c[0][3], c[0][4], c[0][5], c[1][0], c[1][1], c[0][6], first.law},
              {c[1][2], c[1][3], c[1][4], c[1][5], c[1][6], c[1][7], c[2][0], c[2][1], c[2][2], c[2][3]}};
    }

    /** No dashpot: the overstress never stiffens a link beyond E and G. */
    static double damping_ratio(const CpmExtendedConstants &) { return 0; }
    static bool   rate_dependent(const CpmExtendedConstants &k) { return k.damage_time > 0 || k.plastic_time > 0; }

    /** Energy that sliding and plastic flow of an update dissipate. @param strain_before e at its start @param prestress [Pa] */
    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static void sum_plastic(const Constants_                &k,
                                           const LinkMotion<T, m>          &motion,
                                           const CpmExtendedResponse<T, m> &response,
                                           const Vec<T, m>                 &trial,
                                           const CpmExtendedState<T, m>    &before,
                                           const CpmExtendedState<T, m>    &after,
                                           const T                         &strain_before,
                                           const T                         &prestress,
                                           LinkWork<T>                     &work)
    {
      const T zero = T(0.0), volume = motion.area * motion.reference;
      if (any(response.slides))
        {
          T slid = response.plastic_work;
          if constexpr (!std::is_same_v<T, double>) // as CpmLinks::sum_sliding
            slid = slid + mean_stress_correction(k, trial, motion.shear_increment, after.elastic_shear);
          slid            = select(response.slides, volume * maximum(slid, zero), zero);
          const T delayed = slid * response.overstress_share;
          work.viscous += delayed;
          work.friction += slid - delayed;
        }
      const T    more  = after.plastic_strain - before.plastic_strain; // below zero, as the stresses
      const auto flows = more < zero;
      if (any(flows))
        {
          const T mean = T(0.5 * k.E) * (minimum(strain_before, zero) + response.strain) - prestress;
          work.friction += select(flows, volume * maximum(mean * more, zero), zero);
        }
    }
  };

  /** Cohesive links with options; doc/theory/cpm-options.md. */
  struct CpmExtendedBond : CpmExtendedLinks
  {
    static constexpr const char *name  = "CPM";
    static constexpr bool        bonds = true;

    /** What the history's numbers are. */
    enum Remembered
    {
      kappa,
      damaged,
      plastic,
      delayed
    };
    template <typename T, int m>
    using State = LinkState<T, m, 4, 2, 0>;

    static std::array<LinkQuantity, 6> history()
    {
      return {{{"kappa", "-", "largest equivalent strain so far"},
               {"damage", "-", "omega, lost part of the normal stiffness in tension"},
               {"plastic_strain", "-", "normal strain that is plastic, from flow in compression"},
               {"damage_strain", "-", "part of the opening that damage has taken from the stress so far"},
               {"elastic_shear", "-", "shear strain that makes stress"},
               {"total_shear", "-", "shear strain"}}};
    }

    static void begin(const Constants &k, const NewLink &, double *numbers)
    {
      numbers[kappa] = numbers[damaged] = numbers[delayed] = 0;
      numbers[plastic]                                     = k.plastic_prestrain();
    }

    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Constants_ &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      const CpmExtendedState<T, m> before        = own_of(state);
      CpmExtendedState<T, m>       own           = before;
      const T                      total_squared = dot(state.shear[1], state.shear[1]);
      const auto response      = CpmExtended<true>::update(k, motion.strain, total_squared, T(motion.per_second), own);
      const T    strain_before = motion.strain_before + k.prestrain - before.plastic_strain;
      sum_plastic(k, motion, response, state.shear[0], before, own, strain_before, T(k.prestress), work);
      sum_damage(k, motion.area * motion.reference, strain_before, response.strain, before, own, work);
      state.number[kappa]    = own.kappa;
      state.number[damaged]  = own.damage;
      state.number[plastic]  = own.plastic_strain;
      state.number[delayed]  = own.damage_strain;
      state.shear[0]         = own.elastic_shear;
      LinkForce<T, m> answer = force_of<T, m>(response, motion.area);
      answer.event           = own.kappa > T(k.kappa_broken) && response.strain > T(0.0);
      return answer;
    }

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return 15;
    }

    /** e = eps_N + prestrain - eps_N^p. */
    template <typename S>
    static double elastic_strain(const Constants &k, const double strain, const S &state)
    {
      return strain + k.prestrain - state.number[plastic];
    }

    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      return {elastic_strain(k, link.strain, state) > 0 ? (1.0 - state.number[damaged]) * k.E : k.E, k.G, 0, 0};
    }

    template <typename S>
    static LinkPhase phase(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const bool open = elastic_strain(k, link.strain, state) > 0;
      return open && state.number[kappa] > k.kappa_broken ? LinkPhase::gone : LinkPhase::whole;
    }

    /** doc/theory/cpm-options.md, 5: of the damaged spring, of the delayed part beside it, of the prestress, of shear. */
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      LinkGeometry elastic = link;
      elastic.strain       = elastic_strain(k, link.strain, state);
      const double delay   = k.damage_time > 0 && state.number[damaged] > 0 ?
                               state.number[damaged] * std::max(elastic.strain, 0.0) - state.number[delayed] :
                               0.0;
      const double above   = delay > 0 ? 0.5 * k.E * delay * delay / state.number[damaged] : 0.0;
      const double pressed = k.prestress * (0.5 * k.prestress / k.E - elastic.strain);
      return stored_with(k, elastic, state.number[damaged], state.shear[0]) +
             link.area * link.reference * (above + pressed);
    }

    /** Closed form where neither shear nor the rate has a part in it. */
    template <typename S>
    static double damage_dissipation(const Constants &k, const LinkGeometry &link, const S &state)
    {
      if (k.sums_damage())
        return 0.0;
      return link.area * link.reference * k.dissipated_at(state.number[kappa], state.number[damaged]);
    }

    template <typename S>
    static LinkLoss damage(const Constants &k, const LinkGeometry &, const S &state)
    {
      return {state.number[damaged], k.strength_damage(state.number[kappa], state.number[damaged])};
    }

    template <typename S>
    static double damaging_strain(const Constants &k, const S &state)
    {
      return std::max(state.number[kappa], k.onset) - k.prestrain + state.number[plastic];
    }

    /** @param normal force without the prestress, as the law gives it [N] */
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &link, const S &state, const double normal, const double shear)
    {
      if (shear == 0)
        return {state.number[kappa] / k.onset, 0.0};
      const double strength = CpmExtended<true>::strength(k, state.number[damaged], normal / link.area + k.prestress);
      return {state.number[kappa] / k.onset,
              strength > 0 ? shear / (link.area * strength) : std::numeric_limits<double>::infinity()};
    }

    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);

  private:
    template <typename T, int m>
    BRECCIA_KERNEL static CpmExtendedState<T, m> own_of(const State<T, m> &state)
    {
      CpmExtendedState<T, m> own;
      own.kappa          = state.number[kappa];
      own.damage         = state.number[damaged];
      own.elastic_shear  = state.shear[0];
      own.plastic_strain = state.number[plastic];
      own.damage_strain  = state.number[delayed];
      return own;
    }

    /** Dissipated by damage and by its delay where there is no closed form, with the means of the start and the end of the step. */
    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static void sum_damage(const Constants_             &k,
                                          const T                      &volume,
                                          const T                      &strain_before,
                                          const T                      &strain,
                                          const CpmExtendedState<T, m> &before,
                                          const CpmExtendedState<T, m> &after,
                                          LinkWork<T>                  &work)
    {
      const auto delays = T(k.damage_time) > T(0.0), sums = delays || T(k.shear_weight) > T(0.0);
      if (!any(sums))
        return;
      const T    zero = T(0.0), end = maximum(strain, zero), start = maximum(strain_before, zero);
      const auto had = before.damage > zero && delays, has = after.damage > zero && delays;
      // Strain of the delayed part, eps_d/omega; where nothing is delayed it is the opening. New damage begins as it ends.
      const T last   = select(has, minimum(after.damage_strain / select(has, after.damage, T(1.0)), end), end);
      const T first  = select(had, minimum(before.damage_strain / select(had, before.damage, T(1.0)), start),
                              select(delays, last, start));
      const T growth = after.damage - before.damage;
      work.damage += select(sums, volume * T(0.25 * k.E) * (first * first + last * last) * growth, zero);
      const T advance = maximum(after.damage_strain - before.damage_strain, zero);
      const T lag     = T(0.5) * ((end - last) + select(had, start - first, end - last));
      work.viscous += select(delays, volume * T(k.E) * lag * advance, zero);
    }
  };
} // namespace dem
