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

    std::vector<Eigen::Vector3d> all_places(const base::Column &places)
    {
      std::vector<Eigen::Vector3d> all(places.size() / record_size);
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = place(places, i);
      return all;
    }

    /** From counts, one place late, to where each begins. */
    void sum_up(std::vector<std::int32_t> &counts)
    {
      for (std::size_t i = 1; i < counts.size(); ++i)
        counts[i] += counts[i - 1];
    }
  } // namespace

  void SpherePairs::Start::note(const base::Column &now, const Cell &cell)
  {
    places = all_places(now);
    edge   = cell.base()(0, 0);
  }

  double SpherePairs::Start::strayed(const base::Column &now, const Cell &cell) const
  {
    const double grown   = growth(cell);
    double       largest = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      largest = std::max(largest, (place(now, i) - grown * places[i]).squaredNorm());
    return std::sqrt(largest);
  }

  SpherePairs::SpherePairs(const std::size_t count, const base::Column &places, Cell &cell)
    : spheres(count)
    , never(cell.enter({127, 0, 0}))
  {
    search(places, cell);
    pick(places, cell);
  }

  void SpherePairs::follow(const base::Column &places, Cell &cell, const double growth, const double largest)
  {
    path                 = growth * path + largest;
    const double farther = picked.growth(cell) * near_reach;
    if (farther - 2 * path >= touching)
      return;
    path = picked.strayed(places, cell); // the path is longer than the way
    if (farther - 2 * path >= touching + spare)
      return;
    if (searched.growth(cell) * wide_reach - 2 * searched.strayed(places, cell) < near_reach)
      search(places, cell);
    pick(places, cell);
  }

  void SpherePairs::search(const base::Column &places, Cell &cell)
  {
    const Wide before = std::move(wide);
    searched.note(places, cell);
    const std::vector<NeighbourPair> found = find_pairs(searched.places, std::vector<double>(spheres, 1.0), 1.0,
                                                        wide_reach - touching, Eigen::Vector3d(cell.base().diagonal()));
    wide                                   = {};
    wide.begin.assign(spheres + 1, 0);
    wide.line.assign(found.size(), -1);
    for (std::size_t k = 0; k < found.size(); ++k)
      {
        const auto i = static_cast<std::size_t>(found[k].first);
        ++wide.begin[i + 1];
        wide.second.push_back(found[k].second);
        wide.image.push_back(cell.enter(found[k].shift));
        if (before.begin.empty())
          continue;
        for (std::int32_t o = before.begin[i]; o < before.begin[i + 1]; ++o)
          if (before.second[o] == wide.second[k] && before.image[o] == wide.image[k])
            wide.line[k] = before.line[o];
      }
    sum_up(wide.begin);
  }

  void SpherePairs::pick(const base::Column &places, Cell &cell)
  {
    std::vector<std::int32_t> from; // lines before
    first.clear(), second.clear(), image.clear();
    own_begin.assign(spheres + 1, 0);
    for (std::size_t i = 0; i < spheres; ++i)
      {
        for (std::int32_t k = wide.begin[i]; k < wide.begin[i + 1]; ++k)
          {
            const Eigen::Vector3d apart = place(places, static_cast<std::size_t>(wide.second[k])) +
                                          Eigen::Vector3d(&cell.offset[record_size * wide.image[k]]) - place(places, i);
            const bool near = apart.squaredNorm() < near_reach * near_reach;
            if (near)
              {
                from.push_back(wide.line[k]);
                first.push_back(static_cast<std::int32_t>(i));
                second.push_back(wide.second[k]);
                image.push_back(wide.image[k]);
              }
            wide.line[k] = near ? static_cast<std::int32_t>(first.size()) - 1 : -1;
          }
        own_begin[i + 1] = static_cast<std::int32_t>(first.size());
      }
    pairs                    = first.size();
    const std::size_t filled = (pairs + pack_size - 1) / pack_size * pack_size;
    from.resize(filled, -1), first.resize(filled, 0), second.resize(filled, 0), image.resize(filled, never);
    carry_memory(from, filled);
    for (std::size_t l = 0; l < filled; ++l)
      if (from[l] < 0)
        for (std::size_t d = 0; d < 3; ++d)
          branch[d][l] = places[record_size * second[l] + d] + cell.offset[record_size * image[l] + d] -
                         places[record_size * first[l] + d];
    enter_seconds();
    picked.note(places, cell);
    path = 0;
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
    other_begin.assign(spheres + 1, 0);
    for (std::size_t l = 0; l < pairs; ++l)
      ++other_begin[second[l] + 1];
    sum_up(other_begin);
    others.resize(pairs);
    std::vector<std::int32_t> next(other_begin.begin(), other_begin.end() - 1);
    for (std::size_t l = 0; l < pairs; ++l)
      others[next[second[l]]++] = static_cast<std::int32_t>(l);
  }
} // namespace dem
