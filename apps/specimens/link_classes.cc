#include "apps/specimens/link_classes.h"

#include "dem/specimen/told_to_first.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  LinkClasses::LinkClasses(const std::vector<std::string> &of_pairs)
  {
    for (const std::string &name : of_pairs)
      {
        const auto found = std::find(names.begin(), names.end(), name);
        of_pair.push_back(static_cast<std::size_t>(found - names.begin()));
        if (found == names.end())
          names.push_back(name);
      }
  }

  std::vector<std::string> LinkClasses::of_pairs() const
  {
    std::vector<std::string> all;
    for (const std::size_t number : of_pair)
      all.push_back(names[number]);
    return all;
  }

  std::vector<std::int32_t> LinkClasses::of_links(const dem::LinkOutput &links) const
  {
    std::vector<std::int32_t> all;
    if (!names.empty())
      for (const std::int32_t pair : links.pair)
        all.push_back(static_cast<std::int32_t>(of_pair.at(static_cast<std::size_t>(pair))));
    return all;
  }

  double *LinkClasses::row_of(double *const figures, const std::int32_t pair) const
  {
    return figures + figures_of_one * of_pair.at(static_cast<std::size_t>(pair));
  }

  void LinkClasses::count(double *const figures, const dem::LinkOutput &links) const
  {
    for (std::size_t l = 0; l < links.pair.size(); ++l)
      if (links.kind[l] != dem::LinkOutput::contact)
        {
          double *row = row_of(figures, links.pair[l]);
          row[0] += 1;
          row[1] += links.kind[l] == dem::LinkOutput::broken ? 1 : 0;
          row[2] += links.damage[l];
          row[3] += links.dissipated[l];
        }
  }

  base::Column LinkClasses::figures(const dem::ObservedSpecimen &specimen) const
  {
    if (names.empty())
      return {};
    std::vector<double> found(names.size() * figures_of_one, 0.0);
    dem::add_up_links(specimen, found, [&](const dem::LinkOutput &some) { count(found.data(), some); });
    for (const dem::Break &event : specimen.breaks())
      if (event.surface < 0) // bonds to surfaces are no links between materials
        row_of(found.data(), event.pair)[4] += event.area;
    return {found.begin(), found.end()};
  }

  base::Column LinkClasses::figures(const dem::LinkOutput &links, const dem::ElasticNetwork &network) const
  {
    if (names.empty())
      return {};
    base::Column found(names.size() * figures_of_one, 0.0);
    count(found.data(), links);
    for (std::size_t l = 0; l < links.pair.size(); ++l)
      if (links.kind[l] == dem::LinkOutput::broken)
        row_of(found.data(), links.pair[l])[4] += network.links.at(l).area;
    return found;
  }

  nlohmann::json LinkClasses::json(const base::Column &figures) const
  {
    nlohmann::json all = nlohmann::json::array();
    for (std::size_t k = 0; k < names.size() && figures_of_one * (k + 1) <= figures.size(); ++k)
      {
        const double *row = &figures[figures_of_one * k];
        all.push_back({{"class", names[k]},
                       {"links", row[0]},
                       {"broken", row[1]},
                       {"mean_damage", row[0] > 0 ? row[2] / row[0] : 0.0},
                       {"damage_energy", row[3]},
                       {"broken_area", row[4]}});
      }
    return all;
  }

  std::string LinkClasses::text(const base::Column &figures) const
  {
    std::string text;
    for (std::size_t k = 0; k < names.size() && figures_of_one * (k + 1) <= figures.size(); ++k)
      if (const double *row = &figures[figures_of_one * k]; row[0] > 0)
        text += fmt::format("  links of {}: {:.0f}, {:.0f} broken, mean damage {:.3f}, {:.3g} J, {:.3g} m^2 broken\n",
                            names[k], row[0], row[1], row[2] / row[0], row[3], row[4]);
    return text;
  }
} // namespace apps
