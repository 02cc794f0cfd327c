#include "dem/network/rigid_motions.h"

#include "dem/core/symmetric_modes.h"
#include "dem/network/loaded_network.h"
#include "dem/network/particle_groups.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>

namespace dem
{
  namespace
  {
    /** A motion that what is held resists by less than this part of the best resisted one is free. */
    constexpr double free_below = 1e-12;

    /**
     * Translations and rotations of a body as columns over its particles' motions, each of length one; only those that the network
     * has. Where particles cannot rotate, a turning body strains its links: then it is no rigid motion.
     */
    Eigen::MatrixXd
    rigid_motions_of(const ElasticNetwork &network, const std::vector<std::int32_t> &members, const double scale)
    {
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const std::int32_t i : members)
        middle += network.centre[i] / static_cast<double>(members.size());
      std::vector<Eigen::VectorXd> columns;
      for (int m = 0; m < motions; ++m)
        {
          if (!network.moves(m))
            continue;
          Eigen::VectorXd column = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(motions * members.size()));
          for (std::size_t k = 0; k < members.size(); ++k)
            {
              auto on_particle = column.segment<motions>(static_cast<Eigen::Index>(motions * k));
              if (m < 3)
                on_particle[m] = 1;
              else
                {
                  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(m - 3);
                  on_particle.head<3>()      = axis.cross(network.centre[members[k]] - middle);
                  on_particle.tail<3>()      = scale * axis;
                }
            }
          columns.push_back(column.normalized());
        }
      Eigen::MatrixXd all(static_cast<Eigen::Index>(motions * members.size()),
                          static_cast<Eigen::Index>(columns.size()));
      for (std::size_t m = 0; m < columns.size(); ++m)
        all.col(static_cast<Eigen::Index>(m)) = columns[m];
      return all;
    }

    Eigen::MatrixXd orthonormal(const Eigen::MatrixXd &columns)
    {
      const Eigen::HouseholderQR<Eigen::MatrixXd> factors(columns);
      return factors.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
    }
  } // namespace

  std::vector<Eigen::Index> rows_to_hold(Eigen::MatrixXd free)
  {
    std::vector<Eigen::Index> rows;
    while (free.cols() > 0)
      {
        rows.push_back(0);
        free.rowwise().squaredNorm().maxCoeff(&rows.back());
        // Of the combinations of columns, those that vanish there.
        const Eigen::VectorXd                       here = free.row(rows.back()).transpose();
        const Eigen::HouseholderQR<Eigen::MatrixXd> factors(here);
        const Eigen::MatrixXd                       rest =
          factors.householderQ() * Eigen::MatrixXd::Identity(free.cols(), free.cols()).rightCols(free.cols() - 1);
        free = (free * rest).eval();
      }
    return rows;
  }

  RigidMotions::RigidMotions(const ElasticNetwork            &network,
                             const std::vector<HeldMotions>  &what_is_held,
                             const std::vector<std::int32_t> &weak)
    : scale(mean_arm(network))
    , held(what_is_held)
    , supports(what_is_held)
    , is_weak(what_is_held.size(), 0)
  {
    for (const std::int32_t i : weak)
      is_weak[i] = 1;
    ParticleGroups groups(network.particles());
    for (const ElasticLink &l : network.links)
      groups.join(l.first, l.second);
    std::map<std::int32_t, std::vector<std::int32_t>> bodies;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(network.particles()); ++i)
      bodies[groups.group_of(i)].push_back(i);
    for (const auto &body : bodies)
      add_body(network, body.second);
  }

  void RigidMotions::add_body(const ElasticNetwork &network, const std::vector<std::int32_t> &members)
  {
    const Eigen::MatrixXd rigid      = rigid_motions_of(network, members, scale);
    Eigen::MatrixXd       resistance = Eigen::MatrixXd::Zero(rigid.cols(), rigid.cols());
    bool                  anything   = false;
    for (std::size_t k = 0; k < members.size(); ++k)
      for (int c = 0; c < motions; ++c)
        if (network.moves(c) && held[members[k]] >> c & 1)
          {
            const auto row = rigid.row(static_cast<Eigen::Index>(motions * k + c));
            resistance += row.transpose() * row;
            anything = true;
          }
    if (!anything)
      {
        Mechanism body;
        body.particles = members;
        unheld.push_back(body);
        return;
      }
    const SymmetricModes modes  = symmetric_modes(resistance);
    const auto           values = modes.values;
    const Eigen::Index   free   = (values.array() < free_below * values[values.size() - 1]).count(); // ascending
    if (free == 0)
      return;
    const Eigen::MatrixXd basis = orthonormal(rigid * modes.vectors.leftCols(free));
    for (Eigen::Index f = 0; f < free; ++f)
      {
        const Eigen::VectorXd column = basis.col(f);
        fields.push_back({members, Eigen::Map<const ParticleMotions>(column.data(), motions,
                                                                     static_cast<Eigen::Index>(members.size()))});
      }
    Eigen::MatrixXd strong = basis;
    for (std::size_t k = 0; k < members.size(); ++k)
      if (is_weak[members[k]])
        strong.middleRows<motions>(static_cast<Eigen::Index>(motions * k)).setZero();
    for (const Eigen::Index row : rows_to_hold(strong))
      supports[members[row / motions]] |= HeldMotions(1u << row % motions);
  }

  double RigidMotions::loaded_by(const ParticleMotions &load) const
  {
    double all = 0, largest = 0;
    for (Eigen::Index i = 0; i < load.cols(); ++i)
      all += load.col(i).head<3>().squaredNorm() + load.col(i).tail<3>().squaredNorm() / (scale * scale);
    for (const Field &field : fields)
      {
        double along = 0;
        for (std::size_t k = 0; k < field.particles.size(); ++k)
          {
            const auto motion = field.motion.col(static_cast<Eigen::Index>(k));
            const auto force  = load.col(field.particles[k]);
            along += motion.head<3>().dot(force.head<3>()) + motion.tail<3>().dot(force.tail<3>()) / scale;
          }
        largest = std::max(largest, std::fabs(along));
      }
    return all > 0 ? largest / std::sqrt(all) : 0.0;
  }

  void RigidMotions::remove_from(ParticleMotions &motion) const
  {
    for (const Field &field : fields)
      {
        double part = 0;
        for (std::size_t k = 0; k < field.particles.size(); ++k)
          {
            const auto rigid = field.motion.col(static_cast<Eigen::Index>(k));
            const auto moved = motion.col(field.particles[k]);
            part += rigid.head<3>().dot(moved.head<3>()) + scale * rigid.tail<3>().dot(moved.tail<3>());
          }
        for (std::size_t k = 0; k < field.particles.size(); ++k)
          {
            const auto rigid = field.motion.col(static_cast<Eigen::Index>(k));
            motion.col(field.particles[k]).head<3>() -= part * rigid.head<3>();
            motion.col(field.particles[k]).tail<3>() -= part / scale * rigid.tail<3>();
          }
      }
  }
} // namespace dem
