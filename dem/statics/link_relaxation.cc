#include "dem/statics/link_relaxation.h"

#include "base/errors.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numeric>
#include <optional>
#include <string>

namespace dem
{
  namespace
  {
    /** Below 2, which is stable for masses of at least the row sums of the stiffness. */
    constexpr double step = 1.6;

    class Relaxation
    {
    public:
      Relaxation(const LoadedNetwork &network, const double local_damping)
        : loaded(network)
        , scale(mean_arm(network.network))
        , load_length(scale * std::sqrt(static_cast<double>(network.network.particles())))
        , damping(local_damping)
        , mass(network.held.size())
        , speed(network.held.size())
        , kicked(network.held.size())
        , lost_force(network.held.size())
      {
        find_masses();
        if (loaded.ties)
          keeper.emplace(*loaded.ties, mass.particles.cwiseInverse());
      }

      /** One step of all motions but the driven parameter. @return energy that damping takes [J] */
      double advance(const Unbalanced &unbalanced, LoadedMotion &motion)
      {
        for (Eigen::Index i = 0; i < motion.particles.cols(); ++i)
          for (int c = 0; c < motions; ++c)
            if (!(loaded.held[i] >> c & 1))
              kicked.particles(c, i) = kick(unbalanced.particles(c, i), mass.particles(c, i), speed.particles(c, i),
                                            lost_force.particles(c, i));
        if (keeper)
          keeper->correct(kicked.particles);
        double damped = 0;
        for (Eigen::Index i = 0; i < motion.particles.cols(); ++i)
          for (int c = 0; c < motions; ++c)
            if (!(loaded.held[i] >> c & 1))
              damped +=
                move(kicked.particles(c, i), lost_force.particles(c, i), speed.particles(c, i), motion.particles(c, i));
        for (int p = 0; p < 6; ++p)
          if (loaded.free[p])
            {
              const double next = kick(-unbalanced.loads[p], mass.loads[p], speed.loads[p], lost_force.loads[p]);
              damped += move(next, lost_force.loads[p], speed.loads[p], motion.loads[p]);
            }
        return damped;
      }

      double kinetic() const
      {
        double twice = 0;
        for (Eigen::Index i = 0; i < speed.particles.cols(); ++i)
          for (int c = 0; c < motions; ++c)
            twice += mass.particles(c, i) * speed.particles(c, i) * speed.particles(c, i);
        for (int p = 0; p < 6; ++p)
          twice += mass.loads[p] * speed.loads[p] * speed.loads[p];
        return 0.5 * twice;
      }

    private:
      /** @param lost force that damping takes, times the step @return the next velocity */
      double kick(const double force, const double inertia, const double v, double &lost) const
      {
        const double a     = force / inertia;
        const double along = a * (v + 0.5 * step * a);
        const double sign  = along > 0 ? 1.0 : along < 0 ? -1.0 : 0.0;
        lost               = step * damping * sign * force;
        return v + step * a * (1 - damping * sign);
      }

      /** @return energy lost to damping [J] */
      static double move(const double next, const double lost_force, double &v, double &x)
      {
        const double lost = lost_force * 0.5 * (v + next);
        v                 = next;
        x += step * v;
        return lost;
      }

      /** Sums of absolute stiffnesses, every motion measured as a length; then each turned back to its own unit. */
      void find_masses()
      {
        mass.particles.setZero();
        mass.loads.setZero();
        for (std::size_t i = 0; i < loaded.network.links.size(); ++i)
          {
            const ElasticLink &l = loaded.network.links[i];
            Eigen::Matrix3d    turn;
            turn << 0, -l.direction[2], l.direction[1], l.direction[2], 0, -l.direction[0], -l.direction[1],
              l.direction[0], 0;
            Eigen::Matrix<double, 3, 18> B; // first end, second end, loads
            B << -Eigen::Matrix3d::Identity(), l.arm_first / scale * turn, Eigen::Matrix3d::Identity(),
              l.arm_second / scale * turn, loaded.load_slip[i] / load_length;
            for (int p = 0; p < 6; ++p)
              if (!loaded.free[p])
                B.col(12 + p).setZero();
            Eigen::Matrix<double, 18, 1> rows =
              (B.transpose() * (l.stiffness + l.once_closed) * B).cwiseAbs().rowwise().sum();
            if (!l.turning.isZero(0)) // of relative rotation: half of a row is of the other end
              for (const int end : {3, 9})
                rows.segment<3>(end) += 2 * l.turning.cwiseAbs().rowwise().sum() / (scale * scale);
            mass.particles.col(l.first) += rows.segment<6>(0);
            mass.particles.col(l.second) += rows.segment<6>(6);
            mass.loads += rows.segment<6>(12);
          }
        if (loaded.body)
          for (Eigen::Index column = 0; column < loaded.body->stiffness.cols(); ++column)
            for (Eigen::SparseMatrix<double>::InnerIterator entry(loaded.body->stiffness, column); entry; ++entry)
              mass.particles(column % 3, static_cast<Eigen::Index>(loaded.network.particles()) + column / 3) +=
                std::fabs(entry.value());
        if (loaded.body && loaded.free[static_cast<std::size_t>(loaded.body->load)])
          add_masses_of_load(*loaded.body);
        const double *const first = mass.particles.data();
        const auto          n     = mass.particles.size();
        const double        mean  = std::accumulate(first, first + n, 0.0) / static_cast<double>(n);
        mass.particles            = (mass.particles.array() > 0).select(mass.particles, mean);
        mass.loads                = (mass.loads.array() > 0).select(mass.loads, mean);
        mass.particles.bottomRows<3>() *= scale * scale;
        mass.loads *= load_length * load_length;
      }

      /** What a body's load parameter and its joints are to each other. */
      void add_masses_of_load(const ElasticBody &body)
      {
        const Eigen::VectorXd between = body.by_load.cwiseAbs() / load_length;
        mass.loads[body.load] += between.sum() + std::fabs(body.of_load) / (load_length * load_length);
        mass.particles.topRightCorner(3, body.joints()) += between.reshaped(3, body.joints());
      }

      const LoadedNetwork &loaded;
      double               scale, load_length, damping;
      LoadedMotion         mass, speed, kicked, lost_force; ///< the last two during a step

      std::optional<Ties::Keeper> keeper; ///< where there are ties
    };
  } // namespace

  LinkRelaxationReport relax_links(const LoadedNetwork            &loaded,
                                   DamagingLinks                  &links,
                                   LoadedMotion                   &motion,
                                   const base::Vector6            &change,
                                   const LinkRelaxationParameters &p)
  {
    Relaxation           relaxation(loaded, p.damping);
    const double         scale        = mean_arm(loaded.network);
    const base::Vector6  part         = change / static_cast<double>(p.ramp_steps);
    base::Vector6        force_before = base::Vector6::Zero();
    int                  at_rest      = 0; // steps in a row: forces also vanish where all swings through
    LinkRelaxationReport report;
    for (;; ++report.steps)
      {
        links.evaluate(motion);
        links.commit();
        const Unbalanced unbalanced =
          unbalanced_of(loaded, motion, links.forces(), links.moments(), scale, p.least_borne);
        report.residual = unbalanced.residual;
        if (!std::isfinite(report.residual))
          throw base::NumericalError("quasi-static loading: a force is no longer a number after " +
                                     std::to_string(report.steps) + " steps of relaxation.");
        const bool ramp = report.steps < p.ramp_steps;
        if (report.steps > 0 && report.steps <= p.ramp_steps)
          report.external_work += 0.5 * (force_before + unbalanced.loads).dot(part);
        force_before         = unbalanced.loads;
        at_rest              = report.residual <= p.tolerance ? at_rest + 1 : 0;
        constexpr int enough = 20;
        report.converged     = !ramp && at_rest >= enough;
        if (report.converged || report.steps >= p.most_steps)
          {
            report.damped += relaxation.kinetic();
            return report;
          }
        report.damped += relaxation.advance(unbalanced, motion);
        if (ramp)
          motion.loads += part;
      }
  }
} // namespace dem
