#include "apps/models/genesis.h"

#include "apps/text/size_table.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "dem/model/packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace apps
{
  // --- Aggregates ---

  dem::AggregateParameters AggregatesSection::parameters(const std::uint64_t seed) const
  {
    dem::AggregateParameters p;
    p.content        = content;
    p.bounds         = bounds;
    p.fewest_corners = static_cast<int>(fewest_corners);
    p.most_corners   = static_cast<int>(most_corners);
    p.clearance      = clearance;
    p.middle_sizes   = middle_sizes;
    p.seed           = seed;
    return p;
  }

  namespace
  {
    /** The vessel with all edges so much longer, each rounded up to four digits, as messages give it. */
    dem::Vessel enlarged(dem::Vessel vessel, const double factor)
    {
      for (int d = 0; d < vessel.dimension; ++d)
        {
          const double edge   = factor * vessel.size[d];
          const double digits = std::pow(10.0, 3 - std::floor(std::log10(edge)));
          vessel.size[d]      = std::ceil(edge * digits * (1 - 1e-12)) / digits;
        }
      return vessel;
    }

    /** Edges of the smallest vessel of this shape in which whole particles come near enough. @param misfit in so much space */
    std::string
    large_enough(const dem::Vessel &vessel, const std::function<double(double)> &misfit, const double tolerance)
    {
      const dem::Vessel found =
        enlarged(vessel, dem::least_enlargement(
                           [&](const double factor) { return misfit(enlarged(vessel, factor).space()); }, tolerance));
      std::string edges;
      for (int d = 0; d < vessel.dimension; ++d)
        edges += fmt::format("{}{:g}", d == 0 ? "" : ", ", found.size[d]);
      return edges;
    }
  } // namespace

  void AggregatesSection::check(const base::EntryPath &genesis, const dem::Vessel &vessel, const double tolerance) const
  {
    if (!given())
      return;
    const base::EntryPath section = genesis.at("Aggregates");
    if (vessel.dimension != 2)
      section.refuse("Content", "aggregates are polygons in the plane, and Physics/Dimension is 3.");
    if (most_corners < fewest_corners)
      section.refuse("Most corners", fmt::format("must not be below Fewest corners = {}.", fewest_corners));
    if (mortar == aggregate)
      section.refuse("Aggregate material", "must be another one than Mortar material.");
    for (const auto &[entry, name] : {std::pair{"Mortar material", mortar}, std::pair{"Aggregate material", aggregate}})
      if (!dem::is_material_name(name))
        section.refuse(entry, dem::material_name_rule() + std::string("."));
    try
      {
        const auto misfit = [&](const double area) { return dem::largest_aggregate_misfit(content, bounds, area); };
        if (const double now = misfit(vessel.space()); now > tolerance)
          throw base::InputError(
            fmt::format("whole aggregates miss the grading by {:.2g} of the section, and Size tolerance is {}. The "
                        "smallest window of this shape that would do is {} m.",
                        now, tolerance, large_enough(vessel, misfit, tolerance)));
      }
    catch (const base::InputError &refused)
      {
        section.refuse("Sizes", refused.what());
      }
  }

  // --- Genesis ---

  namespace
  {
  } // namespace

  double GenesisSection::full_porosity() const
  {
    return laboratory_porosity > 0 ? dem::porosity_in_plane(laboratory_porosity) : porosity;
  }

  dem::Vessel GenesisSection::vessel(const int dimension) const
  {
    dem::Vessel made = growth.vessel;
    made.dimension   = dimension;
    made.size        = {size[0], size[1], dimension == 2 ? 0.0 : size[2]};
    return made;
  }

  std::vector<dem::SizeClass> GenesisSection::size_classes() const
  {
    std::vector<dem::SizeClass> found;
    if (sizes == Sizes::uniform)
      {
        // Mean radius and ratio of the largest to the smallest say both.
        const double smallest = 4 * mean_radius / (1 + radius_ratio);
        return {{1.0, smallest, radius_ratio * smallest}};
      }
    found = sizes == Sizes::file ? size_classes_in_file(file) : classes;
    for (dem::SizeClass &one : found)
      {
        one.smallest *= size_factor;
        one.largest *= size_factor;
      }
    dem::check_sizes(found);
    return found;
  }

  std::vector<std::size_t> GenesisSection::counts(const int dimension) const
  {
    const double space = vessel(dimension).space();
    if (sizes == Sizes::uniform)
      return {dem::count_by_mean_radius(space, full_porosity(), mean_radius, dimension)};
    return dem::class_counts(size_classes(), space, full_porosity(), dimension);
  }

  std::string text_of(const dem::SizeClass &size)
  {
    return size.smallest == size.largest ? fmt::format("{:g}", size.largest) :
                                           fmt::format("{:g} to {:g}", size.smallest, size.largest);
  }

  std::vector<ClassInVessel> GenesisSection::classes_in_vessel(const int dimension) const
  {
    std::vector<ClassInVessel> found;
    if (sizes == Sizes::uniform)
      return found;
    const std::vector<dem::SizeClass> all    = size_classes();
    const double                      space  = vessel(dimension).space();
    const std::vector<std::size_t>    number = dem::class_counts(all, space, full_porosity(), dimension);
    for (std::size_t k = 0; k < all.size(); ++k)
      found.push_back({all[k], number[k], dem::part_of_solid(all[k], number[k], space, full_porosity(), dimension)});
    return found;
  }

  void
  GenesisSection::require_enough_room(const base::EntryPath &genesis, const int dimension, const char *sizes_from) const
  {
    const dem::Vessel room = vessel(dimension);
    const auto        one  = classes_in_vessel(dimension);
    const auto worst = std::max_element(one.begin(), one.end(), [](const ClassInVessel &a, const ClassInVessel &b) {
      return std::abs(a.part - a.size.fraction) < std::abs(b.part - b.size.fraction);
    });
    if (worst == one.end() || std::abs(worst->part - worst->size.fraction) <= size_tolerance)
      return;
    const auto classes_of_sizes = size_classes();
    const auto misfit           = [&](const double space) {
      return dem::largest_misfit(classes_of_sizes, space, full_porosity(), dimension);
    };
    genesis.refuse(sizes_from,
                   fmt::format("{} whole particles of diameter {} m are {:.2g} of the solid and not {:g}, and Size "
                               "tolerance is {}. The smallest vessel of this shape that would do is {} m.",
                               worst->count, text_of(worst->size), worst->part, worst->size.fraction, size_tolerance,
                               large_enough(room, misfit, size_tolerance)));
  }

  dem::GenesisParameters GenesisSection::parameters(const int dimension, const double thickness) const
  {
    dem::GenesisParameters p = growth;
    p.vessel                 = vessel(dimension);
    p.vessel.check();
    p.seed               = static_cast<std::uint64_t>(seed);
    p.material.thickness = thickness;
    p.radii              = dem::draw_radii(size_classes(), counts(dimension), p.seed);
    if (sizes == Sizes::uniform)
      {
        double solid = 0;
        for (const double r : p.radii)
          solid += dimension == 2 ? M_PI * r * r : 4.0 / 3.0 * M_PI * r * r * r;
        const double factor = dem::expansion_factor(full_porosity(), 1 - solid / p.vessel.space(), dimension);
        for (double &r : p.radii)
          r *= factor;
      }
    return p;
  }

  void GenesisSection::finish(dem::Packing &packing) const
  {
    if (aggregates.given())
      dem::make_pebbles(packing,
                        dem::place_aggregates(aggregates.parameters(static_cast<std::uint64_t>(seed)), vessel(2)),
                        aggregates.mortar, aggregates.aggregate);
  }

  void GenesisSection::check(const base::EntryPath &specimen, const int dimension) const
  {
    const base::EntryPath section = specimen.at("Genesis");
    if (laboratory_porosity > 0 && dimension != 2)
      section.refuse("Laboratory porosity", "is for discs. In space the porosity is that of the laboratory: Porosity.");
    if (sizes == Sizes::file && !std::filesystem::is_regular_file(file))
      section.refuse("Size file",
                     "there is no such file (" + std::filesystem::absolute(file).lexically_normal().string() + ").");
    const char *sizes_from = sizes == Sizes::classes ? "Classes" : sizes == Sizes::file ? "Size file" : "Mean radius";
    try
      {
        vessel(dimension).check();
      }
    catch (const base::InputError &refused)
      {
        section.refuse("Size", refused.what());
      }
    aggregates.check(section, vessel(dimension), size_tolerance);
    std::size_t all = 0;
    try
      {
        for (const std::size_t count : counts(dimension))
          all += count;
      }
    catch (const base::InputError &refused)
      {
        section.refuse(sizes_from, refused.what());
      }
    constexpr std::size_t most = 100'000'000;
    if (all == 0)
      section.refuse(sizes_from, "not one particle fits into the vessel. Check the units: metres.");
    if (all > most)
      section.refuse(sizes_from,
                     fmt::format("that would be {:.1e} particles. Check the units: metres.", static_cast<double>(all)));
    require_enough_room(section, dimension, sizes_from);
    if (!(growth.stress < growth.material.contact.effective_modulus))
      section.refuse("Stress", "must be far below the modulus of the contacts.");
  }
} // namespace apps
