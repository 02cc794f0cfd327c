#include "dem/contacts/shared_search.h"

#include "dem/ranks/bricks.h"
#include "dem/ranks/ranks.h"

#include <algorithm>
#include <utility>

namespace dem
{
  SharedSearch::SharedSearch(const std::size_t rank, std::vector<std::int32_t> begin, Gather together)
    : self(rank)
    , particle_begin(std::move(begin))
    , gather(std::move(together))
  {
  }

  PairsOf SharedSearch::own() const
  {
    return gather ? PairsOf{particle_begin[self], particle_begin[self + 1]} : PairsOf();
  }

  void SharedSearch::drop_others(std::vector<NeighbourPair> &pairs) const
  {
    const PairsOf mine = own();
    pairs.erase(
      std::remove_if(pairs.begin(), pairs.end(), [&](const NeighbourPair &pair) { return !mine.has(pair.first); }),
      pairs.end());
  }

  template <typename Record>
  std::vector<Record> SharedSearch::of_each(const Record own) const
  {
    std::vector<Record>      all(particle_begin.size() - 1, own);
    std::vector<std::size_t> begin;
    for (std::size_t r = 0; r <= all.size(); ++r)
      begin.push_back(r * sizeof(Record));
    gather(all.data(), begin);
    return all;
  }

  double SharedSearch::largest(const double own) const
  {
    if (!gather)
      return own;
    const std::vector<double> of = of_each(own);
    return *std::max_element(of.begin(), of.end());
  }

  std::vector<NeighbourPair> SharedSearch::of_all(std::vector<NeighbourPair> pairs) const
  {
    if (!gather)
      return pairs;
    const std::vector<std::int64_t> count = of_each(static_cast<std::int64_t>(pairs.size()));
    const std::size_t               ranks = count.size();
    std::vector<std::size_t>        begin(ranks + 1, 0);

    // What is gathered consists of whole doubles: an odd number of pairs is filled up by one.
    for (std::size_t r = 0; r < ranks; ++r)
      begin[r + 1] = begin[r] + sizeof(NeighbourPair) * static_cast<std::size_t>(count[r] + count[r] % 2);
    std::vector<NeighbourPair> all(begin.back() / sizeof(NeighbourPair));
    std::copy(pairs.begin(), pairs.end(),
              all.begin() + static_cast<std::ptrdiff_t>(begin[self] / sizeof(NeighbourPair)));
    pairs = {};
    gather(all.data(), begin);
    auto end = all.begin();
    for (std::size_t r = 0; r < ranks; ++r)
      {
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(begin[r] / sizeof(NeighbourPair));
        end             = std::move(from, from + static_cast<std::ptrdiff_t>(count[r]), end);
      }
    all.erase(end, all.end());
    return all;
  }

  SharedSearch search_by(Ranks *const ranks, const std::size_t particles)
  {
    if (!ranks)
      return {};
    const std::vector<std::size_t> begin = ranges_by_number(particles, ranks->size());
    return {ranks->rank(), {begin.begin(), begin.end()}, [ranks](void *array, const std::vector<std::size_t> &bytes) {
              ranks->gather(array, bytes);
            }};
  }
} // namespace dem
