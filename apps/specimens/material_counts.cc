#include "apps/specimens/material_counts.h"

#include "dem/model/materials.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  MaterialCounts::MaterialCounts(std::vector<std::string>         scene_names,
                                 const std::vector<std::int32_t> &material,
                                 const std::vector<std::int32_t> &pair)
    : names(std::move(scene_names))
    , particles(names.size(), 0)
    , links(names.size() * (names.size() + 1) / 2, 0)
  {
    if (names.size() < 2) // then there are no numbers
      {
        names.clear();
        return;
      }
    for (const std::int32_t number : material)
      ++particles.at(static_cast<std::size_t>(number));
    for (const std::int32_t number : pair)
      if (static_cast<std::size_t>(number) < links.size()) // others are of joints
        ++links[static_cast<std::size_t>(number)];
  }

  MaterialCounts::MaterialCounts(std::vector<std::string> scene_names, const dem::ObservedSpecimen &specimen)
    : MaterialCounts(scene_names.size() > 1 ?
                       MaterialCounts(std::move(scene_names), specimen.particles().material, specimen.links().pair) :
                       MaterialCounts())
  {
  }

  template <typename Use>
  void MaterialCounts::each_pair(const Use &use) const
  {
    for (std::size_t one = 0; one < names.size(); ++one)
      for (std::size_t other = 0; other <= one; ++other)
        {
          const auto number = dem::material_pair(static_cast<std::int32_t>(one), static_cast<std::int32_t>(other));
          use(number, names[other], names[one], links[static_cast<std::size_t>(number)]);
        }
  }

  std::string MaterialCounts::text() const
  {
    if (names.empty())
      return "";
    std::string of_materials, of_pairs;
    for (std::size_t k = 0; k < names.size(); ++k)
      if (particles[k] > 0)
        of_materials += fmt::format("{}{} {}", k > 0 ? ", " : "", names[k], particles[k]);
    each_pair([&](const std::int32_t number, const std::string &one, const std::string &other, const std::size_t n) {
      if (n > 0)
        of_pairs += fmt::format("{}{}-{} {}", number > 0 ? ", " : "", one, other, n);
    });
    return fmt::format("  particles of {}\n  links of     {}\n", of_materials, of_pairs);
  }

  void MaterialCounts::put_into(nlohmann::json &summary) const
  {
    for (std::size_t k = 0; k < names.size(); ++k)
      summary["materials"].push_back({{"name", names[k]}, {"particles", particles[k]}});
    each_pair([&](const std::int32_t number, const std::string &one, const std::string &other, const std::size_t n) {
      summary["material_pairs"].push_back(
        {{"number", number}, {"materials", nlohmann::json::array({one, other})}, {"links", n}});
    });
  }
} // namespace apps
