#include "dem/measures/discrete_state.h"

#include "dem/core/errors.h"

#include <cmath>
#include <sstream>

namespace dem
{
  DiscreteState discrete_state(const Specimen &specimen)
  {
    ParticleOutput particles = specimen.particles();
    DiscreteState  state;
    state.dimension = specimen.parameters().physics.dimension;
    state.time      = specimen.time();
    state.reference.resize(particles.position.size());
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      state.reference[i] = particles.position[i] - particles.displacement[i];
    state.position = std::move(particles.position);
    state.radius   = std::move(particles.radius);
    state.volume   = std::move(particles.volume);
    state.stress   = std::move(particles.stress);
    state.held     = std::move(particles.held);
    state.damage   = cohesive_damage(specimen.links());
    return state;
  }

  namespace
  {
    [[noreturn]] void
    refuse(const std::string &origin, const char *kind, const std::size_t number, const char *what, const double found)
    {
      std::ostringstream message;
      message << origin << ": " << kind << ' ' << number + 1 << ": " << what << ", found " << found << '.';
      throw InputError(message.str());
    }

    void check_particle(const DiscreteState &state, const std::size_t i, const std::string &origin)
    {
      for (int c = 0; c < 3; ++c)
        {
          if (!std::isfinite(state.reference[i][c]))
            refuse(origin, "particle", i, "its reference place must be finite numbers", state.reference[i][c]);
          if (!std::isfinite(state.position[i][c]))
            refuse(origin, "particle", i, "its place must be finite numbers", state.position[i][c]);
          for (int d = 0; d < 3; ++d)
            if (!std::isfinite(state.stress[i](c, d)))
              refuse(origin, "particle", i, "its stress must be finite numbers", state.stress[i](c, d));
        }
      if (!std::isfinite(state.radius[i]) || state.radius[i] <= 0)
        refuse(origin, "particle", i, "its radius must be a finite number above zero [m]", state.radius[i]);
      if (!std::isfinite(state.volume[i]) || state.volume[i] <= 0)
        refuse(origin, "particle", i, "its volume must be a finite number above zero [m^3]", state.volume[i]);
    }

    void check_link(const DiscreteState &state, const std::size_t l, const std::string &origin)
    {
      constexpr double  unit_tolerance = 1e-6; // enough for directions that another program wrote with seven digits
      const LinkDamage &link           = state.damage.links[l];
      if (!(std::abs(link.direction.norm() - 1) < unit_tolerance))
        refuse(origin, "link", l, "its direction must have length 1", link.direction.norm());
      if (!(link.damage >= 0 && link.damage <= 1))
        refuse(origin, "link", l, "its strength damage must lie between 0 and 1", link.damage);
      for (const std::size_t end : state.damage.ends[l])
        if (end >= state.size())
          refuse(origin, "link", l, "its ends must be particle numbers from 0", static_cast<double>(end));
    }
  } // namespace

  void check_discrete_state(const DiscreteState &state, const std::string &origin)
  {
    const std::size_t n       = state.size();
    const auto        require = [&](const char *name, const std::size_t found, const std::size_t expected) {
      if (found != expected)
        throw InputError(origin + ": column \"" + name + "\" has " + std::to_string(found) + " rows, expected " +
                                std::to_string(expected) + ".");
    };
    if (n == 0)
      throw InputError(origin + ": no particle. A discrete state needs at least one.");
    if (state.dimension != 2 && state.dimension != 3)
      throw InputError(origin + ": dimension = " + std::to_string(state.dimension) + ": must be 2 or 3.");
    require("reference", state.reference.size(), n);
    require("position", state.position.size(), n);
    require("volume", state.volume.size(), n);
    require("stress", state.stress.size(), n);
    require("held", state.held.size(), n);
    require("link direction", state.damage.links.size(), state.damage.ends.size());
    for (std::size_t i = 0; i < n; ++i)
      check_particle(state, i, origin);
    for (std::size_t l = 0; l < state.damage.ends.size(); ++l)
      check_link(state, l, origin);
  }
} // namespace dem
