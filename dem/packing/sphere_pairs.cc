#include "dem/packing/sphere_pairs.h"

#include "dem/core/records.h"
#include "dem/neighbours/cell_list.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    constexpr double touching   = 2;
    constexpr double near_reach = touching + 0.15;
    constexpr double wide_reach = touching + 1.0;
    /// Lists are made when a tenth of the margin is left, so that places of spheres are not needed in every step.
    constexpr double spare = 0.1 * (near_reach - touching);

    Eigen::Vector3d place(const base::Column &places, const std::size_t sphere)
    {
      return Eigen::Vector3d(&places[record_size * sphere]);
    }

    std::size_t whole_packs(const std::size_t lines) { return (lines + pack_size - 1) / pack_size * pack_size; }

    /** From counts, one place late, to where each begins. */
    void sum_up(std::vector<std::int32_t> &counts)
    {
      for (std::size_t i = 1; i < counts.size(); ++i)
        counts[i] += counts[i - 1];
    }
  } // namespace

  void SpherePairs::Start::note(const base::Column &now, const std::size_t spheres, const Cell &cell)
  {
    places.resize(spheres);
    for (std::size_t i = 0; i < spheres; ++i)
      places[i] = place(now, i);
    edge = cell.base()(0, 0);
  }

  double SpherePairs::Start::strayed(const base::Column &now, const Cell &cell) const
  {
    const double grown   = growth(cell);
    double       largest = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      largest = std::max(largest, (place(now, i) - grown * places[i]).squaredNorm());
    return std::sqrt(largest);
  }

  SpherePairs::SpherePairs(SphereShare &of_rank, base::Column &places, Cell &cell)
    : share(of_rank)
    , never(cell.enter({127, 0, 0}))
  {
    search(places, cell);
    pick(places, cell);
  }

  void SpherePairs::follow(base::Column &places, Cell &cell, const double growth, const double largest)
  {
    path                 = growth * path + largest;
    const double farther = picked.growth(cell) * near_reach;
    if (farther - 2 * path >= touching)
      return;
    path = share.largest(picked.strayed(places, cell)); // the path is longer than the way
    if (farther - 2 * path >= touching + spare)
      return;
    if (searched.growth(cell) * wide_reach - 2 * share.largest(searched.strayed(places, cell)) < near_reach)
      search(places, cell);
    pick(places, cell);
  }

  void SpherePairs::search(base::Column &places, Cell &cell)
  {
    const Wide before = std::move(wide);
    wide              = {};
    searched.note(places, share.own(), cell);
    wide.pair = find_pairs(share.all_places(places), std::vector<double>(share.all(), 1.0), 1.0, wide_reach - touching,
                           Eigen::Vector3d(cell.base().diagonal()), share.range());
    wide.line.assign(wide.pair.size(), -1);
    std::size_t old = 0;
    for (std::size_t k = 0; k < wide.pair.size(); ++k)
      {
        wide.image.push_back(cell.enter(wide.pair[k].shift));
        while (old < before.pair.size() && before.pair[old] < wide.pair[k])
          ++old;
        if (old < before.pair.size() && before.pair[old] == wide.pair[k])
          wide.line[k] = before.line[old];
      }
    choose_ghosts(places);
  }

  void SpherePairs::choose_ghosts(base::Column &places)
  {
    std::vector<std::int32_t> needed;
    for (const NeighbourPair &pair : wide.pair)
      for (const std::int32_t sphere : {pair.first, pair.second})
        if (!share.owns(sphere))
          needed.push_back(sphere);
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    share.set_ghosts(std::move(needed));
    places.resize(record_size * share.here());
    share.receive(places);
  }

  void SpherePairs::pick(const base::Column &places, Cell &cell)
  {
    std::vector<std::int32_t> near; // of the wide list
    for (std::size_t k = 0; k < wide.pair.size(); ++k)
      {
        const Eigen::Vector3d apart = place(places, static_cast<std::size_t>(share.record_of(wide.pair[k].second))) +
                                      Eigen::Vector3d(&cell.offset[record_size * wide.image[k]]) -
                                      place(places, static_cast<std::size_t>(share.record_of(wide.pair[k].first)));
        if (apart.squaredNorm() < near_reach * near_reach)
          near.push_back(static_cast<std::int32_t>(k));
        else
          wide.line[k] = -1;
      }
    const std::vector<std::int32_t> from = enter(near);
    carry_memory(from, lines());
    for (std::size_t l = 0; l < lines(); ++l)
      if (from[l] < 0)
        for (std::size_t d = 0; d < 3; ++d)
          branch[d][l] = places[record_size * second[l] + d] + cell.offset[record_size * image[l] + d] -
                         places[record_size * first[l] + d];
    enter_seconds();
    picked.note(places, share.own(), cell);
    path = 0;
  }

  void SpherePairs::enter_line(const std::int32_t wide_pair, std::vector<std::int32_t> &from)
  {
    const auto k = static_cast<std::size_t>(wide_pair);
    from.push_back(wide.line[k]);
    wide.line[k] = static_cast<std::int32_t>(first.size());
    first.push_back(share.record_of(wide.pair[k].first));
    second.push_back(share.record_of(wide.pair[k].second));
    image.push_back(wide.image[k]);
  }

  void SpherePairs::fill(const std::size_t to, std::vector<std::int32_t> &from)
  {
    from.resize(to, -1), first.resize(to, 0), second.resize(to, 0), image.resize(to, never);
  }

  std::vector<std::int32_t> SpherePairs::enter(const std::vector<std::int32_t> &near)
  {
    std::vector<std::int32_t> from;
    first.clear(), second.clear(), image.clear();
    const auto is_copy = [&](const std::int32_t k) {
      return !share.owns(wide.pair[static_cast<std::size_t>(k)].first);
    };
    const auto own_near = std::partition_point(near.begin(), near.end(), is_copy); // firsts of copies are lower
    for (auto k = near.begin(); k != own_near; ++k)
      enter_line(*k, from);
    copied                           = first.size();
    std::vector<std::int64_t> begins = share.begins(near.end() - own_near);
    const std::size_t         full = whole_packs(copied), before = begins[share.rank()] % pack_size;
    own_first = full + (own_near == near.end() ? 0 : before);
    fill(own_first, from);
    own_begin.assign(share.own() + 1, 0);
    for (auto k = own_near; k != near.end(); ++k)
      {
        enter_line(*k, from);
        ++own_begin[static_cast<std::size_t>(first.back()) + 1];
      }
    own_end           = first.size();
    own_begin.front() = static_cast<std::int32_t>(own_first);
    sum_up(own_begin);
    fill(whole_packs(own_end), from);
    line_blocks.plan(share, std::move(begins), full, own_first, lines());
    return from;
  }

  void SpherePairs::carry_memory(const std::vector<std::int32_t> &from, const std::size_t count)
  {
    for (auto *memory : {&branch, &shear})
      for (base::Column &column : *memory)
        {
          base::Column carried(count, 0.0);
          for (std::size_t l = 0; l < count; ++l)
            if (from[l] >= 0)
              carried[l] = column[from[l]];
          column.swap(carried);
        }
  }

  void SpherePairs::enter_seconds()
  {
    const auto each_own = [&](const auto &use) {
      for (const auto &[begin, end] : {copies(), own()})
        for (std::size_t l = begin; l < end; ++l)
          if (const auto sphere = static_cast<std::size_t>(second[l]); sphere < share.own())
            use(sphere, static_cast<std::int32_t>(l));
    };
    other_begin.assign(share.own() + 1, 0);
    each_own([&](const std::size_t sphere, std::int32_t) { ++other_begin[sphere + 1]; });
    sum_up(other_begin);
    others.resize(static_cast<std::size_t>(other_begin.back()));
    std::vector<std::int32_t> next(other_begin.begin(), other_begin.end() - 1);
    each_own([&](const std::size_t sphere, const std::int32_t line) { others[next[sphere]++] = line; });
  }
} // namespace dem
