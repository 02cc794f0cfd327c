#pragma once

#include "base/column.h"
#include "dem/kernels/link_law_of.h"
#include "dem/laws/cpm.h"
#include "dem/laws/cpm_tangent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace dem
{
  /** What bonds and contacts of the cohesive particle model share: constants, stiffness, sliding. */
  struct CpmLinks : LinkLawDefaults
  {
    using Constants = CpmConstants;

    static constexpr bool moment = false, breaks_in_place = false;

    /** Constants as records: E, G, onset, 1/softening, cohesion, friction, kappa_broken, softening | shear weight, linear factor. */
    template <int records>
    static void put_records(const CpmConstants &k, double *record)
    {
      const double all[] = {k.E,
                            k.G,
                            k.onset,
                            k.inverse_softening,
                            k.cohesion,
                            k.friction,
                            k.kappa_broken,
                            k.softening,
                            k.shear_weight,
                            k.linear_factor};
      std::copy_n(all, std::min(10, pack_size * records), record);
    }

    static double reference_length(const NewLink &link) { return link.distance; }

    template <typename State>
    static LinkStiffnesses stiffness(const CpmConstants &k, const LinkGeometry &, const State &)
    {
      return {k.E, k.G, 0, 0};
    }

    /** 1/2 A L0 ((1 - omega) E eps_N^2 + G |eps_T|^2), omega where the link is open; doc/theory/energy.md, 2. */
    template <int m>
    static double stored_with(const CpmConstants   &k,
                              const LinkGeometry   &link,
                              const double          damage,
                              const Vec<double, m> &elastic_shear)
    {
      const double shear2 = dot(elastic_shear, elastic_shear);
      const double normal = link.strain > 0 ? (1.0 - damage) * k.E : k.E;
      return 0.5 * link.area * link.reference * (normal * link.strain * link.strain + k.G * shear2);
    }

    /**
     * What makes the law's sigma_T . d eps_p, with the stress after the return, into the same with the mean of the stresses before
     * and after the step: then the account balances to second order in the step, as the leap-frog work of the link forces does.
     */
    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static T mean_stress_correction(const Constants_ &law,
                                                   const Vec<T, m>  &trial,
                                                   const Vec<T, m>  &increment,
                                                   const Vec<T, m>  &after)
    {
      const Vec<T, m> before = trial - increment;
      return T(0.5 * law.G) * dot(before - after, trial - after);
    }

    template <bool sliding, typename Constants_, typename T, int m>
    BRECCIA_KERNEL static void sum_sliding(const Constants_        &law,
                                           const LinkMotion<T, m>  &motion,
                                           const CpmResponse<T, m> &response,
                                           const Vec<T, m>         &trial,
                                           const Vec<T, m>         &after,
                                           const T                 &volume,
                                           LinkWork<T>             &work)
    {
      if constexpr (sliding)
        if (any(response.slides))
          {
            T done = response.plastic_work;
            // A link alone may start a step from anywhere: what its law says of the step is exact if it began elastic.
            if constexpr (!std::is_same_v<T, double>)
              done = done + mean_stress_correction(law, trial, motion.shear_increment, after);
            // Below zero where one step reverses the stress: energy that the step made, not the link. The balance shows it.
            work.friction += volume * maximum(done, T(0.0));
          }
    }

    /** Shear force over what cohesion and friction hold. @param cohesion [N] @param normal force, tension positive [N] */
    static double
    sliding_exertion(const CpmConstants &k, const double cohesion, const double normal, const double shear)
    {
      const double strength = cohesion - k.friction * normal;
      if (shear == 0)
        return 0.0;
      return strength > 0 ? shear / strength : std::numeric_limits<double>::infinity();
    }

    template <typename Constants_>
    static base::Matrix6
    cpm_matrix(const Constants_ &k, const Eigen::Vector3d &n, CpmUpdate update, const LinkTangent kind)
    {
      update.grows              = kind.damages;
      update.slides             = kind.slides;
      base::Matrix6 all         = base::Matrix6::Zero();
      all.topLeftCorner<3, 3>() = kind.secant ? cpm_secant(k, n, update) : cpm_tangent(k, n, update);
      return all;
    }

    template <typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m> force_of(const CpmResponse<T, m> &response, const T &area)
    {
      LinkForce<T, m> answer;
      answer.normal = area * response.normal_stress;
      answer.shear  = area * response.shear_stress;
      answer.slides = response.slides;
      return answer;
    }
  };

  /** What drives the damage of a bond. */
  enum class DamageDriver
  {
    none,            ///< omega keeps its value
    normal,          ///< normal strain
    normal_and_shear ///< normal and shear strain: the total shear strain is stored too
  };

  /** Cohesive links of the cohesive particle model. @tparam sliding shear is limited by cohesion and friction */
  template <DamageDriver driver, bool sliding>
  struct CpmBond : CpmLinks
  {
    static constexpr const char *name    = "CPM";
    static constexpr bool        bonds   = true;
    static constexpr bool        damages = driver != DamageDriver::none;
    static constexpr int         shears  = driver == DamageDriver::normal_and_shear ? 2 : 1; ///< elastic, total
    static constexpr int         records = damages ? 2 : 1;

    static void put(const CpmConstants &k, double *record) { put_records<records>(k, record); }

    /** Numbers: kappa, omega. */
    template <typename T, int m>
    using State = LinkState<T, m, 2, shears, 0>;

    static std::array<LinkQuantity, 2 + shears> history()
    {
      std::array<LinkQuantity, 2 + shears> all;
      all[0] = {"kappa", "-", "largest equivalent strain so far"};
      all[1] = {"damage", "-", "omega, lost part of the normal stiffness in tension"};
      all[2] = {"elastic_shear", "-", "shear strain that makes stress"};
      if constexpr (shears == 2)
        all[3] = {"total_shear", "-", "shear strain"};
      return all;
    }

    BRECCIA_KERNEL static CpmNumbers<Pack> gathered(const Pack (&c)[records][pack_size], const CpmConstants &first)
    {
      const Pack none(0.0);
      return {c[0][0],
              c[0][1],
              c[0][2],
              c[0][7],
              c[0][3],
              c[0][4],
              c[0][5],
              damages ? c[records - 1][0] : none,
              damages ? c[records - 1][1] : none,
              c[0][6],
              first.law}; // the shape of softening is one for all
    }

    static void begin(const CpmConstants &, const NewLink &, double *numbers) { numbers[0] = numbers[1] = 0; }

    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Constants_ &law, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      CpmState<T, m>  own{state.number[0], state.number[1], state.shear[0]};
      const Vec<T, m> trial         = state.shear[0];
      const T         total_squared = shears == 2 ? dot(state.shear[shears - 1], state.shear[shears - 1]) : T(0.0);
      const auto      response      = Cpm<damages, sliding>::update(law, motion.strain, total_squared, own);
      const T         volume        = motion.area * motion.reference;
      sum_sliding<sliding>(law, motion, response, trial, own.elastic_shear, volume, work);
      if constexpr (driver == DamageDriver::normal_and_shear)
        work.damage += volume * Cpm<damages, sliding>::damage_work(law, motion.strain_before, motion.strain,
                                                                   T(own.damage - state.number[1]));
      state.number[0]        = own.kappa;
      state.number[1]        = own.damage;
      state.shear[0]         = own.elastic_shear;
      LinkForce<T, m> answer = force_of(response, motion.area);
      if constexpr (damages)
        answer.event = own.kappa > T(law.kappa_broken) && motion.strain > T(0.0);
      else
        answer.event = Comparison<T>(false);
      return answer;
    }

    template <typename T, int m>
    BRECCIA_KERNEL static unsigned changes_numbers(const State<T, m> &before, const State<T, m> &after)
    {
      if constexpr (damages)
        return any(after.number[0] > before.number[0]) ? 3 : 0;
      else
        return 0;
    }

    template <typename S>
    static LinkStiffnesses damaged_stiffness(const CpmConstants &k, const LinkGeometry &link, const S &state)
    {
      return {link.strain > 0 ? (1.0 - state.number[1]) * k.E : k.E, k.G, 0, 0};
    }

    template <typename S>
    static LinkPhase phase(const CpmConstants &k, const LinkGeometry &link, const S &state)
    {
      return link.strain > 0 && state.number[0] > k.kappa_broken ? LinkPhase::gone : LinkPhase::whole;
    }

    template <typename S>
    static double stored(const CpmConstants &k, const LinkGeometry &link, const S &state)
    {
      return stored_with(k, link, state.number[1], state.shear[0]);
    }

    /** Closed form where only normal strain damages. */
    template <typename S>
    static double damage_dissipation(const CpmConstants &k, const LinkGeometry &link, const S &state)
    {
      if (k.shear_weight > 0)
        return 0.0;
      return link.area * link.reference * k.dissipated_at(state.number[0], state.number[1]);
    }

    template <typename S>
    static LinkLoss damage(const CpmConstants &k, const LinkGeometry &, const S &state)
    {
      return {state.number[1], k.strength_damage(state.number[0], state.number[1])};
    }

    template <typename S>
    static double damaging_strain(const CpmConstants &k, const S &state)
    {
      return damages ? std::max(state.number[0], k.onset) : std::numeric_limits<double>::infinity();
    }

    template <typename S>
    static LinkExertion
    exertion(const CpmConstants &k, const LinkGeometry &link, const S &state, const double normal, const double shear)
    {
      const double cohesion = k.cohesion * link.area * (1 - state.number[1]);
      return {damages ? state.number[0] / k.onset : 0.0, sliding ? sliding_exertion(k, cohesion, normal, shear) : 0.0};
    }

    static base::Matrix6 tangent(const CpmConstants     &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 const LinkTangent       kind)
    {
      CpmUpdate u;
      u.normal_strain = step.geometry.strain;
      u.trial_shear   = step.shear_increment;
      for (int c = 0; c < 3; ++c)
        {
          u.trial_shear[c] += before.shear[0][c];
          if (shears == 2)
            u.total_shear[c] = after.shear[shears - 1][c];
        }
      u.kappa  = after.number[0];
      u.damage = after.number[1];
      return cpm_matrix(k, step.direction, u, kind);
    }
  };

  /** Fresh contacts of the cohesive particle model: no cohesion, no tension, gone as soon as they open; doc/theory/contacts.md, 1. */
  template <bool sliding>
  struct CpmContact : CpmLinks
  {
    static constexpr const char *name    = "CPM contact";
    static constexpr bool        bonds   = false;
    static constexpr int         records = 1;

    template <typename T, int m>
    using State = LinkState<T, m, 0, 1, 0>;

    static void put(const CpmConstants &k, double *record) { put_records<records>(k, record); }

    static std::array<LinkQuantity, 1> history()
    {
      return {{{"elastic_shear", "-", "shear strain that makes stress"}}};
    }

    BRECCIA_KERNEL static CpmNumbers<Pack> gathered(const Pack (&c)[1][pack_size], const CpmConstants &first)
    {
      const Pack none(0.0);
      return {c[0][0], c[0][1], c[0][2], c[0][7], c[0][3], c[0][4], c[0][5], none, none, c[0][6], first.law};
    }

    static void begin(const CpmConstants &, const NewLink &, double *) {}

    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Constants_ &law, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      CpmState<T, m>  own{T(0.0), T(1.0), state.shear[0]};
      const Vec<T, m> trial    = state.shear[0];
      const auto      response = Cpm<false, sliding>::update(law, motion.strain, T(0.0), own);
      const T         volume   = motion.area * motion.reference;
      sum_sliding<sliding>(law, motion, response, trial, own.elastic_shear, volume, work);
      state.shear[0]         = own.elastic_shear;
      LinkForce<T, m> answer = force_of(response, motion.area);
      answer.event           = motion.strain > T(0.0);
      return answer;
    }

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return 0;
    }

    template <typename S>
    static LinkStiffnesses damaged_stiffness(const CpmConstants &k, const LinkGeometry &link, const S &)
    {
      return {link.strain > 0 ? 0.0 : k.E, k.G, 0, 0};
    }
    template <typename S>
    static LinkPhase phase(const CpmConstants &, const LinkGeometry &link, const S &)
    {
      return link.strain > 0 ? LinkPhase::gone : LinkPhase::broken;
    }
    template <typename S>
    static double stored(const CpmConstants &k, const LinkGeometry &link, const S &state)
    {
      return stored_with(k, link, 1.0, state.shear[0]);
    }
    template <typename S>
    static LinkLoss damage(const CpmConstants &, const LinkGeometry &, const S &)
    {
      return {1.0, 1.0};
    }
    template <typename S>
    static LinkExertion
    exertion(const CpmConstants &k, const LinkGeometry &, const S &, const double normal, const double shear)
    {
      return {0.0, sliding ? sliding_exertion(k, 0.0, normal, shear) : 0.0};
    }

    static base::Matrix6 tangent(const CpmConstants     &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &,
                                 const LinkTangent kind)
    {
      CpmUpdate u;
      u.normal_strain = step.geometry.strain;
      u.trial_shear   = step.shear_increment;
      for (int c = 0; c < 3; ++c)
        u.trial_shear[c] += before.shear[0][c];
      u.damage = 1;
      return cpm_matrix(k, step.direction, u, kind);
    }
  };
} // namespace dem
