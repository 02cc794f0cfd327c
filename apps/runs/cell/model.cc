#include "apps/runs/cell/model.h"

#include "apps/models/specimen_parameters.h"
#include "apps/text/value_text.h"
#include "base/voigt.h"

#include <fmt/format.h>

#include <optional>
#include <sstream>

namespace apps
{
  namespace
  {
    struct Aim
    {
      bool   stress;
      double value;
    };

    /** "strain 1e-4", "stress -2e6"; nothing if it is neither. */
    std::optional<Aim> aim_in(const std::string &text)
    {
      std::istringstream words(text);
      std::string        kind, value, more;
      if (!(words >> kind >> value) || words >> more || (kind != "strain" && kind != "stress"))
        return std::nullopt;
      const auto number = number_in(value);
      if (!number)
        return std::nullopt;
      return Aim{kind == "stress", *number};
    }
  } // namespace

  void CellModel::check(const base::EntryPath &root) const
  {
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    mixed().check(root);
    for (int i = 0; i < legs; ++i)
      for (int c = 0; c < 6; ++c)
        if (!aim_in(path[i].target[c]))
          root.at("Loading")
            .at(fmt::format("Leg {}", i + 1))
            .refuse(base::voigt_names[c],
                    "expected \"strain VALUE\" or \"stress VALUE\", e.g. strain 1e-4 or stress -2e6.");
  }

  dem::SpecimenParameters CellModel::specimen() const { return specimen_parameters(source, physics, time); }

  dem::CellTestParameters CellModel::loading() const
  {
    dem::CellTestParameters parameters;
    parameters.servo_time      = servo_time;
    parameters.strain_limit    = strain_limit;
    parameters.localised_above = localised_above;
    for (int i = 0; i < legs; ++i)
      {
        dem::CellLeg leg;
        leg.duration = path[i].duration;
        for (int c = 0; c < 6; ++c)
          {
            const bool exists   = physics.dimension == 3 || c < 2 || c == 5;
            const Aim  aim      = *aim_in(path[i].target[c]);
            leg.stress_given[c] = exists && aim.stress;
            leg.target[c]       = exists ? aim.value : 0;
          }
        parameters.path.push_back(leg);
      }
    return parameters;
  }
} // namespace apps
