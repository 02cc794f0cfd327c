// Hard case S2: an undamped elastic wave in a bonded bar, a million steps close to the critical step, and just beyond it.

#include "dem/specimen/specimen.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <vector>

namespace
{
  /** A bar of 2 x 2 x 6 spheres, all its modes set off with strains of 1e-6, so that its geometry stays what it is. */
  dem::Specimen ringing_bar(const double part_of_critical_step)
  {
    omp_set_num_threads(1);
    const dem::Packing  packing = cluster::cubic_lattice(2, 2, 6, 1e-3);
    auto                p       = cluster::elastic(cluster::bonded(1.5));
    const dem::Specimen at_rest(packing, p, cluster::concrete());
    p.step_factor = part_of_critical_step * at_rest.critical_step() / at_rest.stable_step();
    dem::Specimen      specimen(packing, p, cluster::concrete());
    dem::UniformRandom random(111);
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        const Eigen::Vector3d wave(0, 0, 2e-3 * std::cos(M_PI * packing.centre[i].z() / 10e-3));
        specimen.set_velocity(i, wave + 5e-4 * cluster::random_vector(random), 0.1 * cluster::random_vector(random));
      }
    return specimen;
  }

  double total(const dem::Specimen &specimen)
  {
    const auto energy = specimen.energy();
    return energy.kinetic + energy.elastic;
  }
} // namespace

TEST_CASE("elastic wave keeps its energy for a million steps up to the critical step (S2)", "[stability][slow]")
{
  for (const double part : {0.5, 0.9, 0.99})
    {
      dem::Specimen specimen = ringing_bar(part);
      specimen.advance(1);
      const double start    = total(specimen);
      double       smallest = start, largest = start, first_mean = 0, last_mean = 0;
      const int    samples = 2000;
      for (int n = 0; n < samples; ++n)
        {
          specimen.advance(500);
          const double now = total(specimen);
          smallest         = std::min(smallest, now);
          largest          = std::max(largest, now);
          first_mean += n < samples / 10 ? 10 * now / samples : 0;
          last_mean += n >= samples - samples / 10 ? 10 * now / samples : 0;
        }
      INFO(part << " of the critical step");
      CHECK(specimen.steps() > 1000000);
      CHECK(largest - smallest < 1e-3 * start);
      CHECK(std::abs(last_mean - first_mean) < 1e-4 * start);
    }
}

TEST_CASE("elastic wave grows at once beyond the critical step (S2)", "[stability]")
{
  // The fastest mode turns by 2 asinh(sqrt(x^2 - 1)) per step: amplitudes grow by x^2 + x sqrt(x^2 - 1) twice over less one.
  for (const double part : {1.001, 1.02})
    {
      dem::Specimen specimen = ringing_bar(part);
      const double  x = part, factor = 2 * x * x - 1 + 2 * x * std::sqrt(x * x - 1);
      const auto    norm = [&] {
        double     sum = 0;
        const auto out = specimen.particles();
        for (const auto &v : out.velocity)
          sum += v.squaredNorm();
        return std::sqrt(sum);
      };
      const int warm_up = static_cast<int>(std::ceil(std::log(1e3) / std::log(factor))), window = warm_up / 3;
      specimen.advance(warm_up);
      const double before = norm();
      specimen.advance(window);
      INFO(part << " of the critical step");
      CHECK(std::pow(norm() / before, 1.0 / window) == Approx(factor).epsilon(2e-2 * (factor - 1)));
    }
}
