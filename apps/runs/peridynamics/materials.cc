#include "apps/runs/peridynamics/materials.h"

#include "apps/text/nearest_name.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    void check_breakage(const base::EntryPath &section, const double stretch, const double energy, const int dimension)
    {
      if (stretch > 0 && energy > 0)
        section.refuse("Fracture energy", "Critical stretch is given as well: leave one of them out.");
      if (energy > 0 && dimension == 1)
        section.refuse("Fracture energy", "a rod has no crack with an energy: give Critical stretch.");
    }
  } // namespace

  void PeridynamicConstants::check(const base::EntryPath &section, const int dimension, const bool moves) const
  {
    check_breakage(section, critical_stretch, fracture_energy, dimension);
    if (moves && density == 0)
      section.refuse("Density", "must be > 0 where Analysis/Method is motion.");
  }

  void PeridynamicMaterialsSection::check(const base::EntryPath &root, const pd::Space space, const bool moves) const
  {
    const int             dimension = pd::dimension_of(space);
    const base::EntryPath section   = root.at("Material");
    const double          nu        = pd::poisson_ratio(space);
    if (poisson_ratio != 0 && std::abs(poisson_ratio - nu) > 1e-3)
      section.refuse("Poisson ratio", dimension == 1 ?
                                        std::string("a rod has none.") :
                                        fmt::format("bonds have {:.6g} here, and no other: leave the entry out.", nu));
    if (named.empty())
      {
        only.check(section, dimension, moves);
        if (!interfaces.empty())
          root.at("Interfaces").refuse("the scene has no section Materials to join.");
        if (!regions.empty())
          root.at("Regions").refuse("the scene has no section Materials to take their materials from.");
        return;
      }
    if (only.young_modulus > 0 || only.density > 0 || only.critical_stretch > 0 || only.fracture_energy > 0)
      root.at("Materials")
        .refuse("the constants of section Material are those of a single one. Keep Model and "
                "Calibration there, and move the others here.");
    for (const PeridynamicConstants &each : named)
      each.check(root.at("Materials").at(each.name), dimension, moves);
    check_interfaces(root, dimension);
    check_regions(regions, names(), root, dimension);
  }

  void PeridynamicMaterialsSection::check_interfaces(const base::EntryPath &root, const int dimension) const
  {
    const std::vector<std::string> known = names();
    for (const PeridynamicInterface &each : interfaces)
      {
        const base::EntryPath section = root.at("Interfaces").at(each.name);
        for (const auto &[entry, name] : {std::pair{"Material", each.one}, std::pair{"Other material", each.other}})
          if (std::find(known.begin(), known.end(), name) == known.end())
            section.refuse(entry, "is not in section Materials. " + did_you_mean(name, known));
        check_breakage(section, each.critical_stretch, each.fracture_energy, dimension);
      }
  }

  std::vector<std::string> PeridynamicMaterialsSection::names() const
  {
    std::vector<std::string> all;
    for (const PeridynamicConstants &each : named)
      all.push_back(each.name);
    return all;
  }

  std::vector<std::int32_t> PeridynamicMaterialsSection::numbers(const pd::Grid &grid) const
  {
    const std::vector<std::string> known = names();
    std::vector<Eigen::Vector3d>   places;
    for (const std::size_t i : grid.nodes())
      places.push_back(grid.position(i));
    std::vector<std::int32_t> of_nodes(places.size(), 0);
    number_by_regions(regions, known, places, grid.dimension() == 1 ? 3 : grid.dimension(), of_nodes);
    for (std::size_t k = 0; k < known.size(); ++k)
      if (std::find(of_nodes.begin(), of_nodes.end(), static_cast<std::int32_t>(k)) == of_nodes.end())
        throw base::InputError("Materials/" + known[k] +
                               ": no node is of it. Take it out, or check Regions and their units (metres).");
    std::vector<std::int32_t> by_place(grid.places(), 0);
    for (std::size_t n = 0; n < of_nodes.size(); ++n)
      by_place[grid.nodes()[n]] = of_nodes[n];
    return by_place;
  }

  pd::Mixture PeridynamicMaterialsSection::mixture(const pd::Grid &grid, const double horizon) const
  {
    const auto limit = [&](const double modulus, const double stretch, const double energy) {
      if (stretch > 0)
        return stretch;
      return energy > 0 ? pd::critical_stretch(grid.body().space, bonds, modulus, horizon, energy) :
                          std::numeric_limits<double>::infinity();
    };
    const auto material = [&](const PeridynamicConstants &c) {
      return pd::Material{c.young_modulus, c.density, limit(c.young_modulus, c.critical_stretch, c.fracture_energy),
                          bonds, calibration};
    };
    if (named.empty())
      return pd::Mixture(material(only));
    std::vector<pd::Material> several;
    for (const PeridynamicConstants &each : named)
      several.push_back(material(each));
    pd::Mixture                    made(several, numbers(grid));
    const std::vector<std::string> known  = names();
    const auto                     number = [&](const std::string &name) {
      return static_cast<std::size_t>(std::find(known.begin(), known.end(), name) - known.begin());
    };
    for (const PeridynamicInterface &each : interfaces)
      {
        pd::PairConstants &pair = made.between(number(each.one), number(each.other));
        if (each.young_modulus > 0)
          pair.young_modulus = each.young_modulus;
        if (each.critical_stretch > 0 || each.fracture_energy > 0)
          pair.critical_stretch = limit(pair.young_modulus, each.critical_stretch, each.fracture_energy);
        if (!each.bonded)
          pair.young_modulus = 0;
      }
    return made;
  }
} // namespace apps
