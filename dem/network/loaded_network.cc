#include "dem/network/loaded_network.h"

#include "base/errors.h"
#include "dem/model/strain_operator.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>

namespace dem
{
  namespace
  {
    using LoadSlip = Eigen::Matrix<double, 3, 6>;

    HeldMotions bit(const int motion) { return HeldMotions(1u << motion); }

    /** Motions that no particle of the network has. */
    std::vector<HeldMotions> missing_motions(const ElasticNetwork &network)
    {
      HeldMotions missing = 0;
      for (int c = 0; c < motions; ++c)
        if (!network.moves(c))
          missing |= bit(c);
      return std::vector<HeldMotions>(network.particles(), missing);
    }

    void grip(LoadedNetwork &loaded, const GripPair &grips, const std::vector<std::size_t> &members, const double half)
    {
      for (const std::size_t i : members)
        {
          if (i >= loaded.network.particles() || loaded.held[i] & bit(grips.axis))
            throw base::InputError("grips: particle " + std::to_string(i + 1) +
                                   " is not there, or belongs to both of them.");
          loaded.held[i] |= bit(grips.axis);
          for (int c = 0; c < 3; ++c)
            {
              if (grips.lateral_blocked)
                loaded.held[i] |= bit(c);
              if (grips.spin_blocked)
                loaded.held[i] |= bit(3 + c);
            }
          loaded.carried[i](grips.axis, 0) = half * grips.layers.distance;
        }
    }
  } // namespace

  double mean_arm(const ElasticNetwork &network)
  {
    double sum = 0;
    for (const ElasticLink &link : network.links)
      sum += 0.5 * (link.arm_first + link.arm_second);
    return network.links.empty() ? 1.0 : sum / static_cast<double>(network.links.size());
  }

  LoadedNetwork load_cell(ElasticNetwork network, const int axis, const bool lateral_free)
  {
    if (!network.periodic())
      throw base::InputError("quasi-static cell: the packing has no periodic cell.");
    if (axis < 0 || axis >= network.dimension)
      throw base::InputError("Axis = " + std::to_string(axis) + ": must be one of the cell's directions.");
    LoadedNetwork loaded;
    loaded.volume = network.volume;
    loaded.driven = axis;
    for (int c = 0; c < 6; ++c)
      loaded.free[c] = lateral_free && c != axis && (network.dimension == 3 || c < 2 || c == 5);
    for (const ElasticLink &l : network.links)
      loaded.load_slip.push_back(strain_operator(l.branch));
    for (const Eigen::Vector3d &x : network.centre)
      loaded.carried.push_back(strain_operator(x));
    loaded.held = missing_motions(network);
    loaded.held.front() |= bit(0) | bit(1) | bit(2);
    loaded.network = std::move(network);
    return loaded;
  }

  LoadedNetwork strained_cell(ElasticNetwork network) { return load_cell(std::move(network), 0, false); }

  LoadedNetwork load_grips(ElasticNetwork network, const GripPair &grips)
  {
    if (grips.axis < 0 || grips.axis >= network.dimension)
      throw base::InputError("Axis = " + std::to_string(grips.axis) + ": must be one of the specimen's directions.");
    if (grips.layers.low.empty() || grips.layers.high.empty())
      throw base::InputError("grips: one of them holds no particle.");
    if (!(grips.layers.distance > 0 && grips.layers.section > 0) ||
        !std::isfinite(grips.layers.distance * grips.layers.section))
      throw base::InputError("grips: the length between them and the section must be above 0.");
    LoadedNetwork loaded;
    loaded.volume = grips.layers.distance * grips.layers.section;
    loaded.held   = missing_motions(network);
    loaded.carried.assign(network.particles(), LoadSlip::Zero());
    loaded.network = std::move(network);
    grip(loaded, grips, grips.layers.low, -0.5);
    grip(loaded, grips, grips.layers.high, 0.5);
    for (const ElasticLink &l : loaded.network.links)
      loaded.load_slip.push_back(loaded.carried[l.second] - loaded.carried[l.first]);
    support(loaded, grips);
    return loaded;
  }

  LoadedNetwork unloaded(ElasticNetwork network)
  {
    if (network.periodic())
      throw base::InputError("quasi-static loading: a periodic cell has no place for supports or a solid.");
    LoadedNetwork loaded;
    loaded.volume = 1;
    loaded.held   = missing_motions(network);
    loaded.carried.assign(network.particles(), LoadSlip::Zero());
    loaded.load_slip.assign(network.links.size(), LoadSlip::Zero());
    loaded.network = std::move(network);
    return loaded;
  }

  void drive(LoadedNetwork &loaded, const std::vector<std::size_t> &particles, const int motion, const double per_unit)
  {
    for (const std::size_t i : particles)
      {
        loaded.held.at(i) |= bit(motion);
        if (motion < 3)
          loaded.carried[i](motion, loaded.driven) = per_unit;
      }
    for (std::size_t l = 0; l < loaded.network.links.size(); ++l)
      loaded.load_slip[l] =
        loaded.carried[loaded.network.links[l].second] - loaded.carried[loaded.network.links[l].first];
  }

  void weigh_down(LoadedNetwork &loaded, const std::vector<Eigen::Vector3d> &weight)
  {
    DeadLoad dead;
    dead.factor    = loaded.driven;
    dead.parameter = (loaded.driven + 1) % 6;
    dead.force     = CarrierMotions::Zero(motions, static_cast<Eigen::Index>(loaded.held.size()));
    for (std::size_t i = 0; i < weight.size(); ++i)
      {
        dead.force.col(static_cast<Eigen::Index>(i)).head<3>() = weight[i];
        dead.by_factor += weight[i].dot(loaded.carried[i].col(loaded.driven));
      }
    loaded.dead = std::move(dead);
  }

  LoadedNetwork with_load_put_on(LoadedNetwork loaded, const bool released)
  {
    loaded.free[static_cast<std::size_t>(loaded.driven)] = released;
    loaded.driven                                        = loaded.dead->parameter;
    return loaded;
  }

  void support(LoadedNetwork &loaded, const GripPair &grips)
  {
    if (grips.lateral_blocked)
      return;
    const auto &x    = loaded.network.centre;
    const int   side = (grips.axis + 1) % loaded.network.dimension, other = 3 - grips.axis - side;
    // The pair of the low grip that lies farthest apart along `side`: a rotation about the axis would move them against each other
    // along `other`.
    const auto        farther = [&](const std::size_t a, const std::size_t b) { return x[a][side] < x[b][side]; };
    const std::size_t one     = *std::min_element(grips.layers.low.begin(), grips.layers.low.end(), farther);
    const std::size_t two     = *std::max_element(grips.layers.low.begin(), grips.layers.low.end(), farther);
    loaded.held[one] |= bit(side);
    if (loaded.network.dimension == 2)
      return;
    loaded.held[one] |= bit(other);
    if (two != one)
      loaded.held[two] |= bit(other);
  }

  void LoadedMotion::visit_state(base::StateVisitor &visitor)
  {
    base::Column flat(particles.data(), particles.data() + particles.size());
    flat.insert(flat.end(), loads.data(), loads.data() + 6);
    visitor.column("motion", flat);
    std::copy_n(flat.data(), particles.size(), particles.data());
    std::copy_n(flat.data() + particles.size(), 6, loads.data());
  }

  Eigen::Vector3d slip_of(const LoadedNetwork &loaded, const std::size_t link, const LoadedMotion &motion)
  {
    const ElasticLink    &l = loaded.network.links[link];
    const auto            J = motion.particles.col(l.first), K = motion.particles.col(l.second);
    const Eigen::Vector3d spin = l.arm_first * J.tail<3>() + l.arm_second * K.tail<3>();
    return K.head<3>() - J.head<3>() + l.direction.cross(spin) + loaded.load_slip[link] * motion.loads;
  }

  Eigen::Vector3d turn_of(const LoadedNetwork &loaded, const std::size_t link, const LoadedMotion &motion)
  {
    const ElasticLink &l = loaded.network.links[link];
    return motion.particles.col(l.second).tail<3>() - motion.particles.col(l.first).tail<3>();
  }

  Eigen::VectorXd joints_of(const LoadedNetwork &loaded, const LoadedMotion &motion)
  {
    return motion.particles.topRightCorner(3, loaded.body->joints()).reshaped();
  }

  namespace
  {
    /** @return sum of squares of its forces */
    double add_body(const LoadedNetwork &loaded, const LoadedMotion &motion, Unbalanced &u)
    {
      const ElasticBody    &body  = *loaded.body;
      const Eigen::VectorXd x     = joints_of(loaded, motion);
      const double          p     = motion.loads[body.load];
      const Eigen::VectorXd force = -(body.stiffness * x) - p * body.by_load;
      u.particles.topRightCorner(3, body.joints()) += force.reshaped(3, body.joints());
      u.loads[body.load] += body.by_load.dot(x) + body.of_load * p;
      return force.squaredNorm();
    }

    /** @return sum of squares of its forces */
    double add_dead_load(const DeadLoad &dead, const LoadedMotion &motion, Unbalanced &u)
    {
      const double l = motion.loads[dead.parameter], p = motion.loads[dead.factor];
      u.particles += l * dead.force;
      u.loads[dead.factor] -= l * dead.by_factor;
      u.loads[dead.parameter] += dead.force_of(motion.particles, l, p);
      return l * l * dead.force.squaredNorm();
    }

    /** Square of how far a unit of its load moves the joints, each by itself [m^2]. */
    double reach_of(const ElasticBody &body)
    {
      const Eigen::VectorXd stiffness = body.stiffness.diagonal();
      return (stiffness.array() > 0).select(body.by_load.array() / stiffness.array(), 0.0).square().sum();
    }
  } // namespace

  Unbalanced unbalanced_of(const LoadedNetwork                &loaded,
                           const LoadedMotion                 &motion,
                           const std::vector<Eigen::Vector3d> &force,
                           const std::vector<Eigen::Vector3d> &moments,
                           const double                        scale,
                           const double                        least)
  {
    Unbalanced u;
    u.particles.setZero(motions, static_cast<Eigen::Index>(loaded.held.size()));
    u.loads.setZero();
    double        squares = 0;
    base::Vector6 reach   = base::Vector6::Zero();
    for (std::size_t i = 0; i < force.size(); ++i)
      {
        const ElasticLink    &l      = loaded.network.links[i];
        const Eigen::Vector3d moment = l.direction.cross(force[i]);
        u.particles.col(l.first).head<3>() += force[i];
        u.particles.col(l.second).head<3>() -= force[i];
        u.particles.col(l.first).tail<3>() += l.arm_first * moment;
        u.particles.col(l.second).tail<3>() += l.arm_second * moment;
        if (!moments.empty())
          {
            u.particles.col(l.first).tail<3>() += moments[i];
            u.particles.col(l.second).tail<3>() -= moments[i];
          }
        u.loads += loaded.load_slip[i].transpose() * force[i];
        squares += force[i].squaredNorm();
        reach += loaded.load_slip[i].colwise().squaredNorm().transpose();
      }
    if (loaded.body)
      {
        squares += add_body(loaded, motion, u);
        reach[loaded.body->load] += reach_of(*loaded.body);
      }
    if (loaded.dead)
      squares += add_dead_load(*loaded.dead, motion, u);
    for (std::size_t i = 0; i < loaded.held.size(); ++i)
      for (int c = 0; c < motions; ++c)
        if (loaded.held[i] >> c & 1)
          u.particles(c, static_cast<Eigen::Index>(i)) = 0;
    if (loaded.ties)
      loaded.ties->release(u.particles);
    double left = 0;
    for (Eigen::Index i = 0; i < u.particles.cols(); ++i)
      for (int c = 0; c < motions; ++c)
        left += std::pow(c < 3 ? u.particles(c, i) : u.particles(c, i) / scale, 2);
    u.borne = std::sqrt(squares);
    squares = std::max(squares, least * least);
    if (squares == 0)
      return u;
    u.residual = std::sqrt(left / squares);
    for (int c = 0; c < 6; ++c)
      if (loaded.free[c])
        u.residual = std::max(u.residual, std::fabs(u.loads[c]) / std::sqrt(squares * reach[c]));
    return u;
  }
} // namespace dem
