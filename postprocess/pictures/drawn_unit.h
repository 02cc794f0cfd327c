#pragma once

#include <string>

namespace postprocess
{
  /** A unit with the prefix that keeps the numbers at an axis short. */
  struct DrawnUnit
  {
    double      scale; ///< of the values
    std::string label; ///< " [µm]"; nothing for what has no unit
  };

  /** @param peak largest magnitude of the values  @param unit of them, without prefix; "" and "-" for none */
  DrawnUnit drawn_unit(double peak, const std::string &unit);

  /** "Reaction load z" of "reaction_load_z". */
  std::string readable(std::string column);
} // namespace postprocess
