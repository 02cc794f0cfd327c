#include "apps/runs/peridynamics/model.h"

#include "apps/models/start_velocity.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    Eigen::Vector3d place_of(const Coordinates &numbers)
    {
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < std::min<std::size_t>(3, numbers.size()); ++i)
        place[static_cast<Eigen::Index>(i)] = numbers[i];
      return place;
    }

    bool all_finite(const Coordinates &numbers)
    {
      return std::all_of(numbers.begin(), numbers.end(), [](const double one) { return std::isfinite(one); });
    }
  } // namespace

  int PeridynamicsModel::dimension() const { return static_cast<int>(size.size()); }

  pd::Space PeridynamicsModel::space() const
  {
    return dimension() == 1 ? pd::Space::rod : dimension() == 3 ? pd::Space::space : plane;
  }

  void PeridynamicsModel::check_body(const base::EntryPath &root) const
  {
    const base::EntryPath body = root.at("Body");
    if (size.empty() || size.size() > 3 || !all_finite(size) || *std::min_element(size.begin(), size.end()) <= 0)
      body.refuse("Size", "must be one to three lengths > 0 between commas.");
    if (pd::half_family(dimension(), horizon).empty())
      root.at("Horizon").refuse("Ratio", "no other node lies within the horizon: it must be at least one spacing.");
    for (const double length : size)
      if (const double cells = length / spacing;
          std::abs(cells - std::round(cells)) > 1e-6 * cells || std::round(cells) < 1)
        root.at("Grid").refuse(
          "Spacing",
          fmt::format("must divide every length of the body without a rest; {} m are {:.6g} spacings.", length, cells));
  }

  void PeridynamicsModel::check_places(const base::EntryPath &root) const
  {
    const int  d       = dimension();
    const auto require = [&](const base::EntryPath &section, const char *entry, const Coordinates &place,
                             const bool needed) {
      const std::size_t n = place.size();
      if ((needed || n > 0) && (n < static_cast<std::size_t>(std::min(d, 2)) || n > 3 || !all_finite(place)))
        section.refuse(entry, fmt::format("expected {} coordinates between commas.", d));
    };
    for (const PeridynamicHole &hole : holes)
      {
        const base::EntryPath section = root.at("Holes").at(hole.name);
        if (d == 1)
          section.refuse("Radius", "a rod cannot have a hole.");
        require(section, "Centre", hole.centre, true);
      }
    for (const PeridynamicCrack &crack : cracks)
      {
        const base::EntryPath section = root.at("Cracks").at(crack.name);
        if (d == 1)
          section.refuse("From", "a rod cannot have a crack along itself.");
        require(section, "From", crack.from, true);
        require(section, "To", crack.to, true);
        require(section, "Depth", crack.depth, d == 3);
      }
    for (const NoFailZone &zone : safe)
      zone.region.check(root.at("No-fail zones").at(zone.name), d == 1 ? 3 : d);
  }

  void PeridynamicsModel::check(const base::EntryPath &root) const
  {
    check_body(root);
    materials.check(root, space(), place_of(size), !analysis.quiet());
    check_places(root);
    refuse_time(root.at("Initial velocity"), "", velocity);
    loads.check(root, dimension());
  }

  pd::Body PeridynamicsModel::body() const
  {
    pd::Body made;
    made.space     = space();
    made.size      = place_of(size);
    made.spacing   = spacing;
    made.thickness = thickness > 0 ? thickness : spacing;
    made.layout    = layout;
    for (const PeridynamicHole &hole : holes)
      made.holes.push_back({hole.name, place_of(hole.centre), hole.radius});
    return made;
  }

  pd::Bonds PeridynamicsModel::bonds() const
  {
    const pd::Grid grid(body(), pd::reach_of(horizon));
    pd::Bonds      made(grid, horizon, materials.mixture(grid, horizon.ratio * spacing));
    for (const PeridynamicCrack &crack : cracks)
      if (made.cut({place_of(crack.from), place_of(crack.to), place_of(crack.depth)}) == 0)
        throw base::InputError("Cracks/" + crack.name +
                               ": no bond crosses it. Check its places against Body/Size (metres).");
    if (!safe.empty())
      {
        std::vector<bool> protects(grid.places(), false);
        for (const std::size_t i : grid.nodes())
          protects[i] = std::any_of(safe.begin(), safe.end(), [&](const NoFailZone &zone) {
            return zone.region.holds(grid.position(i), grid.dimension() == 1 ? 3 : grid.dimension());
          });
        made.protect(protects);
      }
    made.refuse_isolated_nodes();
    return made;
  }
} // namespace apps
