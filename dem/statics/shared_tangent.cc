#include "dem/statics/shared_tangent.h"

#include "dem/model/particles.h"
#include "dem/network/slip_matrices.h"
#include "dem/statics/tangent_matrix.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr int most_directions = 400;

    std::vector<std::int32_t> inverse_of(const std::vector<std::int32_t> &order, const std::size_t particles)
    {
      std::vector<std::int32_t> place(particles, -1);
      for (std::size_t k = 0; k < order.size(); ++k)
        place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
      return place;
    }
  } // namespace

  SharedTangent::SharedTangent(const LoadedNetwork &network, const double kept_part, Ranks *const ranks)
    : loaded(network)
    , scale(mean_arm(network.network))
    , kept(kept_part)
    , zone(tied_zone())
    , order(particles_by_rows())
    , row_of(inverse_of(order, network.network.particles()))
    , ends(ends_as_rows())
    , share(order.size(), ends, motions, ranks)
    , border(zone ? zone->border(row_of, share) : nullptr)
    , matrix(matrix_of_own_rows())
    , factor(particles_of_rows(), ends, share, border.get())
    , iteration(share, order.size())
    , right{base::Column(motions * order.size()), {}}
    , found(right)
  {
    find_ends();
    find_diagonal();
    if (border)
      answers = border->factorize(zone->blocks(undamaged_stiffnesses(loaded)).E, zone->has_multipliers());
  }

  std::optional<TiedZone> SharedTangent::tied_zone() const
  {
    return loaded.body || loaded.ties ? std::make_optional<TiedZone>(loaded, scale, kept) : std::nullopt;
  }

  /** Along a space-filling curve. */
  std::vector<std::int32_t> SharedTangent::particles_by_rows() const
  {
    if (!zone)
      return hilbert_order(loaded.network.centre);
    std::vector<std::int32_t>    beside;
    std::vector<Eigen::Vector3d> places;
    for (std::size_t i = 0; i < loaded.network.particles(); ++i)
      if (!zone->holds(i))
        {
          beside.push_back(static_cast<std::int32_t>(i));
          places.push_back(loaded.network.centre[i]);
        }
    std::vector<std::int32_t> along = hilbert_order(places);
    for (std::int32_t &particle : along)
      particle = beside[static_cast<std::size_t>(particle)];
    return along;
  }

  LinkEnds SharedTangent::ends_as_rows() const
  {
    LinkEnds rows;
    for (const ElasticLink &l : loaded.network.links)
      if (row(l.first) >= 0 && row(l.second) >= 0)
        {
          rows.first.push_back(row(l.first));
          rows.second.push_back(row(l.second));
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
    const auto is_own = [&](const std::int32_t at) { return at >= share.own().first && at < share.own().end; };
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
    for (std::size_t l = 0; l < loaded.network.links.size(); ++l)
      for (const bool second : {false, true})
        {
          const ElasticLink &link = loaded.network.links[l];
          const std::int64_t at   = row(second ? link.second : link.first) - first;
          if (at >= 0 && at < static_cast<std::int64_t>(ends_at.size()))
            ends_at[static_cast<std::size_t>(at)].push_back({l, second});
        }
  }

  void SharedTangent::find_diagonal()
  {
    diagonal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(motions * order.size()));
    for (const ElasticLink &link : loaded.network.links)
      {
        const base::Matrix6 C = undamaged_stiffness(link);
        const auto [J, K]     = slip_matrices(link, scale);
        for (const auto &[particle, slip] : {std::pair{link.first, J}, std::pair{link.second, K}})
          if (row(particle) >= 0)
            diagonal.segment<motions>(motions * row(particle)) += (slip.transpose() * C * slip).diagonal();
      }
    if (diagonal.size() == 0)
      return;
    const double mean = diagonal.mean();
    diagonal          = (diagonal.array() > 1e-12 * mean).select(diagonal, mean).eval();
  }

  void SharedTangent::assemble_row(const int at, const std::vector<base::Matrix6> &stiffness)
  {
    for (int k = matrix.begin(at); k < matrix.begin(at + 1); ++k)
      matrix.block(k).setZero();
    for (const End &end : ends_at[static_cast<std::size_t>(at - share.own().first)])
      {
        const ElasticLink &link = loaded.network.links[end.link];
        const auto [J, K]       = slip_matrices(link, scale);
        const SlipOf of_row     = (end.second ? K : J);
        const SlipOf force      = stiffness[end.link].transpose() * of_row;
        if (row(link.first) >= 0)
          matrix.block(matrix.place(at, row(link.first))).noalias() += force.transpose() * J;
        if (row(link.second) >= 0)
          matrix.block(matrix.place(at, row(link.second))).noalias() += force.transpose() * K;
      }
    matrix.block(matrix.diagonal(at)).diagonal() += kept * diagonal.segment<motions>(motions * at);
  }

  bool SharedTangent::set(const std::vector<base::Matrix6> &stiffness)
  {
    if (!answers)
      return false;
    const auto first = static_cast<int>(share.own().first), end = static_cast<int>(share.own().end);
#pragma omp parallel for schedule(static)
    for (int at = first; at < end; ++at)
      assemble_row(at, stiffness);
    const double unit = diagonal.size() > 0 ? diagonal.mean() : 1.0;
    for (int at = first; at < end; ++at)
      matrix.hold(at, loaded.held[static_cast<std::size_t>(order[static_cast<std::size_t>(at)])], unit);
    for (const std::int32_t at : share.ghosts())
      matrix.hold(at, loaded.held[static_cast<std::size_t>(order[static_cast<std::size_t>(at)])], unit);
    if (border)
      border->set(zone->blocks(stiffness));
    return factor.compute(matrix, diagonal);
  }

  bool SharedTangent::solve(const Eigen::VectorXd &force, const double accuracy, Eigen::VectorXd &motion)
  {
    for (std::size_t at = 0; at < order.size(); ++at)
      {
        std::copy_n(force.data() + motions * order[at], motions, &right.rows[motions * at]);
        std::copy_n(motion.data() + motions * order[at], motions, &found.rows[motions * at]);
      }
    if (zone)
      {
        right.border = zone->forces(force);
        found.border = zone->unknowns_of(motion);
      }
    const BrickSystem system{matrix, factor, border.get()};
    if (!(iteration.solve(system, right, accuracy, most_directions, found).residual <= accuracy))
      return false;
    for (std::size_t at = 0; at < order.size(); ++at)
      std::copy_n(&found.rows[motions * at], motions, motion.data() + motions * order[at]);
    if (zone)
      zone->put(found.border, motion);
    return true;
  }
} // namespace dem
