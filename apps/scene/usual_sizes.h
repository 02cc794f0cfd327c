#pragma once

#include <string>

namespace apps
{
  /**
   * The question about a number that is in its range, but of a size that its quantity hardly has: "3" for a strength of 3 MPa in Pa,
   * "38" for a coefficient of friction. "" for nothing; 0, where it is allowed, is a word: none, or that of something else.
   *
   * Whoever means the number names the unit behind it: "3 Pa", or "38 -" for a pure number.
   *
   * @param written the whole value of the entry, which may be more than the number
   */
  std::string
  question_about(const std::string &entry, const std::string &unit, double value, const std::string &written);

  /**
   * The same for the largest size that a load reaches as it grows with time, of which only that it is too small can be said.
   */
  std::string
  question_about_growing(const std::string &entry, const std::string &unit, double largest, const std::string &written);

  /**
   * The same for the numbers of a list, "1e-3-2e-3: 0.75, 8e-3: 0.25" or "-1e-3 > -5e-4": those before a colon, each of which may name its
   * unit.
   */
  std::string question_about_list(const std::string &entry, const std::string &unit, const std::string &written);

  /** A list without the units that its numbers name. */
  std::string list_without_units(const std::string &written, const std::string &unit);
} // namespace apps
