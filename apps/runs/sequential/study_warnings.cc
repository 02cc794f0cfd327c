#include "apps/runs/sequential/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double far    = 0.5; ///< error over the mean stress of the particles
    constexpr double excess = 1.2; ///< peak of the continuum over that of the particles past the hand-over
  }                                // namespace

  double largest_from(const ParticleOutcome &all_particles, const double strain)
  {
    double most = 0;
    for (std::size_t i = 0; i < all_particles.curve_strain.size(); ++i)
      if ((all_particles.curve_strain[i] - strain) * strain >= 0)
        most = std::max(most, std::abs(all_particles.curve_stress[i]));
    return most;
  }

  std::vector<std::string> StudyReport::warnings() const
  {
    std::vector<std::string> found;
    if (all_particles == nullptr)
      return found;
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        const double error = error_against(curves[k], *all_particles), peak = curves[k].peak(),
                     bear = largest_from(*all_particles, curves[k].offset);
        if (error > far)
          found.push_back(fmt::format(
            "{}: the continuation leaves the particles by {:.2f} of the stress that they bear past the hand-over: "
            "what it says from there on is not theirs. Hand over earlier, or to other elements "
            "(doc/tutorials/transfer.md)",
            particles[k].name, error));
        if (bear > 0 && peak > excess * bear)
          found.push_back(fmt::format("{}: the continuum bears {:.4g} {} where the particles bear {:.4g} at most: its "
                                      "strength is not theirs, or the hand-over has lost damage",
                                      particles[k].name, peak, units.vertical, bear));
      }
    return found;
  }
} // namespace apps
