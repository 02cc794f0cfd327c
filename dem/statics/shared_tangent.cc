#include "dem/statics/shared_tangent.h"

#include "dem/model/particles.h"
#include "dem/network/slip_matrices.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr int most_directions = 400;

    std::vector<std::int32_t> inverse_of(const std::vector<std::int32_t> &order)
    {
      std::vector<std::int32_t> place(order.size());
      for (std::size_t k = 0; k < order.size(); ++k)
        place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
      return place;
    }
  } // namespace

  SharedTangent::SharedTangent(const LoadedNetwork &network, const double kept_part, Ranks *const ranks)
    : loaded(network)
    , scale(mean_arm(network.network))
    , kept(kept_part)
    , order(hilbert_order(network.network.centre))
    , row_of(inverse_of(order))
    , ends(ends_as_rows())
    , share(order.size(), ends, motions, ranks)
    , matrix(matrix_of_own_rows())
    , factor(particles_of_rows(), ends, share)
    , iteration(share, order.size())
    , right(motions * order.size())
    , found(right.size())
  {
    find_ends();
    find_diagonal();
  }

  LinkEnds SharedTangent::ends_as_rows() const
  {
    LinkEnds rows;
    for (const ElasticLink &l : loaded.network.links)
      {
        rows.first.push_back(row_of[static_cast<std::size_t>(l.first)]);
        rows.second.push_back(row_of[static_cast<std::size_t>(l.second)]);
      }
    return rows;
  }

  RowParticles SharedTangent::particles_of_rows() const
  {
    RowParticles rows;
    rows.scale = scale;
    for (const std::int32_t particle : order)
      {
        rows.place.push_back(loaded.network.centre[static_cast<std::size_t>(particle)]);
        rows.held.push_back(loaded.held[static_cast<std::size_t>(particle)]);
      }
    return rows;
  }

  BlockMatrix SharedTangent::matrix_of_own_rows() const
  {
    const auto is_own = [&](const std::int32_t row) { return row >= share.own().first && row < share.own().end; };
    std::vector<std::pair<int, int>> joined;
    for (std::size_t l = 0; l < ends.size(); ++l)
      if (is_own(ends.first[l]) || is_own(ends.second[l]))
        joined.emplace_back(ends.first[l], ends.second[l]);
    return BlockMatrix(static_cast<int>(order.size()), joined);
  }

  void SharedTangent::find_ends()
  {
    const std::int64_t first = share.own().first;
    ends_at.resize(static_cast<std::size_t>(share.own().end - first));
    for (std::size_t l = 0; l < ends.size(); ++l)
      for (const bool second : {false, true})
        if (const std::int64_t row = (second ? ends.second[l] : ends.first[l]) - first;
            row >= 0 && row < static_cast<std::int64_t>(ends_at.size()))
          ends_at[static_cast<std::size_t>(row)].push_back({l, second});
  }

  void SharedTangent::find_diagonal()
  {
    diagonal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(right.size()));
    for (std::size_t l = 0; l < ends.size(); ++l)
      {
        const base::Matrix6 C = undamaged_stiffness(loaded.network.links[l]);
        const auto [J, K]     = slip_matrices(loaded.network.links[l], scale);
        diagonal.segment<motions>(motions * ends.first[l]) += (J.transpose() * C * J).diagonal();
        diagonal.segment<motions>(motions * ends.second[l]) += (K.transpose() * C * K).diagonal();
      }
    const double mean = diagonal.mean();
    diagonal          = (diagonal.array() > 1e-12 * mean).select(diagonal, mean).eval();
  }

  void SharedTangent::assemble_row(const int row, const std::vector<base::Matrix6> &stiffness)
  {
    for (int k = matrix.begin(row); k < matrix.begin(row + 1); ++k)
      matrix.block(k).setZero();
    for (const End &end : ends_at[static_cast<std::size_t>(row - share.own().first)])
      {
        const auto [J, K]   = slip_matrices(loaded.network.links[end.link], scale);
        const SlipOf of_row = (end.second ? K : J);
        const SlipOf force  = stiffness[end.link].transpose() * of_row;
        matrix.block(matrix.place(row, ends.first[end.link])).noalias() += force.transpose() * J;
        matrix.block(matrix.place(row, ends.second[end.link])).noalias() += force.transpose() * K;
      }
    matrix.block(matrix.diagonal(row)).diagonal() += kept * diagonal.segment<motions>(motions * row);
  }

  bool SharedTangent::set(const std::vector<base::Matrix6> &stiffness)
  {
    const auto first = static_cast<int>(share.own().first), end = static_cast<int>(share.own().end);
#pragma omp parallel for schedule(static)
    for (int row = first; row < end; ++row)
      assemble_row(row, stiffness);
    const double unit = diagonal.mean();
    for (int row = first; row < end; ++row)
      matrix.hold(row, loaded.held[static_cast<std::size_t>(order[static_cast<std::size_t>(row)])], unit);
    for (const std::int32_t row : share.ghosts())
      matrix.hold(row, loaded.held[static_cast<std::size_t>(order[static_cast<std::size_t>(row)])], unit);
    return factor.compute(matrix, diagonal);
  }

  bool SharedTangent::solve(const Eigen::VectorXd &force, const double accuracy, Eigen::VectorXd &motion)
  {
    for (std::size_t row = 0; row < order.size(); ++row)
      {
        std::copy_n(force.data() + motions * order[row], motions, &right[motions * row]);
        std::copy_n(motion.data() + motions * order[row], motions, &found[motions * row]);
      }
    if (!(iteration.solve(matrix, factor, right, accuracy, most_directions, found).residual <= accuracy))
      return false;
    for (std::size_t row = 0; row < order.size(); ++row)
      std::copy_n(&found[motions * row], motions, motion.data() + motions * order[row]);
    return true;
  }
} // namespace dem
