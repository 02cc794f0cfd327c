#pragma once

#include "apps/bench/mortar.h"

namespace apps
{
  /**
   * What each constant of flat joints does to strength and modulus of a grown specimen: each alone times 0.25, 0.5 and 1.5 (quick:
   * without 0.5, first reading only), beside the effects that Ortiz-Cahun et al. (2023) publish (Appl. Sci. 13, 10952: their parametric study). In two readings: constants where the study names
   * them; and with the moduli and stiffness ratios of joints and of linear contacts exchanged (doc/tutorials/mortar.md).
   *
   * Written after every case to constants.csv and constants.md, at the end to constants.png.
   */
  int run_constants_bench(const MortarBench &bench);
} // namespace apps
