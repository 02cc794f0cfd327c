#pragma once

#include "dem/laws/cpm.h"
#include "dem/laws/rate_equation.h"

namespace dem
{
  /** What an update takes of CpmOptions, of one link or of eight; doc/theory/cpm-options.md. */
  template <typename Number>
  struct CpmOptionNumbers
  {
    Number yield_strain, hardening; ///< eps_s (0: off), K_s
    Number log_speed;               ///< Y_0; 0: the strength surface is linear
    Number damage_time, damage_exponent, plastic_time, plastic_exponent;
    Number prestress, prestrain; ///< sigma_0 [Pa], and the strain that makes it
    Number undamaged;            ///< 1: the overstress of damage times 1 - omega
  };

  /** Constants of a link with options. */
  struct CpmExtendedConstants : CpmConstants, CpmOptionNumbers<double>
  {
    /** @throws base::InputError as CpmConstants */
    explicit CpmExtendedConstants(const CpmParameters &parameters);

    double plastic_prestrain() const { return prestrain - prestress / E; } ///< eps_N^p of a new bond
    bool   sums_damage() const { return shear_weight > 0 || damage_time > 0; }
  };

  /** History of a link with options. */
  template <typename T, int m>
  struct CpmExtendedState : CpmState<T, m>
  {
    T plastic_strain; ///< eps_N^p
    T damage_strain;  ///< eps_d
  };

  /** What it answers. */
  template <typename T, int m>
  struct CpmExtendedResponse : CpmResponse<T, m>
  {
    T overstress;       ///< of damage, in the normal stress [Pa]
    T strain;           ///< e, what is left of the normal strain without the plastic one
    T plastic_shear;    ///< of this update, its length
    T overstress_share; ///< part of the shear stress after the return that is overstress
  };

  /**
   * The cohesive particle model with its options: plastic flow in compression, logarithmic strength, visco-damage, visco-plasticity, prestress
   * (doc/theory/cpm-options.md; Smilauer, 2010, Cohesive particle model using the discrete element method on the Yade platform). Each
   * is off where its constant is zero; with all of them off the stresses are those of Cpm.
   *
   * @tparam bond otherwise a contact: omega stays 1, and there is no prestress
   */
  template <bool bond>
  struct CpmExtended
  {
    /**
     * @param normal_strain total @param per_second one over the length of the step; 0: no time passes, and nothing depends on the rate
     * @param state with the elastic shear before the return, and the history of the step before
     */
    template <typename Constants, typename T, int m>
    BRECCIA_KERNEL static CpmExtendedResponse<T, m> update(const Constants        &k,
                                                           const T                &normal_strain,
                                                           const T                &total_shear_squared,
                                                           const T                &per_second,
                                                           CpmExtendedState<T, m> &state)
    {
      CpmExtendedResponse<T, m> response;
      const T                   total = bond ? T(normal_strain + k.prestrain) : normal_strain;
      response.strain                 = total - state.plastic_strain;
      const T opening                 = maximum(response.strain, T(0.0));
      if constexpr (bond)
        Cpm<true, true>::grow_damage(k, opening, total_shear_squared, state);
      T stress = k.E * negative_multiply_add(state.damage, opening, response.strain);
      flow(k, total, stress, response.strain, state);
      slide(k, stress, per_second, state, response);
      response.overstress = T(0.0);
      if constexpr (bond)
        {
          response.overstress = damage_overstress(k, opening, per_second, state);
          stress              = stress + response.overstress - T(k.prestress);
        }
      response.normal_stress = stress;
      return response;
    }

    /** Shear strength, not below zero [Pa]. @param stress normal, tension positive */
    template <typename Constants, typename T>
    BRECCIA_KERNEL static T strength(const Constants &k, const T &damage, const T &stress)
    {
      const T    whole       = k.cohesion * (T(1.0) - damage);
      const T    linear      = maximum(negative_multiply_add(T(k.friction), stress, whole), T(0.0));
      const auto logarithmic = Comparison<T>(T(k.log_speed) > T(0.0)) && stress < T(0.0);
      if (!any(logarithmic))
        return linear;
      const T scale = select(logarithmic, T(k.cohesion) * T(k.log_speed), T(1.0));
      const T curved =
        multiply_add(T(k.friction) * scale, logarithm(select(logarithmic, T(1.0) - stress / scale, T(1.0))), whole);
      return select(logarithmic, curved, linear);
    }

  private:
    /** Plastic flow along the link: linear hardening by the total strain. */
    template <typename Constants, typename T, int m>
    BRECCIA_KERNEL static void
    flow(const Constants &k, const T &total, T &stress, T &strain, CpmExtendedState<T, m> &state)
    {
      const T    yield = T(k.yield_strain);
      const T    limit = T(k.E) * multiply_add(T(k.hardening), total - yield, yield);
      const auto flows = strain < yield && yield < T(0.0) && limit > stress;
      if (!any(flows))
        return;
      const T more         = select(flows, (stress - limit) / T(k.E), T(0.0));
      state.plastic_strain = state.plastic_strain + more;
      strain               = strain - more;
      stress               = select(flows, limit, stress);
    }

    /** Return to the strength, which grows with the rate of slip. */
    template <typename Constants, typename T, int m>
    BRECCIA_KERNEL static void slide(const Constants           &k,
                                     const T                   &stress,
                                     const T                   &per_second,
                                     CpmExtendedState<T, m>    &state,
                                     CpmExtendedResponse<T, m> &response)
    {
      response.shear_stress     = T(k.G) * state.elastic_shear;
      response.plastic_work     = T(0.0);
      response.plastic_shear    = T(0.0);
      response.overstress_share = T(0.0);
      const T limit             = strength(k, state.damage, stress);
      const T trial2            = dot(response.shear_stress, response.shear_stress);
      response.slides           = trial2 > limit * limit;
      if (!any(response.slides))
        return;
      const T    trial  = square_root(select(response.slides, trial2, T(1.0)));
      const T    excess = select(response.slides, trial - limit, T(1.0));
      T          slips  = T(1.0); // part of the excess
      const auto slow   = response.slides && T(k.plastic_time) > T(0.0) && per_second > T(0.0) && excess > T(0.0) &&
                        T(k.cohesion) > T(0.0);
      if (any(slow))
        {
          // c = c_0 x^(M-1) (tau_p/(G dt))^M with x the excess.
          const T M          = select(slow, T(k.plastic_exponent), T(1.0));
          const T log_excess = logarithm(select(slow, excess, T(1.0)));
          const T log_c      = logarithm(select(slow, T(k.cohesion), T(1.0))) - log_excess +
                          M * (log_excess + logarithm(select(slow, T(k.plastic_time) * per_second / T(k.G), T(1.0))));
          slips = select(slow, exponential(solve_rate_equation(log_c, M)), T(1.0));
        }
      const T over = (T(1.0) - slips) * excess, after = limit + over;
      const T keep              = select(response.slides, after / trial, T(1.0));
      state.elastic_shear       = keep * state.elastic_shear;
      response.shear_stress     = keep * response.shear_stress;
      response.plastic_shear    = select(response.slides, slips * excess * T(1.0 / k.G), T(0.0));
      response.plastic_work     = select(response.slides, after * response.plastic_shear, T(0.0));
      const auto bears          = response.slides && after > T(0.0);
      response.overstress_share = select(bears, over / select(bears, after, T(1.0)), T(0.0));
    }

    /** What the delay of damage adds to the normal stress. */
    template <typename Constants, typename T, int m>
    BRECCIA_KERNEL static T
    damage_overstress(const Constants &k, const T &opening, const T &per_second, CpmExtendedState<T, m> &state)
    {
      const T    end = state.damage * opening, gap = end - state.damage_strain;
      const auto delayed = gap > T(0.0) && T(k.damage_time) > T(0.0) && per_second > T(0.0);
      if (!any(delayed))
        {
          state.damage_strain = end;
          return T(0.0);
        }
      // c = eps_0 x^(M-1) (tau_d/dt)^M with x the gap.
      const T    M       = select(delayed, T(k.damage_exponent), T(1.0));
      const T    log_gap = logarithm(select(delayed, gap, T(1.0)));
      const T    part    = select(T(k.undamaged) > T(0.0), T(1.0) - state.damage, T(1.0));
      const auto some    = delayed && part > T(0.0);
      const T    log_c   = logarithm(select(some, T(k.onset) * part, T(1.0))) - log_gap +
                      M * (log_gap + logarithm(select(delayed, T(k.damage_time) * per_second, T(1.0))));
      const T grows       = select(some, exponential(solve_rate_equation(log_c, M)), T(1.0));
      const T reached     = select(delayed, state.damage_strain + grows * gap, end);
      state.damage_strain = reached;
      return select(delayed, T(k.E) * (end - reached), T(0.0));
    }
  };
} // namespace dem
