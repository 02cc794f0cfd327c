#pragma once

#include <cstddef>
#include <vector>

namespace dem
{
  /**
   * Grading of aggregates in a plane section through concrete whose aggregates follow Fuller's curve: part of the section that
   * aggregates smaller than a size take. Walraven and Reinhardt (1981), HERON 26, 1A:
   * doc/theory/genesis.md, 6: P_c = P_k (1.065 x^1/2 - 0.053 x^4 - 0.012 x^6 - 0.0045 x^8 + 0.0025 x^10), x = size/largest.
   *
   * @param content P_k, part of the volume that is aggregate @param size [m] @param largest [m]
   */
  double plane_section_grading(double content, double size, double largest);

  /** Aggregates of one class of sizes. */
  struct AggregateClass
  {
    double      smallest = 0, largest = 0; ///< diameters [m]
    double      exact = 0;                 ///< number that the grading gives
    std::size_t count = 0;                 ///< the same, rounded

    double middle() const { return 0.5 * (smallest + largest); }
    double middle_area() const; ///< of a circle of the middle size [m^2]
  };

  /**
   * How many aggregates of each class a section has: (P_i - P_(i-1)) A / (pi D_i^2/4), D_i the middle of the class; Su et al. (2021), (10).
   *
   * @param bounds of the classes, ascending [m]; the last is the largest size @param area A [m^2]
   * @throws base::InputError for bounds that do not ascend from above zero, or a content outside (0, 1]
   */
  std::vector<AggregateClass> aggregate_counts(double content, const std::vector<double> &bounds, double area);

  /** By how much of the section a class's whole aggregates differ at most from what the grading gives [-]. Throws likewise */
  double largest_aggregate_misfit(double content, const std::vector<double> &bounds, double area);
} // namespace dem
