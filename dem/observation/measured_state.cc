#include "dem/observation/measured_state.h"

#include "base/errors.h"
#include "dem/ranks/exact_sum.h"

#include <cmath>

namespace dem
{
  namespace
  {
    constexpr double no_strength = 1; // lost part of the strength of a link that is gone

    /** Number of each particle among those measured; -1: it is not. */
    std::vector<std::int64_t>
    measure_particles(MeasuredState &found, const DiscreteState &state, const std::optional<MeasuredBox> &box)
    {
      std::vector<std::int64_t> number(state.size(), -1);
      double                    filled = 0;
      for (std::size_t i = 0; i < state.size(); ++i)
        {
          if (box && !box->holds(state.position[i]))
            continue;
          number[i] = static_cast<std::int64_t>(found.particles++);
          found.held += state.held[i] != 0 ? 1 : 0;
          found.volume += state.volume[i];
          found.stress += state.volume[i] * state.stress[i];
          filled += 4.0 / 3.0 * M_PI * std::pow(state.radius[i], 3);
        }
      if (found.particles == 0)
        throw base::InputError("there is no particle in the box.");
      if (found.volume > 0)
        {
          found.stress /= found.volume;
          if (state.dimension == 3)
            found.solid = filled / found.volume;
        }
      return number;
    }
  } // namespace

  MeasuredState measured(const DiscreteState &state, const std::optional<MeasuredBox> &box)
  {
    MeasuredState                           found;
    const std::vector<std::int64_t>         number = measure_particles(found, state, box);
    std::vector<LinkDamage>                 made;
    ExactSum                                damage;
    std::vector<Eigen::Vector3d>            all, holding;
    std::vector<std::array<std::size_t, 2>> ends;
    for (std::size_t k = 0; k < state.damage.links.size(); ++k)
      {
        if (box && !box->holds(state.damage.contact[k]))
          continue;
        const LinkDamage &link = state.damage.links[k];
        made.push_back(link);
        all.push_back(link.direction);
        damage.add(link.damage);
        if (link.damage >= no_strength)
          {
            ++found.gone;
            continue;
          }
        holding.push_back(link.direction);
        const std::int64_t first = number[state.damage.ends[k][0]], second = number[state.damage.ends[k][1]];
        if (first >= 0 && second >= 0)
          ends.push_back({static_cast<std::size_t>(first), static_cast<std::size_t>(second)});
      }
    found.links        = made.size();
    found.coordination = coordination(ends, found.particles);
    if (made.empty())
      return found;
    found.mean_damage   = damage.value() / static_cast<double>(made.size());
    found.damage        = damage_tensor_even(made, state.dimension);
    found.fitted_damage = damage_tensor_fitted(made, state.dimension);
    found.fabric_made   = fabric(all);
    if (!holding.empty())
      found.fabric_holding = fabric(holding);
    if (!holding.empty() && state.dimension == 3)
      found.directions = direction_statistics(holding);
    return found;
  }
} // namespace dem
