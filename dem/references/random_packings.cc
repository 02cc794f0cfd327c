#include "dem/references/random_packings.h"

#include "base/errors.h"
#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/network/elastic_network.h"
#include "dem/packing/compaction.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dem::references
{
  namespace
  {
    /** A row of the table of section 6. */
    struct Published
    {
      double interaction_ratio, shear_ratio, young, young_deviation, poisson;
    };

    const std::vector<Published> table_of_500 = {
      {1.05, 0.1, 0.5025, 0.0220, +0.2601},  {1.05, 1.0, 1.0643, 0.0427, +0.0422},
      {1.05, 10., 2.4236, 0.1060, -0.4869},  {1.25, 0.1, 0.9654, 0.0145, +0.2293},
      {1.25, 1.0, 1.7888, 0.0275, +0.0102},  {1.25, 10., 4.1459, 0.0655, -0.6179},
      {1.50, 0.1, 1.4471, 0.0310, +0.2193},  {1.50, 1.0, 2.5907, 0.0542, +0.0061},
      {1.50, 10., 5.9916, 0.1263, -0.6301},  {2.00, 0.1, 5.9332, 0.1987, +0.2209},
      {2.00, 1.0, 10.6402, 0.3566, +0.0026}, {2.00, 10., 24.4437, 0.8087, -0.6382}};
    const std::vector<Published> table_of_100 = {
      {1.05, 0.1, 0.5549, 0.0318, +0.2497}, {1.05, 1.0, 1.1156, 0.0308, +0.0401}, {1.05, 10., 2.5202, 0.0783, -0.4900},
      {1.50, 0.1, 1.4604, 0.0224, +0.2198}, {1.50, 1.0, 2.6199, 0.0478, +0.0062}, {1.50, 10., 6.0620, 0.1173, -0.6300}};

    NetworkParameters links_of(const double interaction_ratio, const double shear_ratio)
    {
      NetworkParameters p;
      p.interaction_ratio = interaction_ratio;
      p.normal_modulus    = 1;
      p.shear_ratio       = shear_ratio;
      return p;
    }

    Packing compacted(const std::size_t count, const std::uint64_t seed, const PackingState state)
    {
      CompactionParameters p;
      p.radius                = 1;
      p.count                 = count;
      p.seed                  = seed;
      p.friction              = 0;
      p.damping               = 0.1;
      CompactionResult result = compact(p);
      if (state == PackingState::touching)
        return result.packing;
      const double growth = std::cbrt(result.packing_fraction / 0.63);
      for (Eigen::Vector3d &x : result.packing.centre)
        x *= growth;
      *result.packing.periodic_cell *= growth;
      return result.packing;
    }

    std::string links_text(const double interaction_ratio, const double shear_ratio)
    {
      return "iota = " + std::to_string(interaction_ratio).substr(0, 4) +
             ", G/E = " + std::to_string(shear_ratio).substr(0, shear_ratio < 10 ? 3 : 2);
    }

    void moduli(base::Comparisons            &rows,
                const std::vector<Published> &table,
                const std::vector<Packing>   &packings,
                const std::string            &state)
    {
      for (const Published &row : table)
        {
          const PackingMeans m  = means_of(packings, row.interaction_ratio, row.shear_ratio);
          const std::string  of = links_text(row.interaction_ratio, row.shear_ratio) + ", " + state;
          // The rule for packings made otherwise than the published ones.
          rows.of("Young's modulus, " + of, "", m.young)
            .within_margin(std::max(3 * row.young_deviation, 0.08 * row.young), row.young);
          rows.of("Poisson's ratio, " + of, "", m.poisson)
            .within_margin(row.interaction_ratio < 1.1 ? 0.03 : 0.015, row.poisson);
        }
    }
  } // namespace

  std::vector<Packing> five_packings(const std::size_t count, const PackingState state, const std::uint64_t times)
  {
    std::vector<Packing> packings;
    for (std::uint64_t seed = 1; seed <= 5 * times; ++seed)
      packings.push_back(compacted(count, seed, state));
    return packings;
  }

  PackingMeans means_of(const std::vector<Packing> &packings, const double interaction_ratio, const double shear_ratio)
  {
    PackingMeans m;
    const auto   n = static_cast<double>(packings.size());
    for (const Packing &p : packings)
      {
        const auto network = make_network(p, links_of(interaction_ratio, shear_ratio));
        const auto found   = relaxed_stiffness(network);
        if (!found.solver.converged)
          throw base::NumericalError("the stiffness of a random packing was not found.");
        const auto relaxed = isotropy_measures(found.stiffness, 3);
        const auto affine  = isotropy_measures(affine_stiffness(network), 3);
        m.young += relaxed.mean.young / n;
        m.poisson += relaxed.mean.poisson / n;
        m.young_spread += relaxed.young_spread / n;
        m.shear_spread += relaxed.shear_spread / n;
        m.ratio_to_affine += relaxed.mean.young / affine.mean.young / n;
        for (const ElasticLink &l : network.links)
          m.link_density += l.branch.norm() * l.area / (3 * network.volume) / n;
      }
    return m;
  }

  void links_of_random_packings(base::Comparisons &rows)
  {
    struct Known
    {
      double interaction_ratio, link_density, ratio;
    };
    const std::vector<Packing> packings = five_packings(500, PackingState::let_go);
    // Shear ratio 1. Single packings scatter by 1 %.
    for (const Known &known :
         {Known{1.05, 1.22730, 0.854}, {1.25, 1.84129, 0.963}, {1.5, 2.61087, 0.977}, {2.0, 10.44749, 0.990}})
      {
        const PackingMeans m  = means_of(packings, known.interaction_ratio, 1.0);
        const std::string  of = links_text(known.interaction_ratio, 1.0);
        rows.of("link density, " + of, "", m.link_density).within(0.03, known.link_density);
        rows.of("relaxed over affine modulus, " + of, "", m.ratio_to_affine).within_margin(0.02, known.ratio);
      }
  }

  void moduli_of_500_spheres(base::Comparisons &rows)
  {
    moduli(rows, table_of_500, five_packings(500, PackingState::let_go), "let go");
    moduli(rows, table_of_500, five_packings(500, PackingState::touching), "touching");
  }

  void moduli_of_100_spheres(base::Comparisons &rows)
  {
    // Five times fewer spheres scatter as much in five times as many packings.
    moduli(rows, table_of_100, five_packings(100, PackingState::let_go, 5), "let go");
    moduli(rows, table_of_100, five_packings(100, PackingState::touching, 5), "touching");
  }
} // namespace dem::references
