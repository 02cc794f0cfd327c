#include "dem/packing/line_blocks.h"

#include "dem/core/records.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr std::size_t lines_in_block = 1024; // a multiple of the pack
    static_assert(lines_in_block % pack_size == 0, "no block divides a pack");
  } // namespace

  std::size_t LineBlocks::first_block(const std::size_t rank) const
  {
    return (static_cast<std::size_t>(line_begin[rank]) + lines_in_block - 1) / lines_in_block;
  }

  std::size_t LineBlocks::blocks() const { return first_block(self + 1) - first_block(self); }

  std::int64_t LineBlocks::lines_in_head(const std::size_t rank) const
  {
    const auto end = static_cast<std::int64_t>(first_block(rank) * lines_in_block);
    return std::min(line_begin[rank + 1], end) - line_begin[rank];
  }

  std::size_t LineBlocks::owner_of_head(const std::size_t rank) const
  {
    const std::size_t block = static_cast<std::size_t>(line_begin[rank]) / lines_in_block;
    std::size_t       owner = rank;
    while (first_block(owner) > block)
      --owner;
    return owner;
  }

  void LineBlocks::plan(const SphereShare        &share,
                        std::vector<std::int64_t> begins,
                        const std::size_t         copies,
                        const std::size_t         own,
                        const std::size_t         end)
  {
    line_begin = std::move(begins);
    self       = share.rank();
    all_parts.clear();
    for (std::size_t at = 0; at < copies; at += lines_in_block)
      all_parts.push_back({at, std::min(at + lines_in_block, copies), Part::copy, 0});
    before_head      = own % pack_size;
    head_lines       = 0;
    const auto first = static_cast<std::size_t>(line_begin[self]);
    const auto here  = [&](const std::size_t line) { return std::min(line - first + own, end); };
    if (lines_in_head(self) > 0)
      {
        all_parts.push_back({own - before_head, here(first_block(self) * lines_in_block), Part::head, 0});
        head_lines = all_parts.back().end - all_parts.back().begin;
      }
    for (std::size_t block = first_block(self); block < first_block(self + 1); ++block)
      all_parts.push_back(
        {here(block * lines_in_block), here((block + 1) * lines_in_block), Part::block, block - first_block(self)});
  }

  void LineBlocks::add_heads(const SphereShare &share, std::vector<Pack> &sums, const Terms &terms) const
  {
    std::vector<RankMessage> out, in;
    if (const auto count = static_cast<std::size_t>(lines_in_head(self)); count > 0)
      {
        RankMessage &message = out.emplace_back();
        message.rank         = owner_of_head(self);
        for (std::size_t k = before_head; k < before_head + count; ++k)
          message.numbers.insert(message.numbers.end(), {terms.one[k], terms.other[k]});
      }
    for (std::size_t r = self + 1; r + 1 < line_begin.size(); ++r)
      if (lines_in_head(r) > 0 && owner_of_head(r) == self)
        in.push_back({r, std::vector<double>(2 * static_cast<std::size_t>(lines_in_head(r)))});
    share.together()->exchange(out, in);
    if (in.empty())
      return;
    alignas(64) double lanes[pack_size];
    store(sums.back(), lanes);
    for (const RankMessage &message : in)
      for (std::size_t k = 0; 2 * k < message.numbers.size(); ++k)
        {
          double &lane = lanes[(static_cast<std::size_t>(line_begin[message.rank]) + k) % pack_size];
          lane         = std::fma(-message.numbers[2 * k], message.numbers[2 * k + 1], lane);
        }
    sums.back() = load(lanes);
  }

  double LineBlocks::total(const SphereShare &share, std::vector<Pack> &sums, const Terms &terms) const
  {
    if (share.together())
      add_heads(share, sums, terms);
    std::vector<double> of_block(first_block(line_begin.size() - 1));
    for (std::size_t b = 0; b < sums.size(); ++b)
      of_block[first_block(self) + b] = sum_of(sums[b]);
    if (share.together())
      {
        std::vector<std::size_t> bytes;
        for (std::size_t r = 0; r < line_begin.size(); ++r)
          bytes.push_back(first_block(r) * sizeof(double));
        share.together()->gather(of_block.data(), bytes);
      }
    double sum = 0;
    for (const double each : of_block)
      sum += each;
    return sum;
  }
} // namespace dem
