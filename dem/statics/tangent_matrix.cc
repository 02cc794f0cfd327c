#include "dem/statics/tangent_matrix.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace dem
{
  std::vector<base::Matrix6> undamaged_stiffnesses(const LoadedNetwork &loaded)
  {
    std::vector<base::Matrix6> stiffness;
    for (const ElasticLink &l : loaded.network.links)
      stiffness.push_back(undamaged_stiffness(l));
    return stiffness;
  }

  TangentMatrix::TangentMatrix(const LoadedNetwork    &network,
                               const std::vector<int> &numbers,
                               const std::vector<int> &first_numbers,
                               const double            length,
                               const double            part)
    : loaded(network)
    , unknown(numbers)
    , first(first_numbers)
    , count(first.back())
    , scale(length)
    , kept(part)
    , diagonal(Eigen::VectorXd::Zero(count))
  {
    lay_out();
    assemble(undamaged_stiffnesses(loaded));
    const Eigen::VectorXd met  = matrix.diagonal();
    const double          mean = std::accumulate(met.begin(), met.end(), 0.0) / static_cast<double>(count);
    diagonal                   = (met.array() > 1e-12 * mean).select(met, mean);
  }

  /** Pattern of the matrix, block by block: every free motion of a particle with every one of its neighbours. */
  void TangentMatrix::lay_out()
  {
    std::vector<std::set<std::int32_t>> neighbours(loaded.held.size());
    for (std::size_t i = 0; i < neighbours.size(); ++i)
      neighbours[i].insert(static_cast<std::int32_t>(i));
    for (const ElasticLink &l : loaded.network.links)
      {
        neighbours[l.first].insert(l.second);
        neighbours[l.second].insert(l.first);
      }
    std::vector<std::map<std::int32_t, int>> begin(neighbours.size());
    std::vector<int>                         outer{0}, inner;
    for (std::size_t i = 0; i < neighbours.size(); ++i)
      for (int c = first[i]; c < first[i + 1]; ++c)
        {
          for (const std::int32_t j : neighbours[i])
            {
              begin[i][j] = static_cast<int>(inner.size()) - outer.back();
              for (int d = first[j]; d < first[j + 1]; ++d)
                inner.push_back(d);
            }
          outer.push_back(static_cast<int>(inner.size()));
        }
    const std::vector<double> zeros(inner.size(), 0.0);
    matrix = Eigen::Map<const Sparse>(count, count, static_cast<Eigen::Index>(inner.size()), outer.data(), inner.data(),
                                      zeros.data());
    const auto rows_in = [&](const std::int32_t rows, const std::int32_t columns) {
      const auto found = begin[columns].find(rows);
      return found == begin[columns].end() ? 0 : found->second; // none: the columns' particle is held altogether
    };
    for (const ElasticLink &l : loaded.network.links)
      places.push_back({rows_in(l.first, l.first), rows_in(l.first, l.second), rows_in(l.second, l.first),
                        rows_in(l.second, l.second)});
  }

  void TangentMatrix::add(const std::int32_t rows, const std::int32_t columns, const int place, const Block &block)
  {
    for (int c = 0; c < motions; ++c)
      {
        const int column = unknown[motions * columns + c];
        if (column < 0)
          continue;
        double *values = matrix.valuePtr() + matrix.outerIndexPtr()[column] + place;
        for (int r = 0; r < motions; ++r)
          if (unknown[motions * rows + r] >= 0)
            *values++ += block(r, c);
      }
  }

  void TangentMatrix::assemble(const std::vector<base::Matrix6> &stiffness)
  {
    std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      {
        const ElasticLink &l  = loaded.network.links[i];
        const auto [J, K]     = slip_matrices(l, scale);
        const BlockPlaces &at = places[i];
        const SlipOf       CJ = stiffness[i] * J, CK = stiffness[i] * K;
        add(l.first, l.first, at.JJ, J.transpose() * CJ);
        add(l.first, l.second, at.JK, J.transpose() * CK);
        add(l.second, l.first, at.KJ, K.transpose() * CJ);
        add(l.second, l.second, at.KK, K.transpose() * CK);
      }
    for (int i = 0; i < count; ++i)
      matrix.coeffRef(i, i) += kept * diagonal[i];
  }
}
