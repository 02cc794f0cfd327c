#pragma once

#include "dem/network/ties.h"

namespace dem
{
  /**
   * A load that stays while another grows: the weight. Its part l, from 0 to 1, is a load parameter beside the load factor p; with motions q of
   * the carriers it adds to the energy less the loads' work (doc/theory/static-handshake.md, 1)
   *
   *   - l (f^T q + p c_p) - 1/2 l^2 c_l
   */
  struct DeadLoad
  {
    int            parameter = 1; ///< load parameter l
    int            factor    = 0; ///< load parameter p
    CarrierMotions force;         ///< f: of the whole, on each carrier [N], [N m]
    double         by_factor = 0; ///< c_p: its work per unit of p, carriers at rest [J]
    double         by_itself = 0; ///< c_l: twice the energy that it stores in a body whose joints are at rest [J]
    double         on_loads  = 0; ///< work of the loads of p = 1 on what it does to that body [J]

    double on(const CarrierMotions &q) const { return force.cwiseProduct(q).sum(); }
    /** Force of its own parameter [J]. */
    double force_of(const CarrierMotions &q, const double l, const double p) const
    {
      return -(on(q) + p * by_factor + l * by_itself);
    }
    /** Work of its present size, and of the loads of p on what it does to the body [J]. */
    double work(const CarrierMotions &q, const double l, const double p) const
    {
      return -l * force_of(q, l, p) + p * l * on_loads;
    }
    /** What it adds to the energy that the body stores [J]. */
    double stored(const double l, const double p) const { return l * (0.5 * l * by_itself + p * on_loads); }
  };
} // namespace dem
