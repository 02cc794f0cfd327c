#pragma once

#include "base/errors.h"
#include "dem/core/simd.h"
#include "dem/kernels/link_update_types.h"
#include "dem/model/link_law.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <tuple>

namespace dem
{
  /** Name of what a link sheared by the first-order update remembers besides its law's history. */
  constexpr const char *surface_gap = "surface_gap";

  /** The law itself, for solvers that follow slip exactly. @throws base::InputError if it shears its links by the first-order update */
  inline std::shared_ptr<const LinkLaw> with_exact_shear(std::shared_ptr<const LinkLaw> law)
  {
    for (const LinkQuantity &quantity : law->columns())
      if (quantity.name == surface_gap)
        throw base::InputError(
          std::string(law->name()) +
          "/Shear kinematics = first-order: only for specimens in motion. A static solution has no steps "
          "to be of first order in. Use exact.");
    return law;
  }

  /**
   * A law whose links are sheared by the first-order update in common use, with the radii as arms (doc/theory/shear-kinematics.md, 3):
   * everything else is the law's own. A link remembers 1 - (r_J + r_K)/L0 as its last number.
   *
   * Slip is smaller than that of the contact point by (r_J + r_K)/L, and the work of the shear force greater than stress times strain
   * by as much: stored and dissipated energy of shear are those of the force, as long as radii are equal.
   */
  template <typename Law>
  struct FirstOrderShear : Law
  {
    using Constants = typename Law::Constants;
    template <typename T, int m>
    using Own = typename Law::template State<T, m>;

    static constexpr int own_numbers = Own<double, 3>::numbers;

    template <typename T, int m>
    using State = LinkState<T, m, own_numbers + 1, Own<T, m>::shears, Own<T, m>::bendings>;

    static auto history()
    {
      const auto                                                                     own = Law::history();
      std::array<LinkQuantity, std::tuple_size<decltype(Law::history())>::value + 1> all;
      const auto end = std::copy_n(own.begin(), own_numbers, all.begin());
      *end           = {surface_gap, "-", "distance of the surfaces over the reference length, when the link was made"};
      std::copy(own.begin() + own_numbers, own.end(), end + 1);
      return all;
    }

    static void begin(const Constants &k, const NewLink &link, double *numbers)
    {
      Law::begin(k, link, numbers);
      numbers[own_numbers] = 1 - (link.first_radius + link.second_radius) / Law::reference_length(link);
    }

    /** (r_J + r_K)/L0. */
    template <typename T, int m, int numbers, int shears, int bendings>
    BRECCIA_KERNEL static T arm_ratio(const LinkState<T, m, numbers, shears, bendings> &state)
    {
      return T(1.0) - state.number[own_numbers];
    }

    template <typename Constants_, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Constants_ &law, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      Own<T, m>   own = own_of(state);
      LinkWork<T> done;
      const auto  answer = Law::update(law, motion, own, done);
      work.friction += done.friction / arm_ratio(state);
      work.damage += done.damage;
      work.released += done.released;
      put_own(own, state);
      return answer;
    }

    template <typename T, int m>
    BRECCIA_KERNEL static unsigned changes_numbers(const State<T, m> &before, const State<T, m> &after)
    {
      return Law::changes_numbers(own_of(before), own_of(after));
    }

    template <typename T, int m>
    static double stored(const Constants &k, const LinkGeometry &link, const State<T, m> &state)
    {
      const Own<T, m> own = own_of(state);
      Own<T, m>       straight(own);
      for (auto &shear : straight.shear)
        shear = {};
      const double normal = Law::stored(k, link, straight);
      return normal + (Law::stored(k, link, own) - normal) / arm_ratio(state);
    }

    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 const LinkTangent       kind)
    {
      return Law::tangent(k, step, own_of(before), own_of(after), kind);
    }

  private:
    template <typename T, int m, int numbers, int shears, int bendings>
    BRECCIA_KERNEL static Own<T, m> own_of(const LinkState<T, m, numbers, shears, bendings> &state)
    {
      Own<T, m> own;
      for (int i = 0; i < own_numbers; ++i)
        own.number[i] = state.number[i];
      for (int i = 0; i < shears; ++i)
        own.shear[i] = state.shear[i];
      for (int i = 0; i < bendings; ++i)
        own.bending[i] = state.bending[i];
      return own;
    }

    template <typename T, int m, int numbers, int shears, int bendings>
    BRECCIA_KERNEL static void put_own(const Own<T, m> &own, LinkState<T, m, numbers, shears, bendings> &state)
    {
      for (int i = 0; i < own_numbers; ++i)
        state.number[i] = own.number[i];
      for (int i = 0; i < shears; ++i)
        state.shear[i] = own.shear[i];
      for (int i = 0; i < bendings; ++i)
        state.bending[i] = own.bending[i];
    }
  };

  template <typename Law>
  constexpr bool is_first_order_shear = false;
  template <typename Law>
  constexpr bool is_first_order_shear<FirstOrderShear<Law>> = true;
} // namespace dem
