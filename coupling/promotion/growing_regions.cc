#include "coupling/promotion/growing_regions.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace coupling
{
  using Eigen::Vector3d;

  GrowingRegions::GrowingRegions(std::unique_ptr<MeshElements> elements, std::vector<GrowingRegion> starts)
    : mesh(std::move(elements))
    , regions(std::move(starts))
  {
    for (const GrowingRegion &one : regions)
      {
        const auto lie_within = [&](const double reach) {
          return mesh->within([&](const Vector3d &place) {
            constexpr double rounding = 1e-9;
            return one.distance(place) <= reach + rounding * (1 + place.cwiseAbs().maxCoeff());
          });
        };
        first.push_back(mesh->filled(lie_within(0)));
        may.emplace_back();
        if (one.grows())
          {
            const Set reached = lie_within(one.reach);
            std::set_difference(reached.begin(), reached.end(), first.back().begin(), first.back().end(),
                                std::inserter(may.back(), may.back().end()));
          }
      }
    region = first;
  }

  void GrowingRegions::leave_out_around(const std::vector<Vector3d> &places)
  {
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (const unsigned int element : mesh->around(places, regions[r].width))
        may[r].erase(element);
  }

  void GrowingRegions::require_particles(const PlaceMotions &particles) const
  {
    Set filled;
    for (const auto &place : particles)
      if (place)
        filled.insert(mesh->with_centre(place->element));
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (const unsigned int element : may[r])
        if (filled.count(element) == 0)
          {
            const Vector3d centre = mesh->centre_of(element);
            throw base::InputError(
              "Handshakes/" + regions[r].name + ": Promotion reach = " + base::number_text(regions[r].reach) +
              ": no particle of the specimen lies in the element around (" + base::number_text(centre.x()) + ", " +
              base::number_text(centre.y()) + ", " + base::number_text(centre.z()) +
              "), which could not become particles. The specimen has to fill what the reach has, "
              "with elements of two particles and more.");
          }
  }

  bool GrowingRegions::grow(const dem::DamagingLinks            &bonds,
                            const std::vector<dem::ElasticLink> &links,
                            const PlaceMotions                  &particles)
  {
    const std::vector<Set> before = region;
    for (std::size_t l = 0; l < bonds.size(); ++l)
      for (const std::int32_t end : {links[l].first, links[l].second})
        {
          const auto &place = particles[static_cast<std::size_t>(end)];
          if (!place)
            continue;
          const double exertion = bonds.exertion(l);
          for (std::size_t r = 0; r < regions.size(); ++r)
            if (regions[r].grows() && exertion >= regions[r].threshold)
              if (const unsigned int element = mesh->with_centre(place->element); may[r].count(element) != 0)
                region[r].insert(element);
        }
    for (Set &elements : region)
      elements = mesh->filled(elements);
    return region != before;
  }

  std::function<double(const Vector3d &)> GrowingRegions::distance_from(const std::size_t number) const
  {
    return mesh->distance_from(region[number], regions[number].name);
  }

  std::vector<std::size_t> GrowingRegions::growable() const
  {
    std::vector<std::size_t> counted;
    for (const Set &of_one : may)
      counted.push_back(of_one.size());
    return counted;
  }

  std::vector<std::size_t> GrowingRegions::grown() const
  {
    std::vector<std::size_t> counted;
    for (std::size_t r = 0; r < region.size(); ++r)
      counted.push_back(region[r].size() - first[r].size());
    return counted;
  }
} // namespace coupling
