#pragma once

#include "base/comparison.h"
#include "dem/model/packing.h"

#include <vector>

namespace dem::references
{
  /**
   * Spheres compacted without friction, as the published ones: to a pressure of a tenth of k_n/2r, and back. The generator stops with
   * the spheres just touching, 64.6 % solid; so are some of the published cells. Others were let go a little further: the link
   * density of the one that is published in full (section 5), 10.447 at 2 diameters, is that of ours grown to 63 % solid.
   */
  enum class PackingState
  {
    touching,
    let_go
  };

  /** So many packings by five, of seeds 1, 2, ... */
  std::vector<Packing> five_packings(std::size_t count, PackingState state, std::uint64_t times = 1);

  /** Of several packings, with links of these two ratios. */
  struct PackingMeans
  {
    double young = 0, poisson = 0, young_spread = 0, shear_spread = 0, ratio_to_affine = 0, link_density = 0;
  };
  /** @throws base::NumericalError where a stiffness is not found */
  PackingMeans means_of(const std::vector<Packing> &packings, double interaction_ratio, double shear_ratio);

  void links_of_random_packings(base::Comparisons &rows);
  void moduli_of_500_spheres(base::Comparisons &rows);
  void moduli_of_100_spheres(base::Comparisons &rows);
} // namespace dem::references
