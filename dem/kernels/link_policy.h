#pragma once

#include "dem/kernels/first_order_shear.h"
#include "dem/kernels/link_law_of.h"
#include "dem/model/physics.h"

namespace dem::link_update
{
  /**
   * What the pass is compiled for, besides the law; what would not show in its time is looked at as it runs.
   * @tparam Law_ see dem/kernels/link_law_of.h
   */
  template <typename Law_, int dimension_, bool rotations_, Mixture mixture_>
  struct Policy
  {
    using Law                           = Law_;
    static constexpr int  dimension     = dimension_;
    static constexpr bool rotations     = rotations_;
    static constexpr bool equal_radii   = mixture_ == Mixture::equal;
    static constexpr bool several_pairs = mixture_ == Mixture::materials;
    static constexpr int  across        = dimension == 3 ? 3 : 1; ///< components of a vector across the link
    static constexpr bool moment        = Law::moment && rotations;
    static constexpr bool first_order   = is_first_order_shear<Law>;
    static constexpr bool may_rest      = moment && dimension == 3 && Law::resting_shear >= 0;

    template <typename T>
    using State = typename Law::template State<T, across>;
  };
} // namespace dem::link_update
