// Stable step of the present state, and when it must be found again.

#include "dem/specimen/core.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  double SpecimenCore::stable()
  {
    if (clumps.empty())
      gather_places();
    else
      gather(); // a clump's depends on what touches any of its pebbles
    const bool in_parts = !has_all_links();
    double     smallest = dem::stable_step(particles, all_links(), parameters.physics.rotations,
                                           surfaces.stiffness_seen(particles, shape, parameters.physics.rotations),
                                           stiffening.ahead(), in_parts ? std::optional(own_particles()) : std::nullopt);
    if (in_parts)
      smallest = shared->least(smallest);
    for (std::size_t clump = 0; clump < clumps.size(); ++clump)
      smallest = std::min(smallest, stable_of_clump(clump));
    return smallest;
  }

  double SpecimenCore::stable_of_clump(const std::size_t clump) const
  {
    return clumps.stable_step(particles, clump, [this](const std::int32_t pebble) {
      const bool rotations = parameters.physics.rotations;
      return dem::stiffness_around(particles, all_links(), rotations, pebble,
                                   surfaces.stiffness_seen(particles, shape, rotations, pebble), stiffening.ahead());
    });
  }

  double SpecimenCore::stable(const std::int32_t particle) const
  {
    if (const std::int32_t clump = particles.clump_of(static_cast<std::size_t>(particle)); clump >= 0)
      return stable_of_clump(static_cast<std::size_t>(clump));
    const bool rotations = parameters.physics.rotations;
    return stable_step_of(particles, all_links(), rotations, particle,
                          surfaces.stiffness_seen(particles, shape, rotations, particle), stiffening.ahead());
  }

  double SpecimenCore::step_of_lone_particles() const
  {
    std::vector<double> history(contact_law->columns().size());
    const auto          stiffness = [&](const std::size_t i, const std::size_t pair, const double lever) {
      constexpr double neighbours = 12; // as many equal spheres touch one
      const double     r = particles.radius_of(i), area = shape.link_area(r, r);
      NewLink          fresh;
      fresh.distance     = 2 * r;
      fresh.first_radius = fresh.second_radius = r;
      fresh.area                               = area;
      fresh.thickness                          = shape.dimension == 3 ? 0 : shape.thickness;
      std::fill(history.begin(), history.end(), 0.0);
      contact_law->begin(pair, fresh, history.data());
      const double          strain = contact_law->stiffens() ? -stiffening.ahead() / (2 * r) : -1e-9;
      const LinkStiffnesses s = contact_law->stiffness_of_step(pair, {strain, 2 * r, 2 * r, area}, history.data());
      return neighbours * area / (2 * r) * std::max(s.normal, s.shear * (1 + lever));
    };
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t pair = 0; pair < contact_law->pairs(); ++pair)
      {
        for (std::size_t i = 0; i < particles.count; ++i)
          if (const double mass = particles.mass[i]; mass > 0)
            {
              const double r     = particles.radius_of(i),
                           lever = parameters.physics.rotations ? mass * r * r / particles.inertia[i] : 0.0;
              smallest           = std::min(smallest, std::sqrt(2 * mass / stiffness(i, pair, lever)));
            }
        for (std::size_t clump = 0; clump < clumps.size(); ++clump)
          smallest = std::min(smallest, clumps.stable_step(particles, clump, [&](const std::int32_t pebble) {
            return stiffness(static_cast<std::size_t>(pebble), pair, 0.0);
          }));
      }
    return smallest;
  }

  void SpecimenCore::watch_stiffening()
  {
    if (!stiffening.moved(largest_displacement()))
      return;
    longest_step = std::min(longest_step, parameters.step_factor * stable());
    time_step    = std::min(time_step, longest_step);
  }
} // namespace dem
