#include "apps/specimens/rank_shares.h"

#include "dem/specimen/rank_shares.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  RankTotals totals_of(const std::vector<dem::RankShare> &shares)
  {
    RankTotals all;
    all.least_bricks = shares.front().end_brick - shares.front().first_brick;
    for (const dem::RankShare &share : shares)
      {
        const std::size_t bricks = share.end_brick - share.first_brick;
        all.owned += share.owned;
        all.copied += share.copied.size();
        all.copied_lines += share.copied_lines();
        all.ghosts += share.ghosts.size();
        all.least_bricks    = std::min(all.least_bricks, bricks);
        all.most_bricks     = std::max(all.most_bricks, bricks);
        all.most_ghosts     = std::max(all.most_ghosts, share.ghosts.size());
        all.most_neighbours = std::max(all.most_neighbours, share.neighbours.size());
        all.most_bytes      = std::max(all.most_bytes, dem::bytes_per_ghost * share.sent());
        all.work += static_cast<double>(share.work);
        all.largest_work = std::max(all.largest_work, static_cast<double>(share.work));
      }
    return all;
  }

  std::string rank_lines(const dem::ObservedSpecimen &body, const std::size_t ranks, const double seconds_per_step)
  {
    const std::vector<dem::RankShare> shares = dem::share_out(body, ranks);
    const RankTotals                  all    = totals_of(shares);
    const dem::Network                network;
    const double                      alone = all.work - static_cast<double>(all.copied),
                 particles                  = static_cast<double>(body.counts().particles);
    std::size_t most_bytes                  = 0;
    for (const dem::RankShare &share : shares)
      most_bytes = std::max(most_bytes, dem::least_bytes(body, share));
    std::string text = fmt::format("  ranks        {}, of {} to {} bricks of {} particles\n", ranks, all.least_bricks,
                                   all.most_bricks, dem::particles_per_brick);
    text += fmt::format("  memory       {:.3g} MB of particles and links in a rank, and {:.3g} MB where all is read at "
                        "once\n",
                        1e-6 * static_cast<double>(most_bytes), 1e-6 * static_cast<double>(body.bytes()));
    text += fmt::format(
      "  shares       {} links and {} copies of cut ones ({:.2g} %, with others of their packs {:.2g} %); the "
      "largest has {:.2f} times the mean work\n",
      all.owned, all.copied, 100 * all.copies(), 100 * all.twice(),
      all.largest_work * static_cast<double>(ranks) / all.work);
    text +=
      fmt::format("  ghosts       {} ({:.2g} % of the particles), at most {} of a rank, with {} neighbours\n",
                  all.ghosts, 100 * static_cast<double>(all.ghosts) / particles, all.most_ghosts, all.most_neighbours);
    text += fmt::format("  exchange     at most {:.4g} kB sent by a rank at every step\n",
                        1e-3 * static_cast<double>(all.most_bytes));
    if (seconds_per_step > 0)
      text += fmt::format("  efficiency   {:.0f} % expected of a network of {:g} us and {:g} GB/s\n",
                          100 * dem::parallel_efficiency(shares, seconds_per_step / alone, network),
                          1e6 * network.latency, 1e-9 * network.bandwidth);
    return text;
  }
} // namespace apps
