#include "dem/ranks/exchange_cost.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  double seconds_of_exchange(const RankShare &share, const Network &network)
  {
    const auto particles = static_cast<double>(std::max(share.sent(), share.received()));
    return static_cast<double>(share.neighbours.size()) * network.latency +
           particles * static_cast<double>(bytes_per_ghost) / network.bandwidth;
  }

  double seconds_of_step(const std::vector<RankShare> &shares, const double seconds_per_work, const Network &network)
  {
    double slowest = 0;
    for (const RankShare &share : shares)
      slowest =
        std::max(slowest, seconds_per_work * static_cast<double>(share.work) + seconds_of_exchange(share, network));
    if (shares.size() == 1)
      return slowest;
    const double of_bricks = static_cast<double>(bytes_per_brick * shares.back().end_brick) / network.bandwidth;
    return slowest + of_bricks +
           meetings_per_step * network.latency * std::ceil(std::log2(static_cast<double>(shares.size())));
  }

  double
  parallel_efficiency(const std::vector<RankShare> &shares, const double seconds_per_work, const Network &network)
  {
    double alone = 0;
    for (const RankShare &share : shares)
      alone += static_cast<double>(share.work) - static_cast<double>(share.copied.size());
    return seconds_per_work * alone /
           (static_cast<double>(shares.size()) * seconds_of_step(shares, seconds_per_work, network));
  }
} // namespace dem
