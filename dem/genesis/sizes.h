#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace dem
{
  /** One class of a sieve curve. */
  struct SizeClass
  {
    double fraction = 0;              ///< of the solid area (discs) or volume (spheres) [-], > 0
    double smallest = 0, largest = 0; ///< diameters [m], evenly spread between the two; equal: all alike
  };

  /** @throws base::InputError for a fraction or diameter that is none, or fractions whose sum is not 1 within 1e-6 */
  void check_sizes(const std::vector<SizeClass> &classes);

  /** Mean area [m^2] (discs) or volume [m^3] (spheres) of a class's particles. */
  double mean_solid(const SizeClass &size, int dimension);

  /**
   * Particles of each class, N_k = round(f_k V (1 - n) / mean solid of one) (doc/theory/genesis.md, 1).
   *
   * @param space area [m^2] or volume [m^3] of the vessel @param porosity n, in [0, 1)
   */
  std::vector<std::size_t>
  class_counts(const std::vector<SizeClass> &classes, double space, double porosity, int dimension);

  /** Part of the solid of a vessel that a class's particles have. @param space, porosity as for class_counts() */
  double part_of_solid(const SizeClass &size, std::size_t count, double space, double porosity, int dimension);

  /** By how much the parts of the classes differ from their fractions at most, because particles are whole [-]. */
  double largest_misfit(const std::vector<SizeClass> &classes, double space, double porosity, int dimension);

  /**
   * The least factor, to a thousandth, by which a vessel grows until the misfit of whole particles is within a tolerance; 1: it is.
   *
   * @param misfit of the vessel grown by a factor; it vanishes in the end @param tolerance > 0
   */
  double least_enlargement(const std::function<double(double)> &misfit, double tolerance);

  /** Radii of so many particles of each class [m], largest class first, the same for the same seed. */
  std::vector<double>
  draw_radii(const std::vector<SizeClass> &classes, const std::vector<std::size_t> &counts, std::uint64_t seed);

  /** N = floor(A (1 - n) / (pi R^2)), in space with 4/3 pi R^3: Su et al. (2021), (4). @param radius the mean one [m] */
  std::size_t count_by_mean_radius(double space, double porosity, double radius, int dimension);

  /** sqrt((1 - n)/(1 - n_0)), in space the cube root: radii times this fill n_0's space up to n. Su et al. (2021), (6). */
  double expansion_factor(double porosity, double porosity_now, int dimension);

  /** Porosity of discs that stands for one of the laboratory: 0.42 n^2 + 0.25 n, Wang et al. (2014). */
  double porosity_in_plane(double porosity);
} // namespace dem
