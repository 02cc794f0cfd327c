#include "dem/observation/discrete_state.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/specimen/observation.h"

#include <cmath>
#include <sstream>

namespace dem
{
  DiscreteState discrete_state(const ObservedSpecimen &specimen)
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
      throw base::InputError(message.str());
    }

    /** Beyond these there is nothing, and squares of what lies within can be computed. */
    constexpr double largest_length = 1e9, smallest_length = 1e-12; ///< [m]
    constexpr double largest_stress = 1e15;                         ///< [Pa]

    bool within(const double value, const double limit) { return std::isfinite(value) && std::abs(value) <= limit; }

    void check_particle(const DiscreteState &state, const std::size_t i, const std::string &origin)
    {
      for (int c = 0; c < 3; ++c)
        {
          if (!within(state.reference[i][c], largest_length))
            refuse(origin, "particle", i, "its reference place must be finite numbers up to 1e9 m",
                   state.reference[i][c]);
          if (!within(state.position[i][c], largest_length))
            refuse(origin, "particle", i, "its place must be finite numbers up to 1e9 m", state.position[i][c]);
          for (int d = 0; d < 3; ++d)
            if (!within(state.stress[i](c, d), largest_stress))
              refuse(origin, "particle", i, "its stress must be finite numbers up to 1e15 Pa", state.stress[i](c, d));
        }
      if (!within(state.radius[i], largest_length) || state.radius[i] < smallest_length)
        refuse(origin, "particle", i, "its radius must be a finite number above zero, from 1e-12 to 1e9 m",
               state.radius[i]);
      if (!within(state.volume[i], std::pow(largest_length, 3)) || state.volume[i] < std::pow(smallest_length, 3))
        refuse(origin, "particle", i, "its volume must be a finite number above zero, from 1e-36 to 1e27 m^3",
               state.volume[i]);
      if (state.held[i] != 0 && state.held[i] != 1)
        refuse(origin, "particle", i, "its mark of being held must be 0 or 1", state.held[i]);
    }

    void check_link(const DiscreteState &state, const std::size_t l, const std::string &origin)
    {
      constexpr double  unit_tolerance = 1e-6; // enough for directions that another program wrote with seven digits
      const LinkDamage &link           = state.damage.links[l];
      if (!(std::abs(link.direction.norm() - 1) < unit_tolerance))
        refuse(origin, "link", l, "its direction must have length 1", link.direction.norm());
      if (!(link.damage >= 0 && link.damage <= 1))
        refuse(origin, "link", l, "its strength damage must lie between 0 and 1", link.damage);
      for (int c = 0; c < 3; ++c)
        if (!within(state.damage.contact[l][c], largest_length))
          refuse(origin, "link", l, "its contact point must be finite numbers up to 1e9 m", state.damage.contact[l][c]);
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
        throw base::InputError(origin + ": column \"" + name + "\" has " + std::to_string(found) + " rows, expected " +
                                      std::to_string(expected) + ".");
    };
    if (n == 0)
      throw base::InputError(origin + ": no particle. A discrete state needs at least one.");
    if (state.dimension != 2 && state.dimension != 3)
      throw base::InputError(origin + ": dimension = " + std::to_string(state.dimension) + ": must be 2 or 3.");
    require("reference", state.reference.size(), n);
    require("position", state.position.size(), n);
    require("volume", state.volume.size(), n);
    require("stress", state.stress.size(), n);
    require("held", state.held.size(), n);
    require("link direction", state.damage.links.size(), state.damage.ends.size());
    require("link contact", state.damage.contact.size(), state.damage.ends.size());
    if (!within(state.time, 1e15))
      throw base::InputError(origin + ": time = " + base::number_text(state.time) + ": must be a finite number [s].");
    for (std::size_t i = 0; i < n; ++i)
      check_particle(state, i, origin);
    for (std::size_t l = 0; l < state.damage.ends.size(); ++l)
      check_link(state, l, origin);
  }
} // namespace dem
