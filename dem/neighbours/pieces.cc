#include "dem/neighbours/pieces.h"

#include <algorithm>
#include <numeric>

namespace dem
{
  namespace
  {
    /** Neighbours of each particle, one after the other. */
    struct Adjacency
    {
      std::vector<std::size_t> start, neighbour;

      Adjacency(const std::size_t particles, const std::vector<NeighbourPair> &links)
        : start(particles + 1, 0)
        , neighbour(2 * links.size())
      {
        for (const NeighbourPair &link : links)
          for (const std::int32_t end : {link.first, link.second})
            ++start[static_cast<std::size_t>(end) + 1];
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for (const NeighbourPair &link : links)
          {
            const auto J = static_cast<std::size_t>(link.first), K = static_cast<std::size_t>(link.second);
            neighbour[next[J]++] = K;
            neighbour[next[K]++] = J;
          }
      }
    };
  } // namespace

  std::size_t Pieces::strays() const
  {
    return static_cast<std::size_t>(std::count(size.begin(), size.end(), std::size_t(1)));
  }

  Pieces find_pieces(const std::size_t particles, const std::vector<NeighbourPair> &links)
  {
    const Adjacency          graph(particles, links);
    const std::size_t        unknown = particles;
    std::vector<std::size_t> found(particles, unknown), sizes, open;
    for (std::size_t seed = 0; seed < particles; ++seed)
      {
        if (found[seed] != unknown)
          continue;
        const std::size_t number = sizes.size();
        sizes.push_back(0);
        open        = {seed};
        found[seed] = number;
        while (!open.empty())
          {
            const std::size_t i = open.back();
            open.pop_back();
            ++sizes[number];
            for (std::size_t k = graph.start[i]; k < graph.start[i + 1]; ++k)
              if (const std::size_t other = graph.neighbour[k]; found[other] == unknown)
                {
                  found[other] = number;
                  open.push_back(other);
                }
          }
      }
    std::vector<std::size_t> order(sizes.size()), rank(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&sizes](const std::size_t a, const std::size_t b) { return sizes[a] > sizes[b]; });
    Pieces pieces;
    for (std::size_t r = 0; r < order.size(); ++r)
      {
        rank[order[r]] = r;
        pieces.size.push_back(sizes[order[r]]);
      }
    for (const std::size_t number : found)
      pieces.piece.push_back(rank[number]);
    return pieces;
  }
} // namespace dem
