#include "dem/ranks/shares.h"

#include "dem/core/simd.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace dem
{
  namespace
  {
    constexpr int most_rounds = 8; ///< of evening; two or three are usual

    void check_ends(const std::size_t particles, const LinkEnds &links)
    {
      if (links.first.size() != links.second.size())
        throw std::invalid_argument("shares: " + std::to_string(links.first.size()) + " first ends of links and " +
                                    std::to_string(links.second.size()) + " second ones; as many of both.");
      for (const auto *ends : {&links.first, &links.second})
        for (const std::int32_t end : *ends)
          if (end < 0 || static_cast<std::size_t>(end) >= particles)
            throw std::invalid_argument("shares: a link ends in particle " + std::to_string(end) + " of " +
                                        std::to_string(particles) + ", counted from 0.");
    }

    /** The rank of each brick. */
    std::vector<std::size_t> ranks_of_bricks(const std::vector<std::size_t> &first)
    {
      std::vector<std::size_t> rank(first.back());
      for (std::size_t r = 0; r + 1 < first.size(); ++r)
        std::fill(rank.begin() + static_cast<std::ptrdiff_t>(first[r]),
                  rank.begin() + static_cast<std::ptrdiff_t>(first[r + 1]), r);
      return rank;
    }

    /** Work of bricks with the copies that fall to them: cut links whose second end they have. */
    std::vector<std::int64_t>
    with_copies(std::vector<std::int64_t> work, const LinkEnds &links, const std::vector<std::size_t> &first)
    {
      const std::vector<std::size_t> rank = ranks_of_bricks(first);
      for (std::size_t l = 0; l < links.size(); ++l)
        if (rank[brick_of(links.first[l])] != rank[brick_of(links.second[l])])
          ++work[brick_of(links.second[l])];
      return work;
    }

    std::int64_t largest(const std::vector<std::int64_t> &work, const std::vector<std::size_t> &first)
    {
      std::int64_t most = 0;
      for (std::size_t r = 0; r + 1 < first.size(); ++r)
        {
          std::int64_t sum = 0;
          for (std::size_t b = first[r]; b < first[r + 1]; ++b)
            sum += work[b];
          most = std::max(most, sum);
        }
      return most;
    }

    std::vector<std::size_t>
    evened_ranges(const std::vector<std::int64_t> &owned, const LinkEnds &links, const std::size_t ranks)
    {
      std::vector<std::size_t>  best = even_ranges(owned, ranks);
      std::vector<std::int64_t> work = with_copies(owned, links, best);
      for (int round = 0; round < most_rounds; ++round)
        {
          const std::vector<std::size_t>  next    = even_ranges(work, ranks);
          const std::vector<std::int64_t> of_next = with_copies(owned, links, next);
          if (largest(of_next, next) >= largest(work, best))
            break;
          best = next;
          work = of_next;
        }
      return best;
    }

    /** Enter owned links and copies, ghosts not yet in order. */
    void enter_links(const LinkEnds &links, const std::vector<std::size_t> &rank, std::vector<RankShare> &shares)
    {
      for (std::size_t l = 0; l < links.size(); ++l)
        {
          const std::int32_t J = links.first[l], K = links.second[l];
          RankShare         &owner = shares[rank[brick_of(J)]], &other = shares[rank[brick_of(K)]];
          ++owner.owned;
          if (&owner == &other)
            continue;
          other.copied.push_back(static_cast<std::int32_t>(l));
          owner.ghosts.push_back(K);
          other.ghosts.push_back(J);
        }
    }

    RankNeighbour &neighbour_of(RankShare &share, const std::size_t rank)
    {
      auto found = std::lower_bound(share.neighbours.begin(), share.neighbours.end(), rank,
                                    [](const RankNeighbour &n, const std::size_t r) { return n.rank < r; });
      if (found == share.neighbours.end() || found->rank != rank)
        found = share.neighbours.insert(found, RankNeighbour{rank, 0, 0});
      return *found;
    }

    void sort_ghosts(const std::vector<std::size_t> &rank, std::vector<RankShare> &shares)
    {
      for (std::size_t r = 0; r < shares.size(); ++r)
        {
          std::vector<std::int32_t> &ghosts = shares[r].ghosts;
          std::sort(ghosts.begin(), ghosts.end());
          ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
          for (const std::int32_t ghost : ghosts)
            {
              const std::size_t owner = rank[brick_of(ghost)];
              ++neighbour_of(shares[r], owner).received;
              ++neighbour_of(shares[owner], r).sent;
            }
        }
    }
  } // namespace

  std::size_t RankShare::copied_lines() const
  {
    std::size_t packs = 0;
    for (std::size_t k = 0; k < copied.size(); ++k)
      packs += k == 0 || copied[k] / pack_size != copied[k - 1] / pack_size;
    return packs * pack_size;
  }

  std::size_t RankShare::sent() const
  {
    std::size_t sum = 0;
    for (const RankNeighbour &neighbour : neighbours)
      sum += neighbour.sent;
    return sum;
  }

  std::vector<RankShare> share_out(const std::size_t particles, const LinkEnds &links, const std::size_t ranks)
  {
    check_ends(particles, links);
    const std::vector<std::int64_t> owned = work_of_bricks(particles, links);
    const std::vector<std::size_t>  first = evened_ranges(owned, links, ranks);
    const std::vector<std::int64_t> work  = with_copies(owned, links, first);
    std::vector<RankShare>          shares(ranks);
    const std::vector<std::size_t>  rank = ranks_of_bricks(first);
    enter_links(links, rank, shares);
    sort_ghosts(rank, shares);
    for (std::size_t r = 0; r < ranks; ++r)
      {
        RankShare &share     = shares[r];
        share.first_brick    = first[r];
        share.end_brick      = first[r + 1];
        share.first_particle = std::min(first[r] * particles_per_brick, particles);
        share.end_particle   = std::min(first[r + 1] * particles_per_brick, particles);
        for (std::size_t b = first[r]; b < first[r + 1]; ++b)
          share.work += work[b];
      }
    return shares;
  }
} // namespace dem
