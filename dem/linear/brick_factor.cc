#include "dem/linear/brick_factor.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr int rows_of_brick = static_cast<int>(particles_per_brick);

    /** Of the undamaged diagonal; well above the rounding of single precision, so that no pivot vanishes where nothing resists. */
    constexpr double keeps_pivots = 1e-6;

    /** Of one brick's rows among themselves, both counted from the brick's first. */
    std::shared_ptr<const BlockPattern>
    pattern_of_brick(const LinkEnds &links, const std::vector<std::size_t> &inside, const int first, const int rows)
    {
      std::vector<std::pair<int, int>> joined;
      for (const std::size_t l : inside)
        joined.emplace_back(links.first[l] - first, links.second[l] - first);
      return std::make_shared<BlockPattern>(rows, joined);
    }
  } // namespace

  BrickFactor::BrickFactor(const RowParticles      &rows,
                           const LinkEnds          &links,
                           const RowShare          &shared,
                           const BrickBorder *const beside)
    : share(shared)
    , border(beside)
    , rigid(rows, links, shared, beside)
  {
    const auto first = static_cast<int>(share.own().first), end = static_cast<int>(share.own().end);
    std::vector<std::vector<std::size_t>> inside(
      static_cast<std::size_t>((end - first + rows_of_brick - 1) / rows_of_brick));
    for (std::size_t l = 0; l < links.size(); ++l)
      if (links.first[l] >= first && links.first[l] < end && brick_of(links.first[l]) == brick_of(links.second[l]))
        inside[static_cast<std::size_t>((links.first[l] - first) / rows_of_brick)].push_back(l);
    for (std::size_t brick = 0; brick < inside.size(); ++brick)
      {
        const int first_of = first + rows_of_brick * static_cast<int>(brick);
        pattern.push_back(pattern_of_brick(links, inside[brick], first_of, std::min(rows_of_brick, end - first_of)));
      }
    factor.resize(pattern.size());
  }

  bool BrickFactor::compute_brick(const std::size_t brick, const BlockMatrix &matrix, const Eigen::VectorXd &diagonal)
  {
    const int   first = static_cast<int>(share.own().first) + rows_of_brick * static_cast<int>(brick);
    BlockMatrix own(pattern[brick]);
    for (int row = 0; row < own.rows(); ++row)
      for (int k = own.begin(row); k < own.begin(row + 1); ++k)
        own.block(k) = matrix.block(matrix.place(first + row, first + own.column(k)));
    return factor[brick].compute(own, keeps_pivots * diagonal.segment(motions * first, own.size()));
  }

  bool BrickFactor::compute(const BlockMatrix &matrix, const Eigen::VectorXd &diagonal)
  {
    std::vector<char> done(factor.size(), 0);
    const auto        bricks = static_cast<std::int64_t>(factor.size());
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t brick = 0; brick < bricks; ++brick)
      done[static_cast<std::size_t>(brick)] = compute_brick(static_cast<std::size_t>(brick), matrix, diagonal);
    const bool all = std::all_of(done.begin(), done.end(), [](const char one) { return one != 0; });
    return share.everywhere(all) && rigid.compute(matrix, diagonal);
  }

  void BrickFactor::apply(const double *const r, float *const z, const Eigen::VectorXd &s, Eigen::VectorXd &y)
  {
    if (border)
      y = border->answer(s);
    const auto bricks = static_cast<std::int64_t>(factor.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t brick = 0; brick < bricks; ++brick)
      {
        const std::int64_t at = brick * rows_of_brick * motions;
        factor[static_cast<std::size_t>(brick)].apply<1>({r + at}, {z + at});
      }
    rigid.add_answer(r, z, s, y);
  }
} // namespace dem
