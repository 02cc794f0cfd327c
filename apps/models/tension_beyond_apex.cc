#include "apps/models/tension_beyond_apex.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace apps
{
  namespace
  {
    /** Reads the constants that make up the envelope of a law, where it has them. */
    struct Envelope : dem::ConstantVisitor
    {
      std::optional<double> tension, cohesion, angle; ///< [Pa], [Pa], [degrees]

      void number(
        const char *key, double &member, const char *, const char *, const double, const double, const bool) override
      {
        const std::string name = key;
        if (name == "Tensile strength")
          tension = member;
        if (name == "Cohesion")
          cohesion = member;
        if (name == "Friction angle")
          angle = member;
      }
      void choice(const char *,
                  const std::vector<std::string> &,
                  const std::size_t,
                  std::function<void(std::size_t)>,
                  const char *) override
      {
      }
    };

    /** "" where it is in order. A strength of inf is a word: what obeys it is meant not to break in tension. */
    std::string doubt_about(const std::string &section, const dem::LinkConstants &constants)
    {
      Envelope found;
      constants.copy()->visit(found);
      if (!found.tension || !found.cohesion || !found.angle || !(*found.angle > 0) || std::isinf(*found.tension))
        return "";
      const double apex = *found.cohesion / std::tan(*found.angle * M_PI / 180);
      if (!(*found.tension > apex))
        return "";
      return fmt::format(
        "{}: Tensile strength = {:g} Pa is never reached, as bonds break in shear at a tension of Cohesion / "
        "tan(Friction angle) = {:.4g} Pa. Lower it, or raise the cohesion",
        section, *found.tension, apex);
    }
  } // namespace

  std::vector<std::string> tension_beyond_apex(const MaterialSection &materials)
  {
    std::vector<std::string> found;
    const auto               find_doubts = [&](const std::string &section, const dem::LinkConstants &constants) {
      if (std::string doubt = doubt_about(section, constants); !doubt.empty())
        found.push_back(std::move(doubt));
    };
    if (materials.named.empty() && materials.only.law != nullptr)
      find_doubts("Material", materials.only.chosen());
    for (const NamedMaterial &material : materials.named)
      find_doubts("Materials/" + material.name, material.law.chosen());
    for (const MaterialInterface &interface : materials.interfaces)
      if (const dem::LinkLawKind *law = interface.law_among(materials.named); law != nullptr && interface.bonded)
        find_doubts("Interfaces/" + interface.name, *interface.constants_by(*law, materials.named));
    return found;
  }

  std::string lines_of_tension_beyond_apex(const MaterialSection &materials)
  {
    std::string text;
    for (const std::string &doubt : tension_beyond_apex(materials))
      text += fmt::format("  warning      {}\n", doubt);
    return text;
  }
} // namespace apps
