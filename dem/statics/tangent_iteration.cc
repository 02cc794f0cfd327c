#include "dem/statics/tangent_iteration.h"

#include "dem/network/slip_matrices.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr double kept_regular_by = 1e-9; ///< of the factor
    constexpr int    most_iterations = 240;  ///< as much work as half a direct factor in cells of a thousand particles

    std::vector<std::pair<int, int>> joined_rows(const ElasticNetwork &network, const std::vector<int> &row_of)
    {
      std::vector<std::pair<int, int>> joined;
      for (const ElasticLink &l : network.links)
        joined.emplace_back(row_of[static_cast<std::size_t>(l.first)], row_of[static_cast<std::size_t>(l.second)]);
      return joined;
    }
  } // namespace

  TangentIteration::TangentIteration(const LoadedNetwork &network)
    : loaded(network)
    , scale(mean_arm(network.network))
  {
    number_rows();
    matrix.emplace_back(static_cast<int>(row_of.size()), joined_rows(loaded.network, row_of));
    std::vector<base::Matrix6> undamaged;
    for (const ElasticLink &l : loaded.network.links)
      {
        const int J = row_of[static_cast<std::size_t>(l.first)], K = row_of[static_cast<std::size_t>(l.second)];
        places.push_back({matrix[0].place(J, J), matrix[0].place(J, K), matrix[0].place(K, J), matrix[0].place(K, K)});
        has_moments = has_moments || !l.turning.isZero(0);
        undamaged.push_back(undamaged_stiffness(l));
      }
    assemble(undamaged);
    take_diagonal();
  }

  /** Neighbours near each other: an incomplete factor of rows in this order is worth more. */
  void TangentIteration::number_rows()
  {
    const std::size_t             n = loaded.network.particles();
    std::vector<std::vector<int>> neighbours(n);
    for (const ElasticLink &l : loaded.network.links)
      {
        neighbours[static_cast<std::size_t>(l.first)].push_back(l.second);
        neighbours[static_cast<std::size_t>(l.second)].push_back(l.first);
      }
    row_of.assign(n, -1);
    std::vector<std::size_t> order;
    const auto               take = [&](const std::size_t i) {
      if (row_of[i] >= 0)
        return;
      row_of[i] = static_cast<int>(order.size());
      order.push_back(i);
    };
    for (std::size_t start = 0, next = 0; start < n; ++start)
      for (take(start); next < order.size(); ++next)
        {
          std::sort(neighbours[order[next]].begin(), neighbours[order[next]].end());
          for (const int j : neighbours[order[next]])
            take(static_cast<std::size_t>(j));
        }
  }

  void TangentIteration::take_diagonal()
  {
    diagonal.resize(matrix[0].size());
    for (int row = 0; row < matrix[0].rows(); ++row)
      diagonal.segment<motions>(motions * row) = matrix[0].block(matrix[0].diagonal(row)).diagonal();
    const double mean = diagonal.mean();
    diagonal          = (diagonal.array() > 1e-12 * mean).select(diagonal, mean).eval();
  }

  void TangentIteration::add_forces(const std::size_t link, const Eigen::Matrix3d &C)
  {
    const ElasticLink    &l  = loaded.network.links[link];
    const BlockPlaces    &at = places[link];
    const Eigen::Matrix3d N = cross_product_matrix(l.direction) / scale, CN = C * N, NC = -N * C, NCN = NC * N;
    const double          J = l.arm_first, K = l.arm_second;
    const auto put = [&](const int place, const double row_sign, const double row_arm, const double column_sign,
                         const double column_arm) {
      auto block = matrix[0].block(place);
      block.topLeftCorner<3, 3>() += row_sign * column_sign * C;
      block.topRightCorner<3, 3>() += row_sign * column_arm * CN;
      block.bottomLeftCorner<3, 3>() += row_arm * column_sign * NC;
      block.bottomRightCorner<3, 3>() += row_arm * column_arm * NCN;
    };
    put(at.JJ, -1, J, -1, J);
    put(at.JK, -1, J, 1, K);
    put(at.KJ, 1, K, -1, J);
    put(at.KK, 1, K, 1, K);
  }

  void TangentIteration::add_moments(const std::size_t link, const base::Matrix6 &stiffness)
  {
    const BlockPlaces &at = places[link];
    const auto [J, K]     = slip_matrices(loaded.network.links[link], scale);
    const SlipOf CJ = stiffness * J, CK = stiffness * K;
    matrix[0].block(at.JJ).noalias() += J.transpose() * CJ;
    matrix[0].block(at.JK).noalias() += J.transpose() * CK;
    matrix[0].block(at.KJ).noalias() += K.transpose() * CJ;
    matrix[0].block(at.KK).noalias() += K.transpose() * CK;
  }

  void TangentIteration::assemble(const std::vector<base::Matrix6> &stiffness)
  {
    matrix[0].set_zero();
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      if (has_moments)
        add_moments(i, stiffness[i]);
      else
        add_forces(i, stiffness[i].topLeftCorner<3, 3>());
    const double unit = matrix[0].block(matrix[0].diagonal(0)).diagonal().cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < row_of.size(); ++i)
      matrix[0].hold(row_of[i], loaded.held[i], unit > 0 ? unit : 1);
  }

  bool TangentIteration::set(const std::vector<base::Matrix6> &stiffness)
  {
    assemble(stiffness);
    return factor.compute(matrix[0], kept_regular_by * diagonal);
  }

  void TangentIteration::put(const CarrierMotions &force, Eigen::Ref<Eigen::VectorXd> column) const
  {
    for (std::size_t i = 0; i < row_of.size(); ++i)
      {
        const auto k                               = static_cast<Eigen::Index>(i);
        column.segment<3>(motions * row_of[i])     = force.col(k).head<3>();
        column.segment<3>(motions * row_of[i] + 3) = force.col(k).tail<3>() / scale;
      }
  }

  CarrierMotions TangentIteration::motion_in(const Eigen::Ref<const Eigen::VectorXd> &column) const
  {
    CarrierMotions motion(motions, static_cast<Eigen::Index>(row_of.size()));
    for (std::size_t i = 0; i < row_of.size(); ++i)
      {
        const auto k            = static_cast<Eigen::Index>(i);
        motion.col(k).head<3>() = column.segment<3>(motions * row_of[i]);
        motion.col(k).tail<3>() = column.segment<3>(motions * row_of[i] + 3) / scale;
      }
    return motion;
  }

  bool TangentIteration::solve(const CarrierMotions &force, const double accuracy, CarrierMotions &motion)
  {
    Columns<1> right(matrix[0].size()), found;
    put(force, right);
    if (!(iteration.solve(matrix[0], factor, right, accuracy, most_iterations, found).residual <= accuracy))
      return false;
    motion = motion_in(found);
    return true;
  }

  bool TangentIteration::solve(const Six &force, const double accuracy, Six &motion, Six &left_over)
  {
    Columns<6> right(matrix[0].size(), 6), found;
    for (std::size_t p = 0; p < 6; ++p)
      put(force[p], right.col(static_cast<Eigen::Index>(p)));
    if (motion[0].cols() == force[0].cols())
      {
        found.resize(right.rows(), 6);
        for (std::size_t p = 0; p < 6; ++p)
          {
            // Motions are the other way about: a rotation times the scale is a length.
            CarrierMotions start = motion[p];
            start.bottomRows<3>() *= scale * scale;
            put(start, found.col(static_cast<Eigen::Index>(p)));
          }
      }
    if (!(iteration_of_six.solve(matrix[0], factor, right, accuracy, most_iterations, found).residual <= accuracy))
      return false;
    Columns<6> balanced(right.rows(), 6);
    matrix[0].multiply<6>(found, balanced);
    const Columns<6> missing = right - balanced;
    for (std::size_t p = 0; p < 6; ++p)
      {
        const auto column = static_cast<Eigen::Index>(p);
        motion[p]         = motion_in(found.col(column));
        left_over[p]      = motion_in(missing.col(column));
        left_over[p].bottomRows<3>() *= scale * scale; // moments
      }
    return true;
  }
} // namespace dem
