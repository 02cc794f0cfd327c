#include "dem/genesis/aggregates.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace dem
{
  using Eigen::Vector2d;

  namespace
  {
    constexpr std::int64_t draws_for_one = 100000;
    constexpr int          beginnings    = 10;

    std::vector<double> sizes_of(const AggregateParameters &p, const double area, UniformRandom &random)
    {
      std::vector<double> sizes;
      for (const AggregateClass &one : aggregate_counts(p.content, p.bounds, area))
        for (std::size_t i = 0; i < one.count; ++i)
          sizes.push_back(p.middle_sizes ? one.middle() : one.smallest + random() * (one.largest - one.smallest));
      std::sort(sizes.begin(), sizes.end(), std::greater<double>());
      return sizes;
    }

    bool is_inside(const Polygon &polygon, const Vessel &box)
    {
      return std::all_of(polygon.corners.begin(), polygon.corners.end(), [&](const Vector2d &x) {
        return x.x() >= 0 && x.x() <= box.size.x() && x.y() >= 0 && x.y() <= box.size.y();
      });
    }

    /** A polygon of this size (its angles are random: it is turned) where none of the others is near; nothing: there is no place. */
    std::optional<Polygon> placed(const double                size,
                                  const AggregateParameters  &p,
                                  const Vessel               &box,
                                  const std::vector<Polygon> &others,
                                  UniformRandom              &random)
    {
      const Polygon shape = random_polygon(0.5 * size, p.fewest_corners, p.most_corners, random);
      for (std::int64_t draw = 0; draw < draws_for_one; ++draw)
        {
          Polygon      there = shape;
          const double x = random(), y = random();
          there.move({x * box.size.x(), y * box.size.y()});
          if (is_inside(there, box) && std::none_of(others.begin(), others.end(), [&](const Polygon &other) {
                return separation(there, other) < p.clearance;
              }))
            return there;
        }
      return std::nullopt;
    }

    bool place_all(const AggregateParameters &p, const Vessel &box, const std::uint64_t seed, std::vector<Polygon> &all)
    {
      UniformRandom random(seed);
      for (const double size : sizes_of(p, box.space(), random))
        {
          const auto one = placed(size, p, box, all, random);
          if (!one)
            return false;
          all.push_back(*one);
        }
      return true;
    }
  } // namespace

  std::vector<Polygon> place_aggregates(const AggregateParameters &p, const Vessel &box)
  {
    if (p.fewest_corners < 3 || p.most_corners < p.fewest_corners)
      throw base::InputError("Aggregates: corners from " + std::to_string(p.fewest_corners) + " to " +
                             std::to_string(p.most_corners) + ": at least 3, the second not below the first.");
    if (box.dimension != 2)
      throw base::InputError("Aggregates: polygons lie in the plane; Physics/Dimension is 3.");
    constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15ull; // golden ratio: unlike seeds of neighbouring runs
    for (int beginning = 0; beginning < beginnings; ++beginning)
      {
        std::vector<Polygon> all;
        if (place_all(p, box, p.seed + static_cast<std::uint64_t>(beginning) * other_stream, all))
          return all;
      }
    throw base::InputError("Aggregates: " + std::to_string(draws_for_one) +
                           " draws found no place for one of them. Lower the content or the clearance (" +
                           base::number_text(p.clearance) + " m), or enlarge the vessel.");
  }

  void make_pebbles(Packing                    &packing,
                    const std::vector<Polygon> &polygons,
                    const std::string          &outside,
                    const std::string          &inside)
  {
    packing.material_names = {outside, inside};
    packing.material.assign(packing.size(), 0);
    packing.clump.assign(packing.size(), -1);
    packing.bodies.clear();
    std::vector<std::size_t> pebbles(polygons.size(), 0);
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        const auto within = std::find_if(polygons.begin(), polygons.end(),
                                         [&](const Polygon &p) { return p.holds(packing.centre[i].head<2>()); });
        if (within == polygons.end())
          continue;
        const auto number   = within - polygons.begin();
        packing.clump[i]    = static_cast<std::int32_t>(number);
        packing.material[i] = 1;
        ++pebbles[static_cast<std::size_t>(number)];
      }
    for (std::size_t p = 0; p < polygons.size(); ++p)
      {
        if (pebbles[p] < 3)
          throw base::InputError("Aggregates: aggregate " + std::to_string(p + 1) + " has " +
                                 std::to_string(pebbles[p]) +
                                 " pebbles, it needs 3. Take finer particles, or larger aggregates.");
        packing.bodies.push_back(body_of(polygons[p]));
      }
  }
} // namespace dem
