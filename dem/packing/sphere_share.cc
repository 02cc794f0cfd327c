#include "dem/packing/sphere_share.h"

#include "dem/core/records.h"
#include "dem/ranks/bricks.h"
#include "dem/ranks/in_turn.h"
#include "dem/ranks/of_each_rank.h"

#include <algorithm>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr std::size_t place_and_turn = 6; ///< numbers of a record
  }

  SphereShare::SphereShare(const std::size_t spheres, Ranks *const all)
    : ranks(all)
    , begin{0, spheres}
  {
    if (!ranks)
      return;
    self  = ranks->rank();
    begin = ranges_by_number(spheres, ranks->size());
  }

  PairsOf SphereShare::range() const
  {
    return {static_cast<std::int32_t>(begin[self]), static_cast<std::int32_t>(begin[self + 1])};
  }

  std::int32_t SphereShare::record_of(const std::int32_t sphere) const
  {
    if (owns(sphere))
      return sphere - static_cast<std::int32_t>(first());
    return static_cast<std::int32_t>(own()) +
           static_cast<std::int32_t>(std::lower_bound(ghosts.begin(), ghosts.end(), sphere) - ghosts.begin());
  }

  std::size_t SphereShare::owner_of(const std::int32_t sphere) const
  {
    return static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), static_cast<std::size_t>(sphere)) -
                                    begin.begin()) -
           1;
  }

  void SphereShare::set_ghosts(std::vector<std::int32_t> needed)
  {
    if (!ranks)
      return;
    ghosts = std::move(needed);
    std::vector<std::vector<std::int32_t>> of_rank(ranks->size());
    for (const std::int32_t ghost : ghosts)
      of_rank[owner_of(ghost)].push_back(ghost);
    sent = ranks->deliver(of_rank);
    out.clear(), in.clear();
    for (std::size_t r = 0; r < ranks->size(); ++r)
      {
        if (!sent[r].empty())
          out.push_back({r, std::vector<double>(place_and_turn * sent[r].size())});
        if (!of_rank[r].empty())
          in.push_back({r, std::vector<double>(place_and_turn * of_rank[r].size())});
      }
  }

  void SphereShare::receive(base::Column &records)
  {
    if (!ranks)
      return;
    for (RankMessage &message : out)
      {
        double *to = message.numbers.data();
        for (const std::int32_t sphere : sent[message.rank])
          to = std::copy_n(&records[record_size * static_cast<std::size_t>(record_of(sphere))], place_and_turn, to);
      }
    ranks->exchange(out, in);
    std::size_t record = own(); // ghosts ascend, as the ranks' spheres do
    for (const RankMessage &message : in)
      for (std::size_t at = 0; at < message.numbers.size(); at += place_and_turn)
        std::copy_n(&message.numbers[at], place_and_turn, &records[record_size * record++]);
  }

  std::vector<Eigen::Vector3d> SphereShare::all_places(const base::Column &records) const
  {
    std::vector<Eigen::Vector3d> places(all());
    for (std::size_t i = 0; i < own(); ++i)
      places[first() + i] = Eigen::Vector3d(&records[record_size * i]);
    if (ranks)
      {
        std::vector<std::size_t> bytes;
        for (const std::size_t sphere : begin)
          bytes.push_back(sphere * sizeof(Eigen::Vector3d));
        ranks->gather(places.data(), bytes);
      }
    return places;
  }

  double SphereShare::largest(double here) const
  {
    if (ranks)
      ranks->largest(&here, 1);
    return here;
  }

  std::vector<std::int64_t> SphereShare::begins(const std::int64_t here) const
  {
    if (!ranks)
      return {0, here};
    std::vector<std::int64_t> sums(1, 0);
    for (const std::int64_t each : of_each_rank(*ranks, here))
      sums.push_back(sums.back() + each);
    return sums;
  }

  void SphereShare::in_turn(double *const numbers, const std::size_t count, const std::function<void()> &go_on) const
  {
    if (ranks)
      dem::in_turn(*ranks, numbers, count, go_on);
    else
      go_on();
  }
} // namespace dem
