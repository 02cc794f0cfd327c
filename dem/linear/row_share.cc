#include "dem/linear/row_share.h"

#include "dem/ranks/shares.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr std::size_t field_size = motions * load_lanes; ///< numbers of a particle

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

    void add_message(const std::size_t                       rank,
                     std::vector<std::int32_t>               particles,
                     std::vector<RankMessage>               &messages,
                     std::vector<std::vector<std::int32_t>> &lists)
    {
      if (particles.empty())
        return;
      messages.push_back({rank, std::vector<double>(particles.size() * field_size)});
      lists.push_back(std::move(particles));
    }
  } // namespace

  RowShare::RowShare(const StiffnessOperator &stiffness, Ranks *const all)
    : ranks(all)
    , begin{0, static_cast<std::int64_t>(stiffness.particles())}
    , range{0, begin.back()}
  {
    if (ranks)
      find_messages(stiffness);
  }

  void RowShare::find_messages(const StiffnessOperator &stiffness)
  {
    const std::vector<RankShare> shares = share_out(stiffness.particles(), ends_of(stiffness), ranks->size());
    const RankShare             &own    = shares[ranks->rank()];
    begin.clear();
    for (std::size_t r = 0; r < shares.size(); ++r)
      {
        begin.push_back(static_cast<std::int64_t>(shares[r].first_particle));
        add_message(r, within(own.ghosts, shares[r]), in, received);
        add_message(r, within(shares[r].ghosts, own), out, sent);
      }
    begin.push_back(static_cast<std::int64_t>(stiffness.particles()));
    range = {begin[ranks->rank()], begin[ranks->rank() + 1]};
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

  void RowShare::gather(Fields &x) const { gather(x, 1, field_size); }

  void RowShare::gather_sums(base::Column &sums) const { gather(sums, particles_per_sum, load_lanes); }
} // namespace dem
