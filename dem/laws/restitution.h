#pragma once

namespace dem
{
  constexpr double      smallest_restitution = 1e-3;
  constexpr const char *restitution_meaning =
    "e, speed after a head-on impact over that before: a dashpot beside the spring takes the rest; 1: there is none";

  /**
   * Part of the critical damping under which a linear spring with a dashpot throws back a mass with restitution e, when the contact ends
   * where it began: zeta = -ln e / sqrt(pi^2 + ln^2 e).
   */
  double damping_ratio_of(double restitution);
} // namespace dem
