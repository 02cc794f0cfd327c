#pragma once

#include "dem/laws/cpm_extended_links.h"

namespace dem
{
  /** Fresh contacts with options: no cohesion, no tension, no prestress, gone as soon as they open. */
  struct CpmExtendedContact : CpmExtendedLinks
  {
    static constexpr const char *name  = "CPM contact";
    static constexpr bool        bonds = false;

    template <typename T, int m>
    using State = LinkState<T, m, 1, 1, 0>;

    static std::array<LinkQuantity, 2> history()
    {
      return {{{"plastic_strain", "-", "normal strain that is plastic, from flow in compression"},
               {"elastic_shear", "-", "shear strain that makes stress"}}};
    }

    static void begin(const Constants &, const NewLink &, double *numbers) { numbers[0] = 0; }

    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Constants_ &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      const CpmExtendedState<T, m> before = own_of(state);
      CpmExtendedState<T, m>       own    = before;
      const auto response = CpmExtended<false>::update(k, motion.strain, T(0.0), T(motion.per_second), own);
      sum_plastic(k, motion, response, state.shear[0], before, own, T(motion.strain_before - before.plastic_strain),
                  T(0.0), work);
      state.number[0]        = own.plastic_strain;
      state.shear[0]         = own.elastic_shear;
      LinkForce<T, m> answer = force_of<T, m>(response, motion.area);
      answer.event           = response.strain > T(0.0);
      return answer;
    }

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return 1;
    }

    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      return {link.strain - state.number[0] > 0 ? 0.0 : k.E, k.G, 0, 0};
    }
    template <typename S>
    static LinkPhase phase(const Constants &, const LinkGeometry &link, const S &state)
    {
      return link.strain - state.number[0] > 0 ? LinkPhase::gone : LinkPhase::broken;
    }
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      LinkGeometry elastic = link;
      elastic.strain       = link.strain - state.number[0];
      return stored_with(k, elastic, 1.0, state.shear[0]);
    }
    template <typename S>
    static LinkLoss damage(const Constants &, const LinkGeometry &, const S &)
    {
      return {1.0, 1.0};
    }
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &link, const S &, const double normal, const double shear)
    {
      if (shear == 0)
        return {0.0, 0.0};
      const double strength = CpmExtended<false>::strength(k, 1.0, normal / link.area);
      return {0.0, strength > 0 ? shear / (link.area * strength) : std::numeric_limits<double>::infinity()};
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
      own.kappa          = T(0.0);
      own.damage         = T(1.0);
      own.elastic_shear  = state.shear[0];
      own.plastic_strain = state.number[0];
      own.damage_strain  = T(0.0);
      return own;
    }
  };
} // namespace dem
