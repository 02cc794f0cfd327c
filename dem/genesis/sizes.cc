#include "dem/genesis/sizes.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/core/uniform_random.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dem
{
  void check_sizes(const std::vector<SizeClass> &classes)
  {
    constexpr double rounding = 1e-6;
    if (classes.empty())
      throw base::InputError("Sizes: there is no class. Give diameters and fractions.");
    double sum = 0;
    for (const SizeClass &size : classes)
      {
        if (!(size.smallest > 0 && size.largest >= size.smallest && std::isfinite(size.largest)))
          throw base::InputError("Sizes: diameters from " + base::number_text(size.smallest) + " to " +
                                 base::number_text(size.largest) +
                                 " m: both must be above 0, the second not below the first.");
        if (!(size.fraction > 0 && size.fraction <= 1 + rounding))
          throw base::InputError("Sizes: fraction " + base::number_text(size.fraction) + ": must be in (0, 1].");
        sum += size.fraction;
      }
    if (!(std::abs(sum - 1) <= rounding))
      throw base::InputError("Sizes: the fractions sum up to " + base::number_text(sum) + "; they must be 1 together.");
  }

  double mean_solid(const SizeClass &size, const int dimension)
  {
    const double a = size.smallest, b = size.largest;
    if (dimension == 2)
      return M_PI / 4 * (a * a + a * b + b * b) / 3;
    return M_PI / 6 * (a * a * a + a * a * b + a * b * b + b * b * b) / 4;
  }

  std::vector<std::size_t>
  class_counts(const std::vector<SizeClass> &classes, const double space, const double porosity, const int dimension)
  {
    std::vector<std::size_t> counts;
    for (const SizeClass &size : classes)
      counts.push_back(
        static_cast<std::size_t>(std::round(size.fraction * space * (1 - porosity) / mean_solid(size, dimension))));
    return counts;
  }

  double part_of_solid(
    const SizeClass &size, const std::size_t count, const double space, const double porosity, const int dimension)
  {
    return static_cast<double>(count) * mean_solid(size, dimension) / (space * (1 - porosity));
  }

  double
  largest_misfit(const std::vector<SizeClass> &classes, const double space, const double porosity, const int dimension)
  {
    const std::vector<std::size_t> counts = class_counts(classes, space, porosity, dimension);
    double                         misfit = 0;
    for (std::size_t k = 0; k < classes.size(); ++k)
      misfit = std::max(
        misfit, std::abs(part_of_solid(classes[k], counts[k], space, porosity, dimension) - classes[k].fraction));
    return misfit;
  }

  double least_enlargement(const std::function<double(double)> &misfit, const double tolerance)
  {
    // By steps, because the misfit goes up and down: a particle more, and it is small again.
    constexpr double step   = 1.001;
    double           factor = 1;
    while (!(misfit(factor) <= tolerance))
      factor *= step;
    return factor;
  }

  std::vector<double>
  draw_radii(const std::vector<SizeClass> &classes, const std::vector<std::size_t> &counts, const std::uint64_t seed)
  {
    std::vector<std::size_t> order(classes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](const std::size_t a, const std::size_t b) { return classes[a].largest > classes[b].largest; });
    UniformRandom       random(seed);
    std::vector<double> radii;
    for (const std::size_t k : order)
      for (std::size_t i = 0; i < counts.at(k); ++i)
        {
          const SizeClass &size = classes[k];
          radii.push_back(0.5 * (size.largest > size.smallest ?
                                   size.smallest + random() * (size.largest - size.smallest) :
                                   size.largest));
        }
    return radii;
  }

  std::size_t count_by_mean_radius(const double space, const double porosity, const double radius, const int dimension)
  {
    const double one = dimension == 2 ? M_PI * radius * radius : 4.0 / 3.0 * M_PI * radius * radius * radius;
    return static_cast<std::size_t>(std::floor(space * (1 - porosity) / one));
  }

  double expansion_factor(const double porosity, const double porosity_now, const int dimension)
  {
    const double ratio = (1 - porosity) / (1 - porosity_now);
    return dimension == 2 ? std::sqrt(ratio) : std::cbrt(ratio);
  }

  double porosity_in_plane(const double porosity) { return 0.42 * porosity * porosity + 0.25 * porosity; }
} // namespace dem
