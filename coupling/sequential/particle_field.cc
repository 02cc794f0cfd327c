#include "coupling/sequential/particle_field.h"

#include "base/errors.h"

namespace coupling
{
  ParticleField particle_field(const dem::DiscreteState &state, const FieldOptions &options)
  {
    const auto damage =
      dem::particle_damage(state.damage.ends, state.damage.links, state.size(), options.fit, state.dimension);
    ParticleField field;
    field.dimension = state.dimension;
    for (std::size_t i = 0; i < state.size(); ++i)
      {
        if (damage[i].links == 0 || (options.leave_out_held && state.held[i] != 0))
          continue;
        field.place.push_back(options.place == FieldOptions::Place::reference ? state.reference[i] : state.position[i]);
        field.radius.push_back(state.radius[i]);
        field.volume.push_back(state.volume[i]);
        field.stress.push_back(state.stress[i]);
        field.damage.push_back(damage[i].tensor);
        field.mean_radius += state.radius[i];
      }
    if (field.size() == 0)
      throw base::InputError(
        "discrete state: every particle is held by a grip or was never linked; nothing to transfer.");
    field.mean_radius /= static_cast<double>(field.size());
    field.left_out = state.size() - field.size();
    return field;
  }
} // namespace coupling
