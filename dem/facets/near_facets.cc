#include "dem/facets/near_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dem
{
  namespace
  {
    using Cells = Eigen::Array<std::int64_t, 3, 1>;

    /** Particles of like radius, sorted into the cells of a grid over their bounding box. */
    class SizeClass
    {
    public:
      /** @param search radius within which particles find facets, over their own */
      SizeClass(const Particles &p, std::vector<std::int32_t> of, const double search, const double margin)
        : members(std::move(of))
      {
        Eigen::Vector3d low     = p.position_of(members.front());
        Eigen::Vector3d high    = low;
        double          largest = 0;
        for (const std::int32_t i : members)
          {
            low     = low.cwiseMin(p.position_of(i));
            high    = high.cwiseMax(p.position_of(i));
            largest = std::max(largest, p.radius_of(i));
          }
        reach  = search * largest + margin;
        origin = low;
        choose_cells(high - low);
        sort_in(p);
      }

      /** Call visit(particle) for all in cells that the box (grown by the reach) meets and `keep(centre of cell, half diagonal)` lets pass. */
      template <typename Keep, typename Visit>
      void around(const Eigen::Vector3d &low, const Eigen::Vector3d &high, const Keep &keep, const Visit &visit) const
      {
        const Eigen::Array3d grown_low = (low - origin).array() - reach, grown_high = (high - origin).array() + reach;
        if ((grown_high < 0).any() || (grown_low > extent.array()).any())
          return;
        const Cells  first = cell_of(grown_low), last = cell_of(grown_high);
        const double half_diagonal = 0.5 * std::sqrt(3.0) * size;
        for (std::int64_t z = first[2]; z <= last[2]; ++z)
          for (std::int64_t y = first[1]; y <= last[1]; ++y)
            for (std::int64_t x = first[0]; x <= last[0]; ++x)
              {
                const std::size_t cell = static_cast<std::size_t>((z * cells[1] + y) * cells[0] + x);
                if (begin[cell] == begin[cell + 1])
                  continue;
                const Eigen::Vector3d centre =
                  origin + size * Eigen::Vector3d(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5,
                                                  static_cast<double>(z) + 0.5);
                if (keep(centre, half_diagonal + reach))
                  for (std::size_t k = begin[cell]; k < begin[cell + 1]; ++k)
                    visit(sorted[k]);
              }
      }

    private:
      /** Twice the reach, unless that makes many more cells than particles. */
      void choose_cells(const Eigen::Vector3d &box)
      {
        const double most = 4.0 * static_cast<double>(members.size()) + 64;
        extent            = box;
        size              = 2 * reach;
        for (;; size *= 1.26)
          {
            const Eigen::Array3d along = (extent.array() / size).floor() + 1;
            if (along.prod() > most)
              continue;
            cells = along.cast<std::int64_t>();
            return;
          }
      }

      Cells cell_of(const Eigen::Array3d &from_origin) const
      {
        const Eigen::Array3d at = (from_origin / size).floor();
        return at.max(0.0).min((cells - 1).cast<double>()).cast<std::int64_t>();
      }

      void sort_in(const Particles &p)
      {
        std::vector<std::size_t> cell(members.size());
        begin.assign(static_cast<std::size_t>(cells.prod()) + 1, 0);
        for (std::size_t k = 0; k < members.size(); ++k)
          {
            const Cells at = cell_of((p.position_of(members[k]) - origin).array());
            cell[k]        = static_cast<std::size_t>((at[2] * cells[1] + at[1]) * cells[0] + at[0]);
            ++begin[cell[k] + 1];
          }
        for (std::size_t c = 1; c < begin.size(); ++c)
          begin[c] += begin[c - 1];
        std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
        sorted.resize(members.size());
        for (std::size_t k = 0; k < members.size(); ++k)
          sorted[next[cell[k]]++] = members[k];
      }

      std::vector<std::int32_t> members, sorted;
      std::vector<std::size_t>  begin;
      double                    reach = 0, size = 0;
      Eigen::Vector3d           origin, extent;
      Cells                     cells;
    };

    /** Particles around which a process looks, of all. */
    struct Range
    {
      Range(const Particles &p, const SharedSurfaces &with_others)
        : first(static_cast<std::size_t>(with_others.first()))
        , last(std::min(p.count, static_cast<std::size_t>(with_others.last())))
      {
      }
      std::size_t first, last;
    };

    std::vector<SizeClass> size_classes(const Particles &p, const Range &own, const double search, const double margin)
    {
      double smallest = std::numeric_limits<double>::infinity();
      for (std::size_t i = own.first; i < own.last; ++i)
        smallest = std::min(smallest, p.radius_of(i));
      std::vector<std::vector<std::int32_t>> members;
      for (std::size_t i = own.first; i < own.last; ++i)
        {
          const auto of = static_cast<std::size_t>(std::ilogb(p.radius_of(i) / smallest));
          if (of >= members.size())
            members.resize(of + 1);
          members[of].push_back(static_cast<std::int32_t>(i));
        }
      std::vector<SizeClass> classes;
      for (auto &of : members)
        if (!of.empty())
          classes.emplace_back(p, std::move(of), search, margin);
      return classes;
    }

    /** A list lasts for many steps, and is short: a third of the mean radius. */
    double chosen_margin(const Particles &p)
    {
      double sum = 0;
      for (std::size_t i = 0; i < p.count; ++i)
        sum += p.radius_of(i);
      return sum / (3 * static_cast<double>(p.count));
    }
  } // namespace

  double NearFacets::displacement(const Particles            &particles,
                                  const std::vector<Surface> &surfaces,
                                  const SharedSurfaces       &with_others) const
  {
    const Range own(particles, with_others);
    double      of_particles = 0, of_vertices = 0;
    for (std::size_t i = own.first; i < own.last; ++i)
      of_particles = std::max(of_particles, (particles.position_of(i) - particle_reference[i]).squaredNorm());
    of_particles = with_others.largest(of_particles);
    auto before  = vertex_reference.begin();
    for (const Surface &surface : surfaces)
      for (const Eigen::Vector3d &x : surface.place)
        of_vertices = std::max(of_vertices, (x - *before++).squaredNorm());
    return std::sqrt(of_particles) + std::sqrt(of_vertices);
  }

  bool NearFacets::still_good(const Particles            &particles,
                              const std::vector<Surface> &surfaces,
                              const SharedSurfaces       &with_others)
  {
    if (stale)
      return false;
    if (path < margin)
      return true;
    // The sum of largest steps overrates displacement (different particles, there and back): measure it before searching.
    path = displacement(particles, surfaces, with_others);
    return path < 0.8 * margin;
  }

  void NearFacets::update(const Particles            &particles,
                          const std::vector<Surface> &surfaces,
                          const SharedSurfaces       &with_others)
  {
    if (!still_good(particles, surfaces, with_others))
      make_lists(particles, surfaces, chosen_margin(particles), with_others);
    next_update = margin;
    for (const double gap : smallest)
      next_update = std::min(next_update, gap);
  }

  void
  NearFacets::search_around(const Particles &particles, const std::vector<Surface> &surfaces, const double distance)
  {
    make_lists(particles, surfaces, std::nextafter(distance, 2 * distance), {});
  }

  void NearFacets::tabulate(const std::vector<FoundPair> &found, const std::size_t particles)
  {
    std::vector<std::size_t> next(particles + 1, 0);
    for (const FoundPair &each : found)
      ++next[static_cast<std::size_t>(each.particle) + 1];
    listed.clear();
    smallest.clear();
    from = {0};
    for (std::size_t i = 0; i < particles; ++i)
      {
        if (next[i + 1] > 0)
          {
            listed.push_back(static_cast<std::int32_t>(i));
            from.push_back(from.back() + next[i + 1]);
          }
        next[i + 1] += next[i];
      }
    near.resize(found.size());
    for (const FoundPair &each : found) // of each particle in the order of facets
      near[next[static_cast<std::size_t>(each.particle)]++] = each.pair;
    for (std::size_t k = 0; k < listed.size(); ++k)
      smallest.push_back(
        std::min_element(begin(k), end(k), [](const NearFacet &a, const NearFacet &b) { return a.gap < b.gap; })->gap);
  }

  void NearFacets::make_lists(const Particles            &particles,
                              const std::vector<Surface> &surfaces,
                              const double                nearer_than,
                              const SharedSurfaces       &with_others)
  {
    margin = nearer_than;
    const Range own(particles, with_others);
    double      search = 1;
    for (const Surface &surface : surfaces)
      search = std::max(search, surface.search_radius(1));
    std::vector<FoundPair>       found;
    const std::vector<SizeClass> classes = size_classes(particles, own, search, margin);
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      for (std::size_t f = 0; f < surfaces[s].mesh.size(); ++f)
        {
          const auto test = [&](const std::int32_t i) {
            if (!surfaces[s].meets_particle(i))
              return;
            const double gap =
              surfaces[s].distance(f, particles.position_of(i)) - surfaces[s].search_radius(particles.radius_of(i));
            ++test_count;
            if (gap <= margin)
              found.push_back({i, {static_cast<std::int32_t>(s), static_cast<std::int32_t>(f), gap}});
          };
          if (surfaces[s].mesh.is_plane())
            for (std::size_t i = own.first; i < own.last; ++i)
              test(static_cast<std::int32_t>(i));
          else
            {
              const FacetBounds bounds = surfaces[s].bounds(f);
              for (const SizeClass &of : classes)
                of.around(
                  bounds.low, bounds.high,
                  [&](const Eigen::Vector3d &centre, const double reach) {
                    return std::abs(bounds.normal.dot(centre - bounds.low_corner)) <= reach;
                  },
                  test);
            }
        }
    tabulate(with_others.of_all(std::move(found)), particles.count);
    particle_reference.resize(particles.count);
    for (std::size_t i = 0; i < particles.count; ++i)
      particle_reference[i] = particles.position_of(i);
    vertex_reference.clear();
    for (const Surface &surface : surfaces)
      vertex_reference.insert(vertex_reference.end(), surface.place.begin(), surface.place.end());
    path  = 0;
    stale = false;
    ++search_count;
  }
} // namespace dem
