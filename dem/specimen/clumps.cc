#include "dem/specimen/clumps.h"

#include "dem/specimen/glide.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace dem
{
  using Eigen::Matrix3d;
  using Eigen::Quaterniond;
  using Eigen::Vector3d;

  namespace
  {
    /** Turn by a rotation vector, to rounding for small ones too. */
    Quaterniond turn_by(const Vector3d &rotation)
    {
      const double half = 0.5 * rotation.norm();
      // sin(x)/x
      const double   part = half < 1e-3 ? 1 - half * half / 6 * (1 - half * half / 20) : std::sin(half) / half;
      const Vector3d axis = 0.5 * part * rotation;
      return Quaterniond(std::cos(half), axis.x(), axis.y(), axis.z());
    }

    /** Local damping of one component, as the particle pass has it (doc/theory/integration.md, 2). */
    double
    damped(const double force, const double acceleration, const double rate, const double half, const double damping)
    {
      const double ahead = acceleration * (rate + half * acceleration);
      return force * (1 - (ahead > 0 ? damping : ahead < 0 ? -damping : 0.0));
    }
  } // namespace

  Vector3d Clumps::Body::spin_of(const Quaterniond &turned, const Vector3d &momentum) const
  {
    return turned * (inverse_inertia * (turned.conjugate() * momentum));
  }

  void Clumps::Body::turn_on(const double time)
  {
    // The implicit midpoint rule keeps the energy of a free turn up to its third order; each round gains two.
    constexpr int rounds = 6;
    Vector3d      now    = spin_of(turn, angular_momentum);
    for (int round = 0; round < rounds; ++round)
      now = spin_of(turn_by(0.5 * time * now) * turn, angular_momentum);
    spin = now;
    turn = (turn_by(time * now) * turn).normalized();
  }

  void Clumps::add(const RigidClump                &clump,
                   const std::vector<std::int32_t> &members,
                   const std::vector<double>       &mass_shares,
                   const Particles                 &particles,
                   const bool                       planar)
  {
    Body body;
    body.members = members;
    body.shares  = mass_shares;
    body.planar  = planar;
    body.mass    = clump.mass;
    body.start   = clump.centre;
    body.inertia = clump.inertia;
    body.inverse_inertia.setZero();
    if (planar)
      body.inverse_inertia(2, 2) = 1 / clump.inertia(2, 2);
    else
      body.inverse_inertia = clump.inertia.inverse();
    for (const std::int32_t i : members)
      body.arms.push_back(particles.position_of(static_cast<std::size_t>(i)) - clump.centre);
    all_pebbles.insert(all_pebbles.end(), body.members.begin(), body.members.end());
    std::sort(all_pebbles.begin(), all_pebbles.end());
    bodies.push_back(std::move(body));
  }

  ClumpState Clumps::state(const std::size_t clump) const
  {
    const Body &body = bodies.at(clump);
    return {body.start + body.travelled,  body.velocity,  body.spin, body.angular_momentum,
            body.turn.toRotationMatrix(), body.travelled, body.mass, body.members.size()};
  }

  double Clumps::mass_of_pebble(const Particles &particles, const std::size_t pebble) const
  {
    const Body &body = bodies.at(static_cast<std::size_t>(particles.body.at(pebble)));
    const auto  at   = std::find(body.members.begin(), body.members.end(), static_cast<std::int32_t>(pebble));
    return body.mass * body.shares.at(static_cast<std::size_t>(at - body.members.begin()));
  }

  namespace
  {
    /** Least squares for the six velocities of a body: along x, y, z, and its spin times a length. */
    struct PrescribedMotion
    {
      using Matrix = Eigen::Matrix<double, 6, 6>;
      using Vector = Eigen::Matrix<double, 6, 1>;

      Matrix normal = Matrix::Zero();
      Vector right  = Vector::Zero();

      void add(const Vector &row, const double weight, const double value)
      {
        normal += weight * row * row.transpose();
        right += weight * value * row;
      }

      /** None of a component that is not prescribed. */
      Vector solution() const
      {
        constexpr double                            nothing = 1e-10; // of the largest
        const Eigen::SelfAdjointEigenSolver<Matrix> modes(normal);
        Vector                                      found = Vector::Zero();
        for (int mode = 0; mode < 6; ++mode)
          if (const double size = modes.eigenvalues()[mode]; size > nothing * modes.eigenvalues().maxCoeff())
            found += modes.eigenvectors().col(mode).dot(right) / size * modes.eigenvectors().col(mode);
        return found;
      }
    };
  } // namespace

  double Clumps::Body::own_gyration(const Particles &particles, const std::size_t member) const
  {
    const double radius = particles.radius_of(static_cast<std::size_t>(members[member]));
    return (planar ? 1.0 / 2 : 2.0 / 5) * radius * radius;
  }

  void Clumps::take_velocities(const Particles                        &particles,
                               const std::size_t                       clump,
                               const std::vector<std::array<bool, 6>> &given)
  {
    Body  &body    = bodies.at(clump);
    double squares = 0;
    for (std::size_t k = 0; k < body.members.size(); ++k)
      squares += body.shares[k] * (body.arms[k].squaredNorm() + body.own_gyration(particles, k));
    const double length = std::sqrt(squares);
    body.velocity.setZero();
    body.spin.setZero();
    for (int round = 0; round < 2; ++round) // the second one finds what rounding has left of the first
      {
        PrescribedMotion missing;
        for (std::size_t k = 0; k < body.members.size(); ++k)
          {
            const auto     i         = static_cast<std::size_t>(body.members[k]);
            const double  *requested = &particles.velocity[record_size * i];
            const Vector3d rate      = body.velocity + body.spin.cross(body.arm(k));
            for (int c = 0; c < 3; ++c)
              {
                PrescribedMotion::Vector along, about;
                along << Vector3d::Unit(c), body.arm(k).cross(Vector3d::Unit(c)) / length;
                about << Vector3d::Zero(), Vector3d::Unit(c) / length;
                if (given.empty() || given[i][static_cast<std::size_t>(c)])
                  missing.add(along, body.shares[k], requested[c] - rate[c]);
                if (given.empty() || given[i][static_cast<std::size_t>(3 + c)])
                  missing.add(about, body.shares[k] * body.own_gyration(particles, k), requested[3 + c] - body.spin[c]);
              }
          }
        const PrescribedMotion::Vector found = missing.solution();
        body.velocity += found.head<3>();
        body.spin += found.tail<3>() / length;
      }
    body.angular_momentum = body.turn * (body.inertia * (body.turn.conjugate() * body.spin));
  }

  void Clumps::drive(Particles &particles) const
  {
    for (std::size_t clump = 0; clump < bodies.size(); ++clump)
      drive(particles, clump);
  }

  void Clumps::drive(Particles &particles, const std::size_t clump) const
  {
    const Body &body = bodies.at(clump);
    for (std::size_t k = 0; k < body.members.size(); ++k)
      {
        double        *v    = &particles.velocity[record_size * static_cast<std::size_t>(body.members[k])];
        const Vector3d rate = body.velocity + body.spin.cross(body.arm(k));
        std::copy_n(rate.data(), 3, v);
        std::copy_n(body.spin.data(), 3, v + 3);
      }
  }

  void Clumps::sum_forces(const Body &body, const Particles &particles, Vector3d &force, Vector3d &couple)
  {
    for (std::size_t k = 0; k < body.members.size(); ++k)
      {
        const double  *acting = &particles.force[record_size * static_cast<std::size_t>(body.members[k])];
        const Vector3d push(acting);
        force += push;
        couple += body.arm(k).cross(push) + Vector3d(acting + 3);
      }
  }

  void Clumps::move(Particles                         &particles,
                    const StepHalves                  &halves,
                    const double                       damping,
                    const Vector3d                    &gravity,
                    std::vector<ParticleBlockAccount> &accounts)
  {
    const double kick = halves.before + halves.after, drift = 2 * halves.after;
    for (Body &body : bodies)
      {
        Vector3d force = body.mass * gravity, couple = Vector3d::Zero();
        sum_forces(body, particles, force, couple);
        const Vector3d velocity = body.velocity, spin = body.spin, momentum = body.angular_momentum,
                       turning = body.spin_of(body.turn, couple);
        Vector3d damped_force = force, damped_couple = couple;
        for (int c = 0; c < 3 && damping > 0; ++c)
          {
            damped_force[c]  = damped(force[c], force[c] / body.mass, velocity[c], halves.before, damping);
            damped_couple[c] = damped(couple[c], turning[c], spin[c], halves.before, damping);
          }
        std::vector<Vector3d> before;
        for (std::size_t k = 0; k < body.members.size(); ++k)
          before.push_back(body.travelled + body.arm(k));
        body.velocity += kick / body.mass * damped_force;
        body.angular_momentum += kick * damped_couple;
        body.last_travel = drift * body.velocity;
        body.travelled += body.last_travel;
        body.turn_on(drift);

        ParticleBlockAccount &account = accounts.back();
        const Vector3d        slowed = damped_force - force, braked = damped_couple - couple;
        account.damping_before += halves.before * (slowed.dot(velocity) + braked.dot(spin));
        account.damping_after += halves.after * (slowed.dot(body.velocity) + braked.dot(body.spin));
        account.kinetic += 0.5 * body.mass * velocity.dot(body.velocity) +
                           0.25 * (spin.dot(body.angular_momentum) + body.spin.dot(momentum));
        for (std::size_t k = 0; k < body.members.size(); ++k)
          {
            const auto     at    = record_size * static_cast<std::size_t>(body.members[k]);
            const Vector3d moved = body.travelled + body.arm(k) - before[k],
                           place = body.start + body.travelled + body.arm(k), rate = moved / drift,
                           turned = drift * body.spin;
            if (!particles.pushed.empty())
              {
                const double *push = &particles.pushed[at], *was = &particles.velocity[at];
                account.pushing_after += halves.after * (Vector3d(push).dot(rate - Vector3d(was)) +
                                                         Vector3d(push + 3).dot(body.spin - Vector3d(was + 3)));
              }
            std::copy_n(rate.data(), 3, &particles.velocity[at]);
            std::copy_n(body.spin.data(), 3, &particles.velocity[at + 3]);
            std::copy_n(moved.data(), 3, &particles.motion[at]);
            std::copy_n(turned.data(), 3, &particles.motion[at + 3]);
            std::copy_n(place.data(), 3, &particles.pose[at]);
            set_arm_turn(&particles.pose[at], &particles.motion[at]);
            account.fastest = std::max(account.fastest, moved.squaredNorm());
          }
      }
  }

  double Clumps::kinetic_of_velocities() const
  {
    double sum = 0;
    for (const Body &body : bodies)
      sum += 0.5 * body.mass * body.velocity.squaredNorm() + 0.5 * body.spin.dot(body.angular_momentum);
    return sum;
  }

  double Clumps::weight_work(const Vector3d &gravity) const
  {
    double sum = 0;
    for (const Body &body : bodies)
      sum += body.mass * gravity.dot(body.travelled - body.last_travel);
    return sum;
  }

  double Clumps::power_of_weight(const Vector3d &gravity) const
  {
    double sum = 0;
    for (const Body &body : bodies)
      sum += body.mass * gravity.dot(body.velocity);
    return sum;
  }

  double Clumps::stable_step(const Particles                           &particles,
                             const std::size_t                          clump,
                             const std::function<double(std::int32_t)> &stiffness) const
  {
    const Body                                   &body = bodies.at(clump);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(body.inverse_inertia);
    const double                                  lowest = 1 / axes.eigenvalues().maxCoeff();
    double                                        sum    = 0;
    for (std::size_t k = 0; k < body.members.size(); ++k)
      {
        const double reach = body.arms[k].norm() + particles.radius_of(static_cast<std::size_t>(body.members[k]));
        sum += stiffness(body.members[k]) * (1 + body.mass * reach * reach / lowest);
      }
    return sum > 0 ? std::sqrt(2 * body.mass / sum) : std::numeric_limits<double>::infinity();
  }

  void Clumps::visit_state(base::StateVisitor &visitor)
  {
    for (std::size_t k = 0; k < bodies.size(); ++k)
      {
        Body             &body = bodies[k];
        const std::string name = "clumps/" + std::to_string(k);
        for (int c = 0; c < 3; ++c)
          {
            const std::string axis = "_" + std::to_string(c);
            visitor.scalar(name + "/travelled" + axis, body.travelled[c]);
            visitor.scalar(name + "/last_travel" + axis, body.last_travel[c]);
            visitor.scalar(name + "/velocity" + axis, body.velocity[c]);
            visitor.scalar(name + "/spin" + axis, body.spin[c]);
            visitor.scalar(name + "/angular_momentum" + axis, body.angular_momentum[c]);
          }
        for (int c = 0; c < 4; ++c)
          visitor.scalar(name + "/turn_" + std::to_string(c), body.turn.coeffs()[c]);
      }
  }
} // namespace dem
