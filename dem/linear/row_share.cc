#include "dem/linear/row_share.h"

#include "dem/ranks/shares.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    LinkEnds ends_of(const StiffnessOperator &stiffness)
    {
      LinkEnds ends;
      for (std::size_t l = 0; l < stiffness.links(); ++l)
        {
          const auto [first, second] = stiffness.ends(l);
          ends.first.push_back(first);
          ends.second.push_back(second);
        }
      return ends;
    }

    /** Those of ascending particles that lie in a range. */
    std::vector<std::int32_t> within(const std::vector<std::int32_t> &particles, const RankShare &share)
    {
      const auto at = [&](const std::size_t particle) {
        return std::lower_bound(particles.begin(), particles.end(), static_cast<std::int32_t>(particle));
      };
      return {at(share.first_particle), at(share.end_particle)};
    }
  } // namespace

  RowShare::RowShare(const StiffnessOperator &stiffness, Ranks *const all)
    : RowShare(stiffness.particles(), all ? ends_of(stiffness) : LinkEnds(), motions * load_lanes, all)
  {
  }

  RowShare::RowShare(const std::size_t particles, const LinkEnds &links, const std::size_t numbers, Ranks *const all)
    : field_size(numbers)
    , ranks(all)
    , begin{0, static_cast<std::int64_t>(particles)}
    , range{0, begin.back()}
  {
    if (ranks)
      find_messages(links);
  }

  void RowShare::add_message(const std::size_t                       rank,
                             std::vector<std::int32_t>               particles,
                             std::vector<RankMessage>               &messages,
                             std::vector<std::vector<std::int32_t>> &lists) const
  {
    if (particles.empty())
      return;
    messages.push_back({rank, std::vector<double>(particles.size() * field_size)});
    lists.push_back(std::move(particles));
  }

  void RowShare::find_messages(const LinkEnds &links)
  {
    const auto                   particles = static_cast<std::size_t>(range.end);
    const std::vector<RankShare> shares    = share_out(particles, links, ranks->size());
    const RankShare             &own       = shares[ranks->rank()];
    begin.clear();
    for (std::size_t r = 0; r < shares.size(); ++r)
      {
        begin.push_back(static_cast<std::int64_t>(shares[r].first_particle));
        add_message(r, within(own.ghosts, shares[r]), in, received);
        add_message(r, within(shares[r].ghosts, own), out, sent);
      }
    begin.push_back(static_cast<std::int64_t>(particles));
    range = {begin[ranks->rank()], begin[ranks->rank() + 1]};
  }

  std::vector<std::int32_t> RowShare::ghosts() const
  {
    std::vector<std::int32_t> all;
    for (const std::vector<std::int32_t> &from_rank : received) // ascending, as the ranks' particles are
      all.insert(all.end(), from_rank.begin(), from_rank.end());
    return all;
  }

  bool RowShare::everywhere(const bool here) const
  {
    double missing = here ? 0 : 1;
    if (ranks)
      ranks->largest(&missing, 1);
    return missing == 0;
  }

  void RowShare::receive(Fields &x)
  {
    if (!ranks)
      return;
    for (std::size_t m = 0; m < out.size(); ++m)
      for (std::size_t k = 0; k < sent[m].size(); ++k)
        std::copy_n(&x[sent[m][k] * field_size], field_size, &out[m].numbers[k * field_size]);
    ranks->exchange(out, in);
    for (std::size_t m = 0; m < in.size(); ++m)
      for (std::size_t k = 0; k < received[m].size(); ++k)
        std::copy_n(&in[m].numbers[k * field_size], field_size, &x[received[m][k] * field_size]);
  }

  void RowShare::gather(base::Column &column, const std::int64_t particles, const std::size_t numbers) const
  {
    if (!ranks)
      return;
    std::vector<std::size_t> bytes;
    for (const std::int64_t first : begin)
      bytes.push_back(static_cast<std::size_t>((first + particles - 1) / particles) * numbers * sizeof(double));
    ranks->gather(column.data(), bytes);
  }

  void
  RowShare::gather_rows(base::Column &column, const std::vector<std::int32_t> &rows, const std::size_t numbers) const
  {
    if (!ranks)
      return;
    std::vector<std::size_t> bytes;
    for (const std::int64_t first : begin)
      bytes.push_back(static_cast<std::size_t>(std::lower_bound(rows.begin(), rows.end(), first) - rows.begin()) *
                      numbers * sizeof(double));
    ranks->gather(column.data(), bytes);
  }

  void RowShare::gather(Fields &x) const { gather(x, 1, field_size); }

  void RowShare::gather_sums(base::Column &sums) const { gather(sums, particles_per_sum, load_lanes); }
} // namespace dem
