#include "dem/linear/rigid_bricks.h"

#include "dem/network/slip_matrices.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr double kept_regular_by = 1e-9; ///< of the undamaged diagonal

    int number_of_bricks(const std::size_t rows)
    {
      return static_cast<int>((rows + particles_per_brick - 1) / particles_per_brick);
    }

    /** Behind the last brick of a range, which begins with a brick; a rank that has none begins behind the last row. */
    int end_brick(const ParticleRange &of)
    {
      return of.first == of.end ? 0 : number_of_bricks(static_cast<std::size_t>(of.end));
    }

    std::vector<std::pair<int, int>> joined_bricks(const LinkEnds &links)
    {
      std::vector<std::pair<int, int>> joined;
      for (std::size_t l = 0; l < links.size(); ++l)
        if (brick_of(links.first[l]) != brick_of(links.second[l]))
          joined.emplace_back(static_cast<int>(brick_of(links.first[l])), static_cast<int>(brick_of(links.second[l])));
      return joined;
    }
  } // namespace

  RigidBricks::RigidBricks(const RowParticles      &rows,
                           const LinkEnds          &links,
                           const RowShare          &shared,
                           const BrickBorder *const beside)
    : particles(rows)
    , share(shared)
    , border(beside)
    , middle(static_cast<std::size_t>(number_of_bricks(rows.place.size())), Eigen::Vector3d::Zero())
    , pattern(number_of_bricks(rows.place.size()), joined_bricks(links))
  {
    std::vector<double> members(middle.size(), 0.0);
    for (std::size_t row = 0; row < particles.place.size(); ++row)
      {
        middle[row / particles_per_brick] += particles.place[row];
        members[row / particles_per_brick] += 1;
      }
    for (std::size_t brick = 0; brick < middle.size(); ++brick)
      {
        middle[brick] /= members[brick];
        widest = std::max(widest, static_cast<std::size_t>(pattern.begin(static_cast<int>(brick) + 1) -
                                                           pattern.begin(static_cast<int>(brick))));
      }
    blocks.resize(middle.size() * widest * motions * motions);
    forces.resize(middle.size() * motions);
  }

  Block RigidBricks::rigid(const int row) const
  {
    const auto            i    = static_cast<std::size_t>(row);
    const Eigen::Vector3d arm  = particles.place[i] - middle[i / particles_per_brick];
    Block                 all  = Block::Identity();
    all.topRightCorner<3, 3>() = -cross_product_matrix(arm) / particles.scale;
    for (int c = 0; c < motions; ++c)
      if (particles.held[i] >> c & 1)
        all.row(c).setZero();
    return all;
  }

  void RigidBricks::condense(const BlockMatrix &matrix)
  {
    const int first = static_cast<int>(share.own().first), end = static_cast<int>(share.own().end);
#pragma omp parallel for schedule(static)
    for (int brick = first / rows_per_brick; brick < end_brick(share.own()); ++brick)
      {
        double *const own = &blocks[static_cast<std::size_t>(brick) * widest * motions * motions];
        std::fill_n(own, widest * motions * motions, 0.0);
        for (int row = brick * rows_per_brick; row < std::min(end, (brick + 1) * rows_per_brick); ++row)
          {
            const Block of_row = rigid(row).transpose();
            for (int k = matrix.begin(row); k < matrix.begin(row + 1); ++k)
              {
                const int         other = matrix.column(k);
                const int         place = pattern.place(brick, other / rows_per_brick) - pattern.begin(brick);
                Eigen::Map<Block> block(own + place * motions * motions);
                const Block       moved = matrix.block(k) * rigid(other);
                block.noalias() += of_row * moved;
              }
          }
      }
    share.gather(blocks, rows_per_brick, widest * motions * motions);
  }

  bool RigidBricks::compute(const BlockMatrix &matrix, const Eigen::VectorXd &diagonal)
  {
    condense(matrix);
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(pattern.size());
    for (int row = 0; row < static_cast<int>(particles.place.size()); ++row)
      kept.segment<motions>(motions * (row / rows_per_brick)) +=
        rigid(row).cwiseAbs2().transpose() * diagonal.segment<motions>(motions * row);
    const double mean = kept.mean();
    kept              = (kept.array() > 1e-12 * mean).select(kept_regular_by * kept, mean).eval();
    return factor.factorize(matrix_of_bricks(kept), false);
  }

  UnsymmetricFactor::Sparse RigidBricks::matrix_of_bricks(const Eigen::VectorXd &kept) const
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (int brick = 0; brick < pattern.rows(); ++brick)
      for (int k = pattern.begin(brick); k < pattern.begin(brick + 1); ++k)
        {
          const std::size_t at =
            static_cast<std::size_t>(brick) * widest + static_cast<std::size_t>(k - pattern.begin(brick));
          const Eigen::Map<const Block> block(&blocks[at * motions * motions]);
          for (int c = 0; c < motions; ++c)
            for (int r = 0; r < motions; ++r)
              entries.emplace_back(motions * brick + r, motions * pattern.column(k) + c, block(r, c));
        }
    for (int i = 0; i < pattern.size(); ++i)
      entries.emplace_back(i, i, kept[i]);
    add_border(entries);
    UnsymmetricFactor::Sparse matrix(unknowns(), unknowns());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  int RigidBricks::unknowns() const
  {
    return pattern.size() + (border ? static_cast<int>(border->number_of_modes()) : 0);
  }

  UnsymmetricFactor::Sparse RigidBricks::on_bricks(const UnsymmetricFactor::Sparse &on_rows) const
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < border->rows().size(); ++k)
      {
        const int   row    = border->rows()[k];
        const Block of_row = rigid(row);
        for (int c = 0; c < motions; ++c)
          for (int m = 0; m < motions; ++m)
            if (of_row(c, m) != 0)
              entries.emplace_back(motions * (row / rows_per_brick) + m, static_cast<int>(motions * k) + c,
                                   of_row(c, m));
      }
    UnsymmetricFactor::Sparse of_bricks(pattern.size(), on_rows.rows());
    of_bricks.setFromTriplets(entries.begin(), entries.end());
    return of_bricks * on_rows;
  }

  void RigidBricks::add_border(std::vector<Eigen::Triplet<double>> &entries) const
  {
    if (!border)
      return;
    using Sparse                     = UnsymmetricFactor::Sparse;
    const BrickBorder::Blocks beside = border->by_modes();
    const auto                add    = [&](const Sparse &block, const int row, const int column) {
      for (Eigen::Index k = 0; k < block.outerSize(); ++k)
        for (Sparse::InnerIterator entry(block, k); entry; ++entry)
          entries.emplace_back(row + static_cast<int>(entry.row()), column + static_cast<int>(entry.col()),
                                                 entry.value());
    };
    const int first = pattern.size();
    add(on_bricks(beside.C), 0, first);
    add(Sparse(on_bricks(Sparse(beside.D.transpose())).transpose()), first, 0);
    add(beside.E, first, first);
  }

  void RigidBricks::add_answer(const double *const r, float *const z, const Eigen::VectorXd &s, Eigen::VectorXd &y)
  {
    const int first = static_cast<int>(share.own().first), end = static_cast<int>(share.own().end);
#pragma omp parallel for schedule(static)
    for (int brick = first / rows_per_brick; brick < end_brick(share.own()); ++brick)
      {
        Eigen::Matrix<double, motions, 1> sum = Eigen::Matrix<double, motions, 1>::Zero();
        for (int row = brick * rows_per_brick; row < std::min(end, (brick + 1) * rows_per_brick); ++row)
          sum += rigid(row).transpose() * Eigen::Map<const Eigen::Matrix<double, motions, 1>>(
                                            r + static_cast<std::ptrdiff_t>(motions) * (row - first));
        std::copy_n(sum.data(), motions, &forces[static_cast<std::size_t>(motions) * brick]);
      }
    share.gather(forces, rows_per_brick, motions);
    Eigen::VectorXd right(unknowns());
    right.head(pattern.size()) = Eigen::Map<const Eigen::VectorXd>(forces.data(), pattern.size());
    if (border)
      right.tail(border->number_of_modes()) = border->on_modes(s);
    const Eigen::VectorXd answer = factor.solve(right);
    if (border)
      y += border->of_modes(answer.tail(border->number_of_modes()));
#pragma omp parallel for schedule(static)
    for (int row = first; row < end; ++row)
      {
        const Eigen::Matrix<double, motions, 1> moved =
          rigid(row) * answer.segment<motions>(motions * (row / rows_per_brick));
        for (int c = 0; c < motions; ++c)
          z[static_cast<std::ptrdiff_t>(motions) * (row - first) + c] += static_cast<float>(moved[c]);
      }
  }
} // namespace dem
