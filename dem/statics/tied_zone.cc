#include "dem/statics/tied_zone.h"

#include "dem/network/slip_matrices.h"
#include "dem/statics/tangent_matrix.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dem
{
  namespace
  {
    using Sparse   = TiedZone::Sparse;
    using Triplets = std::vector<Eigen::Triplet<double>>;

    Sparse matrix_of(const Triplets &entries, const Eigen::Index rows, const Eigen::Index columns)
    {
      Sparse matrix(rows, columns);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }
  } // namespace

  TiedZone::TiedZone(const LoadedNetwork &network, const double length, const double kept_part)
    : loaded(network)
    , scale(length)
    , kept(kept_part)
    , inside(network.held.size(), 0)
  {
    find_carriers();
    number_unknowns();
    diagonal = Eigen::VectorXd::Zero(count);
    for (const std::size_t l : touching)
      {
        const ElasticLink  &link = loaded.network.links[l];
        const base::Matrix6 C    = undamaged_stiffness(link);
        const auto [J, K]        = slip_matrices(link, scale);
        for (const auto &[particle, slip] : {std::pair{link.first, J}, std::pair{link.second, K}})
          for (int c = 0; c < motions; ++c)
            if (const int u = unknown[motions * static_cast<std::size_t>(particle) + c]; u >= 0)
              diagonal[u] += slip.col(c).dot(C * slip.col(c));
      }
    const double mean = count > 0 ? diagonal.mean() : 1.0;
    diagonal          = (diagonal.array() > 1e-12 * mean).select(diagonal, mean).eval();
    around.emplace(loaded, unknown, count, mean);
    by_unknowns = around->by_unknowns();
  }

  void TiedZone::find_carriers()
  {
    std::fill(inside.begin() + static_cast<std::ptrdiff_t>(loaded.network.particles()), inside.end(), char(1));
    if (loaded.ties)
      for (Eigen::Index motion = 0; motion < loaded.ties->rows().cols(); ++motion)
        if (loaded.ties->rows().col(motion).nonZeros() > 0)
          inside[static_cast<std::size_t>(motion) / motions] = 1;
    for (std::size_t l = 0; l < loaded.network.links.size(); ++l)
      if (inside[loaded.network.links[l].first] || inside[loaded.network.links[l].second])
        touching.push_back(l);
  }

  void TiedZone::number_unknowns()
  {
    unknown.assign(motions * inside.size(), -1);
    for (std::size_t i = 0; i < inside.size(); ++i)
      for (int c = 0; c < motions && inside[i]; ++c)
        if (!(loaded.held[i] >> c & 1))
          unknown[motions * i + c] = count++;
  }

  std::unique_ptr<BrickBorder> TiedZone::border(const std::vector<std::int32_t> &row, const RowShare &share)
  {
    std::vector<std::pair<std::int32_t, std::int32_t>> joined_rows; // with their particles
    for (const std::size_t l : touching)
      for (const std::int32_t end : {loaded.network.links[l].first, loaded.network.links[l].second})
        if (!inside[static_cast<std::size_t>(end)])
          joined_rows.emplace_back(row[static_cast<std::size_t>(end)], end);
    std::sort(joined_rows.begin(), joined_rows.end());
    joined_rows.erase(std::unique(joined_rows.begin(), joined_rows.end()), joined_rows.end());
    place_of_row.assign(inside.size(), -1);
    std::vector<std::int32_t> rows;
    for (const auto &[at, particle] : joined_rows)
      {
        place_of_row[static_cast<std::size_t>(particle)] = static_cast<std::int32_t>(rows.size());
        rows.push_back(at);
      }
    joined = rows.size();
    return std::make_unique<BrickBorder>(std::move(rows), common_unknowns(), share);
  }

  TiedZone::Sparse TiedZone::common_unknowns() const
  {
    Triplets entries;
    int      column = 0;
    if (loaded.ties)
      for (Eigen::Index of_all = 0; of_all < loaded.ties->common_motions().cols(); ++of_all)
        {
          const std::size_t before = entries.size();
          for (Sparse::InnerIterator entry(loaded.ties->common_motions(), of_all); entry; ++entry)
            if (const int u = unknown[static_cast<std::size_t>(entry.row())]; u >= 0)
              entries.emplace_back(u, column, entry.value());
          column += entries.size() > before;
        }
    return around->unknowns_of(matrix_of(entries, count, column));
  }

  int TiedZone::joined_unknown(const std::int32_t particle, const int motion) const
  {
    const auto         i     = static_cast<std::size_t>(particle);
    const std::int32_t place = place_of_row[i];
    return place < 0 || (loaded.held[i] >> motion & 1) ? -1 : motions * place + motion;
  }

  BrickBorder::Blocks TiedZone::blocks(const std::vector<base::Matrix6> &stiffness)
  {
    Triplets C, D, E;
    for (const std::size_t l : touching)
      {
        const ElasticLink &link = loaded.network.links[l];
        const auto [J, K]       = slip_matrices(link, scale);
        const std::array<std::pair<std::int32_t, const SlipOf *>, 2> ends{{{link.first, &J}, {link.second, &K}}};
        for (const auto &[row_of, row_slip] : ends)
          for (const auto &[column_of, column_slip] : ends)
            {
              const Block block = row_slip->transpose() * (stiffness[l] * *column_slip);
              for (int r = 0; r < motions; ++r)
                for (int c = 0; c < motions; ++c)
                  {
                    const int row       = unknown[motions * static_cast<std::size_t>(row_of) + r],
                              column    = unknown[motions * static_cast<std::size_t>(column_of) + c];
                    const int outer_row = joined_unknown(row_of, r), outer_column = joined_unknown(column_of, c);
                    if (row >= 0 && column >= 0)
                      E.emplace_back(row, column, block(r, c));
                    else if (outer_row >= 0 && column >= 0)
                      C.emplace_back(outer_row, column, block(r, c));
                    else if (row >= 0 && outer_column >= 0)
                      D.emplace_back(row, outer_column, block(r, c));
                  }
            }
      }
    for (int u = 0; u < count; ++u)
      E.emplace_back(u, u, kept * diagonal[u]);
    const auto   others = static_cast<Eigen::Index>(motions * joined);
    const Sparse forces = by_unknowns.transpose();
    return {matrix_of(C, others, count) * by_unknowns, forces * matrix_of(D, count, others),
            around->whole(matrix_of(E, count, count))};
  }

  Eigen::VectorXd TiedZone::forces(const Eigen::VectorXd &on_carriers) const
  {
    Eigen::VectorXd own(count);
    for (std::size_t i = 0; i < unknown.size(); ++i)
      if (unknown[i] >= 0)
        own[unknown[i]] = on_carriers[static_cast<Eigen::Index>(i)];
    return around->forces(own);
  }

  Eigen::VectorXd TiedZone::unknowns_of(const Eigen::VectorXd &of_carriers) const
  {
    Triplets entries;
    for (std::size_t i = 0; i < unknown.size(); ++i)
      if (unknown[i] >= 0)
        entries.emplace_back(unknown[i], 0, of_carriers[static_cast<Eigen::Index>(i)]);
    Eigen::VectorXd unknowns    = around->unknowns_of(matrix_of(entries, count, 1)).toDense();
    const auto      multipliers = of_carriers.size() - static_cast<Eigen::Index>(unknown.size());
    unknowns.tail(multipliers)  = of_carriers.tail(multipliers);
    return unknowns;
  }

  void TiedZone::put(const Eigen::VectorXd &unknowns, Eigen::VectorXd &of_carriers) const
  {
    const Eigen::VectorXd own = around->motions_of(unknowns);
    for (std::size_t i = 0; i < unknown.size(); ++i)
      if (unknown[i] >= 0)
        of_carriers[static_cast<Eigen::Index>(i)] = own[unknown[i]];
    const auto multipliers        = of_carriers.size() - static_cast<Eigen::Index>(unknown.size());
    of_carriers.tail(multipliers) = unknowns.tail(multipliers);
  }
} // namespace dem
