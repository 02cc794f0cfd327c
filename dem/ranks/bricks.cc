#include "dem/ranks/bricks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dem
{
  std::vector<std::int64_t> work_of_bricks(const std::size_t particles, const LinkEnds &links)
  {
    constexpr auto            of_brick = static_cast<std::int64_t>(particles_per_brick);
    std::vector<std::int64_t> work(particle_blocks(particles), updates_per_particle * of_brick);
    if (particles % particles_per_brick != 0)
      work.back() = updates_per_particle * static_cast<std::int64_t>(particles % particles_per_brick);
    for (const std::int32_t owner : links.first)
      ++work.at(brick_of(owner));
    return work;
  }

  std::vector<std::size_t> even_ranges(const std::vector<std::int64_t> &work, const std::size_t ranks)
  {
    if (ranks == 0)
      throw std::invalid_argument("bricks: shared out among 0 ranks; at least 1.");
    std::vector<std::int64_t> before(work.size() + 1, 0);
    for (std::size_t b = 0; b < work.size(); ++b)
      before[b + 1] = before[b] + work[b];
    std::vector<std::size_t> first(ranks + 1, 0);
    for (std::size_t r = 1; r < ranks; ++r)
      {
        const double part = static_cast<double>(before.back()) * static_cast<double>(r) / static_cast<double>(ranks);
        std::size_t &b    = first[r];
        b                 = first[r - 1];
        while (b < work.size() &&
               std::abs(static_cast<double>(before[b + 1]) - part) < std::abs(static_cast<double>(before[b]) - part))
          ++b;
      }
    first[ranks] = work.size();
    return first;
  }

  std::vector<std::size_t> ranges_by_number(const std::size_t particles, const std::size_t ranks)
  {
    std::vector<std::size_t> first = even_ranges(std::vector<std::int64_t>(particle_blocks(particles), 1), ranks);
    for (std::size_t &each : first)
      each = std::min(each * particles_per_brick, particles);
    return first;
  }
} // namespace dem
