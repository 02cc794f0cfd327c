#include "apps/bench/uniaxial_cases.h"

namespace apps
{
  namespace
  {
    constexpr const char *time_step = "time step", *loading_rate = "loading rate", *particle_size = "particle size";

    /** The first value of a list is the reference: the finest, and the one that costs most. */
    void add(std::vector<UniaxialCase> &cases, const char *study, const char *unit, const std::vector<double> &values)
    {
      for (const double value : values)
        cases.push_back({study, value, unit, value == values.front()});
    }
  } // namespace

  UniaxialModel UniaxialCase::apply(UniaxialModel model) const
  {
    if (study == time_step)
      model.time.step_factor = value;
    else if (study == loading_rate)
      {
        model.loading.tension.rate *= value;
        model.loading.compression.rate *= value;
      }
    else
      {
        model.loading.grips.thickness *= value; // stays the same number of particle layers
        model.source.generator.radius *= value;
      }
    return model;
  }

  std::vector<UniaxialCase> uniaxial_cases(const bool quick)
  {
    std::vector<UniaxialCase> cases;
    if (quick)
      {
        add(cases, time_step, "of the stable step", {0.4, 0.6, 0.8, 0.95});
        add(cases, loading_rate, "of the scene's", {1.0, 3.0, 10.0});
        add(cases, particle_size, "of the scene's", {1.0, 1.5, 2.0});
        return cases;
      }
    add(cases, time_step, "of the stable step", {0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95});
    add(cases, loading_rate, "of the scene's", {0.1, 0.3, 1.0, 3.0, 10.0});
    add(cases, particle_size, "of the scene's", {0.75, 1.0, 1.5, 2.0});
    return cases;
  }
} // namespace apps
