#include "apps/runs/peridynamics/materials.h"

#include "apps/results/warning.h"
#include "apps/specimens/mix_work.h"
#include "apps/text/nearest_name.h"
#include "base/errors.h"
#include "dem/mesostructure/bodies_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    std::vector<std::int32_t> by_place(const pd::Grid &grid, const std::vector<std::int32_t> &of_nodes)
    {
      std::vector<std::int32_t> made(grid.places(), 0);
      for (std::size_t n = 0; n < of_nodes.size(); ++n)
        made[grid.nodes()[n]] = of_nodes[n];
      return made;
    }

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

  void PeridynamicMaterialsSection::check(const base::EntryPath &root,
                                          const pd::Space        space,
                                          const Eigen::Vector3d &size,
                                          const bool             moves) const
  {
    const int             dimension = pd::dimension_of(space);
    const base::EntryPath section   = root.at("Material");
    const double          nu        = pd::poisson_ratio(space);
    if (poisson_ratio != 0 && std::abs(poisson_ratio - nu) > 1e-3)
      section.refuse("Poisson ratio", dimension == 1 ?
                                        std::string("a rod has none.") :
                                        fmt::format("bonds have {:.6g} here, and no other: leave the entry out.", nu));
    check_mix(root, dimension, size);
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

  void PeridynamicMaterialsSection::check_mix(const base::EntryPath &root,
                                              const int              dimension,
                                              const Eigen::Vector3d &size) const
  {
    const base::EntryPath body = root.at("Body");
    if (mix.given() && dimension == 1)
      body.refuse("Mix", "a rod has no aggregates.");
    mix.check(body, size, dimension);
    if (!named.empty())
      mix.require_among(names(), body);
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
    if (named.empty() && mix.given())
      return {mix.mortar, mix.aggregate};
    std::vector<std::string> all;
    for (const PeridynamicConstants &each : named)
      all.push_back(each.name);
    return all;
  }

  std::size_t PeridynamicMaterialsSection::number(const std::string &name) const
  {
    const std::vector<std::string> known = names();
    return static_cast<std::size_t>(std::find(known.begin(), known.end(), name) - known.begin());
  }

  std::vector<std::int32_t> PeridynamicMaterialsSection::numbers(const pd::Grid &grid, const double horizon) const
  {
    const std::vector<std::string> known = names();
    std::vector<Eigen::Vector3d>   places;
    for (const std::size_t i : grid.nodes())
      places.push_back(grid.position(i));
    std::vector<std::int32_t> of_nodes(places.size(), 0);
    if (mix.given())
      {
        const auto mortar = static_cast<std::int32_t>(number(mix.mortar)),
                   stone  = static_cast<std::int32_t>(number(mix.aggregate)),
                   copies = static_cast<std::int32_t>(known.size()) - 1; // follow the materials
        const auto in     = aggregates(grid, horizon);
        for (std::size_t n = 0; n < in.size(); ++n)
          of_nodes[n] = in[n] == dem::in_mortar ? mortar : in[n] == 0 ? stone : copies + in[n];
      }
    number_by_regions(regions, known, places, grid.dimension() == 1 ? 3 : grid.dimension(), of_nodes);
    for (std::size_t k = 0; k < known.size(); ++k)
      if (std::none_of(of_nodes.begin(), of_nodes.end(), [&](const std::int32_t n) {
            return static_cast<std::size_t>(n) < known.size() ? static_cast<std::size_t>(n) == k :
                                                                known[k] == mix.aggregate;
          }))
        throw base::InputError("Materials/" + known[k] +
                               ": no node is of it. Take it out, or check Regions and their units (metres).");
    return by_place(grid, of_nodes);
  }

  std::vector<std::int32_t> PeridynamicMaterialsSection::aggregates(const pd::Grid &grid, const double horizon) const
  {
    const Eigen::Vector3d        size    = grid.body().size;
    const MixBox                 box     = grid.dimension() == 2 ? MixBox{mix.box_behind(size), true} : MixBox{size};
    const MixFigures             figures = mix_figures(mix, box);
    std::vector<Eigen::Vector3d> places;
    dem::Packing                 nodes; // as far apart as the grid has them: within the horizon of each other is near
    for (const std::size_t i : grid.nodes())
      {
        places.emplace_back(grid.position(i) + 0.5 * size); // the body lies about the origin
        nodes.centre.push_back(grid.position(i));
        nodes.radius.push_back(0.5 * grid.spacing());
      }
    give_note("mix: " + figures.text());
    auto in = dem::aggregates_at(figures.placed.structure, places);
    if (std::all_of(in.begin(), in.end(), [](const std::int32_t a) { return a == dem::in_mortar; }))
      throw base::InputError("Body/Mix: no node lies in an aggregate: make Grid/Spacing smaller than these are.");
    constexpr double beyond = 1 + 1e-6; // a node at the horizon to rounding lies within it
    const auto       copy =
      dem::numbers_apart(nodes, in, figures.placed.structure.inclusions.size(), beyond * horizon / grid.spacing());
    for (std::int32_t &a : in)
      a = a == dem::in_mortar ? a : copy[static_cast<std::size_t>(a)];
    return in;
  }

  pd::Mixture
  PeridynamicMaterialsSection::mixture_of(const pd::Material &mortar, const pd::Grid &grid, const double horizon) const
  {
    const auto in     = aggregates(grid, horizon);
    const auto scaled = [&mortar](const dem::ConstantFactors &by) {
      pd::Material made = mortar;
      made.young_modulus *= by.stiffness;
      made.critical_stretch *= by.strength / by.stiffness;
      return made;
    };
    std::vector<pd::Material> all(2 + static_cast<std::size_t>(*std::max_element(in.begin(), in.end())),
                                  scaled(mix.aggregates));
    all.front() = mortar;
    std::vector<std::int32_t> of_nodes;
    for (const std::int32_t a : in)
      of_nodes.push_back(a == dem::in_mortar ? 0 : 1 + a);
    pd::Mixture        made(all, by_place(grid, of_nodes));
    const pd::Material interface = scaled(mix.interface);
    for (std::size_t one = 0; one < all.size(); ++one)
      for (std::size_t other = 0; other < one; ++other)
        made.between(one, other) = {interface.young_modulus, interface.critical_stretch};
    return made;
  }

  void PeridynamicMaterialsSection::bond_copies(pd::Mixture &made) const
  {
    const std::size_t mortar = number(mix.mortar), stone = number(mix.aggregate);
    const auto        is_stone = [&](const std::size_t one) { return one == stone || one >= named.size(); };
    for (std::size_t copy = named.size(); copy < made.materials.size(); ++copy)
      {
        for (std::size_t other = 0; other < copy; ++other)
          made.between(copy, other) = made.between(is_stone(other) ? mortar : other, stone);
        made.between(copy, copy) = made.between(stone, stone);
      }
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
      return mix.given() ? mixture_of(material(only), grid, horizon) : pd::Mixture(material(only));
    std::vector<pd::Material> several;
    for (const PeridynamicConstants &each : named)
      several.push_back(material(each));
    const std::vector<std::int32_t> of = numbers(grid, horizon);
    if (const auto highest = static_cast<std::size_t>(*std::max_element(of.begin(), of.end())); highest >= named.size())
      several.resize(highest + 1, several[number(mix.aggregate)]);
    pd::Mixture made(several, of);
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
    bond_copies(made);
    return made;
  }
} // namespace apps
