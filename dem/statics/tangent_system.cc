#include "dem/statics/tangent_system.h"

#include "base/errors.h"
#include "base/solver_turns.h"
#include "dem/linear/unsymmetric_factor.h"
#include "dem/network/slip_matrices.h"
#include "dem/statics/changed_links.h"
#include "dem/statics/shared_tangent.h"
#include "dem/statics/surrounded_system.h"
#include "dem/statics/tangent_matrix.h"

#include <Eigen/CholmodSupport>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr double added_to_diagonal = 1e-9;
    constexpr double iterated_to       = 1e-6; ///< residual of an iteration, over the forces
  }                                            // namespace

  struct TangentSystem::Implementation
  {
    explicit Implementation(const LoadedNetwork &l)
      : loaded(l)
      , scale(mean_arm(l.network))
    {
      number_unknowns();
      for (int p = 0; p < 6; ++p)
        if (loaded.free[p] || p == loaded.driven)
          moving.push_back(p);
      for (int p = 0; p < 6; ++p)
        if (loaded.network.dimension == 3 || p < 2 || p == 5)
          all.push_back(p);
      starts = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknown.size() + SurroundedSystem::multipliers(loaded)),
                                     static_cast<Eigen::Index>(moving.size()));
    }

    /** For factors, when first needed. */
    void prepare_matrix()
    {
      if (around)
        return;
      matrix.emplace(loaded, unknown, first, scale, added_to_diagonal);
      around.emplace(loaded, unknown, count, matrix->undamaged_diagonal().mean());
    }

    Eigen::MatrixXd solve(const Eigen::MatrixXd &right) { return solve(factor, right); }

    Eigen::MatrixXd solve(const UnsymmetricFactor &by, const Eigen::MatrixXd &right)
    {
      return count == 0 ? right : Eigen::MatrixXd(around->motions_of(by.solve(around->forces(right))));
    }

    /** With the stiffness that links have undamaged, from which few differ: no factor of the whole is needed. */
    void factorize_undamaged()
    {
      prepare_matrix();
      const std::vector<base::Matrix6> stiffness = undamaged_stiffnesses(loaded);
      if (!factorize_by(undamaged_factor, stiffness))
        return;
      const Eigen::MatrixXd loads = -load_columns(stiffness, moving);
      // Beyond, the dense system takes longer than a new factor: as many operations as its cube, and slower ones.
      const double largest = std::cbrt(0.05 * undamaged_factor.operations());
      changed.emplace(
        loaded, unknown, count, scale, stiffness,
        [this](const Eigen::MatrixXd &right) { return solve(undamaged_factor, right); },
        static_cast<std::size_t>(largest));
      undamaged_answers = solve(undamaged_factor, loads);
    }

    /**
     * What is unbalanced, and minus the forces of the moving parameters, are answered by that motion.
     * @return nothing if too many links have changed, or the undamaged factor is singular
     */
    std::optional<Eigen::MatrixXd> answers_by_changes(const std::vector<base::Matrix6> &stiffness,
                                                      const Unbalanced                 &unbalanced)
    {
      // A step begins in equilibrium. The links that have changed there go on to change in it, and some more; where many do at once the
      // step is one that fails, and what they cost would be lost. Of solutions before, a restart would not know.
      constexpr double      equilibrium = 1e-5;
      constexpr std::size_t room        = 32;
      if (count == 0)
        return {};
      if (!tried_undamaged)
        factorize_undamaged();
      tried_undamaged = true;
      if (!changed)
        return {};
      const bool begins = unbalanced.residual <= equilibrium;
      if (begins)
        changed_at_start = changed->number(stiffness);
      if (!changed->take(stiffness, room + 2 * changed_at_start))
        return {};
      Eigen::MatrixXd x(count, undamaged_answers.cols() + 1);
      x.col(0)                              = solve(undamaged_factor, forces_of(unbalanced.particles));
      x.rightCols(undamaged_answers.cols()) = undamaged_answers - changed->under_loads(moving);
      changed->correct(x);
      return x;
    }

    /** As columns, what is unbalanced and minus the forces of the moving parameters. */
    Eigen::MatrixXd right_sides(const std::vector<base::Matrix6> &stiffness, const Unbalanced &unbalanced) const
    {
      Eigen::MatrixXd right(count, static_cast<Eigen::Index>(moving.size()) + 1);
      right.rightCols(static_cast<Eigen::Index>(moving.size())) = -load_columns(stiffness, moving);
      right.col(0)                                              = forces_of(unbalanced.particles);
      return right;
    }

    std::optional<Eigen::MatrixXd> answers_by_factor(const std::vector<base::Matrix6> &stiffness,
                                                     const Unbalanced                 &unbalanced)
    {
      if (!factorize(stiffness))
        return {};
      return solve(right_sides(stiffness, unbalanced));
    }

    std::optional<Eigen::MatrixXd> answers_by_iteration(const std::vector<base::Matrix6> &stiffness,
                                                        const Unbalanced                 &unbalanced,
                                                        const TangentSolver              &solver)
    {
      Eigen::MatrixXd x = right_sides(stiffness, unbalanced);
      if (count == 0)
        return x;
      if (!shared)
        shared.emplace(loaded, added_to_diagonal, solver.ranks);
      if (!shared->set(stiffness))
        return {};
      for (Eigen::Index k = 0; k < x.cols(); ++k)
        {
          // What is nearly balanced need not be balanced better than the path asks for; motions per step go on from the last ones.
          constexpr double at_most = 0.1;
          const double     enough =
            k == 0 && unbalanced.residual > 0 ? std::min(at_most, solver.negligible / unbalanced.residual) : 0.0;
          Eigen::VectorXd motion = k == 0 ? Eigen::VectorXd::Zero(starts.rows()) : Eigen::VectorXd(starts.col(k - 1));
          if (!shared->solve(of_all_motions(x.col(k)), std::max(iterated_to, enough), motion))
            return {};
          if (k > 0)
            starts.col(k - 1) = motion;
          for (std::size_t i = 0; i < unknown.size(); ++i)
            if (unknown[i] >= 0)
              x(unknown[i], k) = motion[static_cast<Eigen::Index>(i)];
        }
      return x;
    }

    Eigen::VectorXd of_all_motions(const Eigen::VectorXd &of_unknowns) const
    {
      Eigen::VectorXd all_motions = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknown.size()));
      for (std::size_t i = 0; i < unknown.size(); ++i)
        if (unknown[i] >= 0)
          all_motions[static_cast<Eigen::Index>(i)] = of_unknowns[unknown[i]];
      return all_motions;
    }

    void number_unknowns()
    {
      unknown.assign(loaded.held.size() * motions, -1);
      for (std::size_t i = 0; i < loaded.held.size(); ++i)
        {
          first.push_back(count);
          for (int c = 0; c < motions; ++c)
            if (!(loaded.held[i] >> c & 1))
              unknown[motions * i + c] = count++;
        }
      first.push_back(count);
    }

    bool factorize(const std::vector<base::Matrix6> &stiffness)
    {
      if (count == 0) // all particles are driven: nothing is left to solve for
        return true;
      prepare_matrix();
      return factorize_by(factor, stiffness);
    }

    bool factorize_by(UnsymmetricFactor &by, const std::vector<base::Matrix6> &stiffness)
    {
      matrix->assemble(stiffness);
      return by.factorize(around->whole(matrix->whole()), around->has_multipliers());
    }

    /** What is unbalanced, as forces on the unknowns. */
    Eigen::VectorXd forces_of(const CarrierMotions &on) const
    {
      Eigen::VectorXd right(count);
      for (std::size_t i = 0; i < loaded.held.size(); ++i)
        for (int c = 0; c < motions; ++c)
          if (const int u = unknown[motions * i + c]; u >= 0)
            right[u] = on(c, static_cast<Eigen::Index>(i)) / (c < 3 ? 1 : scale);
      return right;
    }

    /** Force on every unknown per unit of some parameters, from links of the given stiffness. */
    Eigen::MatrixXd load_columns(const std::vector<base::Matrix6> &stiffness, const std::vector<int> &of) const
    {
      Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(of.size()));
      for (std::size_t i = 0; i < stiffness.size(); ++i)
        {
          const ElasticLink &l     = loaded.network.links[i];
          const auto [J, K]        = slip_matrices(l, scale);
          const base::Matrix6 f    = stiffness[i].leftCols<3>() * loaded.load_slip[i];
          const Block         on_J = J.transpose() * f, on_K = K.transpose() * f;
          for (int c = 0; c < motions; ++c)
            for (std::size_t p = 0; p < of.size(); ++p)
              {
                if (const int u = unknown[motions * l.first + c]; u >= 0)
                  columns(u, static_cast<Eigen::Index>(p)) += on_J(c, of[p]);
                if (const int u = unknown[motions * l.second + c]; u >= 0)
                  columns(u, static_cast<Eigen::Index>(p)) += on_K(c, of[p]);
              }
        }
      if (loaded.body)
        for (std::size_t p = 0; p < of.size(); ++p)
          for (Eigen::Index x = 0; x < loaded.body->by_load.size() && of[p] == loaded.body->load; ++x)
            if (const int u = unknown[motions * (loaded.network.particles() + static_cast<std::size_t>(x / 3)) +
                                      static_cast<std::size_t>(x % 3)];
                u >= 0)
              columns(u, static_cast<Eigen::Index>(p)) += loaded.body->by_load[x];
      if (loaded.dead)
        for (std::size_t p = 0; p < of.size(); ++p)
          if (of[p] == loaded.dead->parameter)
            columns.col(static_cast<Eigen::Index>(p)) -= forces_of(loaded.dead->force);
      return columns;
    }

    LoadedMotion motion_of(const Eigen::VectorXd &x) const
    {
      LoadedMotion motion(loaded.held.size());
      for (std::size_t i = 0; i < loaded.held.size(); ++i)
        for (int c = 0; c < motions; ++c)
          if (const int u = unknown[motions * i + c]; u >= 0)
            motion.particles(c, static_cast<Eigen::Index>(i)) = c < 3 ? x[u] : x[u] / scale;
      return motion;
    }

    Eigen::VectorXd of_all(const base::Vector6 &parameters) const
    {
      Eigen::VectorXd values(static_cast<Eigen::Index>(all.size()));
      for (std::size_t p = 0; p < all.size(); ++p)
        values[static_cast<Eigen::Index>(p)] = parameters[all[p]];
      return values;
    }

    /** Change of the parameters' forces under a motion. */
    base::Vector6 load_forces(const std::vector<base::Matrix6> &stiffness, const LoadedMotion &motion) const
    {
      base::Vector6 sum = base::Vector6::Zero();
      for (std::size_t i = 0; i < stiffness.size(); ++i)
        {
          base::Vector6 strained;
          strained << slip_of(loaded, i, motion), turn_of(loaded, i, motion);
          sum += loaded.load_slip[i].transpose() * (stiffness[i].topRows<3>() * strained);
        }
      if (loaded.body)
        sum[loaded.body->load] +=
          loaded.body->by_load.dot(joints_of(loaded, motion)) + loaded.body->of_load * motion.loads[loaded.body->load];
      if (loaded.dead)
        {
          const DeadLoad &dead = *loaded.dead;
          const double    l = motion.loads[dead.parameter], p = motion.loads[dead.factor];
          sum[dead.factor] -= l * dead.by_factor;
          sum[dead.parameter] += dead.force_of(motion.particles, l, p);
        }
      return sum;
    }

    /** Let the free parameters take out their force; `left` of each is there to begin with. */
    void release(std::vector<LoadedMotion>        &answers,
                 const std::vector<base::Matrix6> &stiffness,
                 const base::Vector6              &left) const
    {
      // A row per parameter: its force vanishes; of the driven one and of those that stay zero, the step itself is given.
      base::Matrix6               D = base::Matrix6::Identity();
      Eigen::Matrix<double, 6, 2> h = Eigen::Matrix<double, 6, 2>::Zero();
      const base::Vector6         f = left + load_forces(stiffness, answers[0]);
      for (std::size_t p = 0; p < moving.size(); ++p)
        {
          const base::Vector6 change = load_forces(stiffness, answers[p + 1]);
          for (int q = 0; q < 6; ++q)
            if (loaded.free[q])
              D(q, moving[p]) = change[q];
        }
      for (int q = 0; q < 6; ++q)
        if (loaded.free[q])
          {
            const double unit = D.row(q).cwiseAbs().maxCoeff();
            D.row(q) /= unit;
            h(q, 0) = -f[q] / unit;
          }
      h(loaded.driven, 1)                     = 1;
      const Eigen::Matrix<double, 6, 2> steps = D.fullPivLu().solve(h);

      LoadedMotion constant = answers[0], per_step(loaded.held.size());
      for (std::size_t p = 0; p < moving.size(); ++p)
        {
          constant.particles += steps(moving[p], 0) * answers[p + 1].particles;
          per_step.particles += steps(moving[p], 1) * answers[p + 1].particles;
        }
      constant.loads += steps.col(0);
      per_step.loads = steps.col(1);
      answers        = {constant, per_step};
    }

    const LoadedNetwork &loaded;
    double               scale;
    int                  count = 0;
    std::vector<int>     unknown, first; ///< of each motion, -1 where held; of each particle, and the end
    std::vector<int>     moving;         ///< load parameters that are free or driven
    std::vector<int>     all;            ///< load parameters that there are, in the plane or in space

    std::optional<TangentMatrix>    matrix; ///< of the links, for factors
    std::optional<SurroundedSystem> around;
    UnsymmetricFactor               factor, undamaged_factor;

    bool                        tried_undamaged = false;
    std::optional<ChangedLinks> changed;              ///< from undamaged links, once these are factorised
    std::size_t                 changed_at_start = 0; ///< links, where the step began
    Eigen::MatrixXd             undamaged_answers;    ///< to the moving parameters

    std::optional<SharedTangent> shared; ///< once it has iterated
    Eigen::MatrixXd              starts; ///< for the moving parameters: motions of the last iteration, and multipliers
  };

  namespace
  {
    bool is_iterated(const LoadedNetwork &loaded, const TangentSolver &solver)
    {
      // Below, a factor takes little; in the plane it always does.
      constexpr std::size_t many = 30000;
      if (solver.method != SolverMethod::automatic)
        return solver.method == SolverMethod::iterative;
      return solver.ranks || (loaded.network.dimension == 3 && motions * loaded.held.size() >= many);
    }
  } // namespace

  TangentSystem::TangentSystem(const LoadedNetwork &network, const TangentSolver &how)
    : loaded(network)
    , solver(how)
    , by_iteration(is_iterated(network, how))
  {
  }

  TangentSystem::~TangentSystem() = default;

  TangentSystem::Implementation &TangentSystem::made()
  {
    const auto turn = base::ordering_turn();
    if (!self)
      self = std::make_unique<Implementation>(loaded);
    return *self;
  }

  double TangentSystem::length_scale() const { return mean_arm(loaded.network); }

  bool TangentSystem::solve(const std::vector<base::Matrix6> &stiffness, const Unbalanced &unbalanced, Answer &answer)
  {
    Implementation                &s = made();
    std::optional<Eigen::MatrixXd> found;
    if (by_iteration)
      found = s.answers_by_iteration(stiffness, unbalanced, solver);
    else if (found = s.answers_by_changes(stiffness, unbalanced); !found)
      found = s.answers_by_factor(stiffness, unbalanced);
    if (!found)
      return false;
    const Eigen::MatrixXd &x = *found;
    if (!x.allFinite())
      return false;
    std::vector<LoadedMotion> answers;
    for (Eigen::Index k = 0; k < x.cols(); ++k)
      {
        answers.push_back(s.motion_of(x.col(k)));
        if (k > 0)
          answers.back().loads[s.moving[k - 1]] = 1;
      }
    s.release(answers, stiffness, unbalanced.loads);
    answer.constant = answers[0];
    answer.per_step = answers[1];
    return answer.constant.particles.allFinite() && answer.per_step.particles.allFinite();
  }

  bool TangentSystem::solve_driven(const std::vector<base::Matrix6> &stiffness,
                                   const Unbalanced                 &unbalanced,
                                   const base::Vector6              &change,
                                   LoadedMotion                     &correction)
  {
    Implementation &s = made();
    if (!s.factorize(stiffness))
      return false;
    Eigen::VectorXd right = s.forces_of(unbalanced.particles);
    if (!change.isZero(0))
      right -= s.load_columns(stiffness, s.all) * s.of_all(change);
    const Eigen::VectorXd x = s.solve(right);
    correction              = s.motion_of(x);
    correction.loads        = change;
    return x.allFinite();
  }

  bool TangentSystem::condense(const std::vector<base::Matrix6> &stiffness, base::Matrix6 &forces)
  {
    Implementation &s = made();
    if (!s.factorize(stiffness))
      return false;
    const Eigen::MatrixXd right = -s.load_columns(stiffness, s.all);
    Eigen::MatrixXd       x     = s.solve(right);
    if (s.count > 0) // takes the addition back
      x += s.solve(Eigen::MatrixXd(added_to_diagonal * (s.matrix->undamaged_diagonal().asDiagonal() * x)));
    forces.setZero();
    for (std::size_t p = 0; p < s.all.size(); ++p)
      {
        LoadedMotion motion          = s.motion_of(x.col(static_cast<Eigen::Index>(p)));
        motion.loads[s.all[p]]       = 1;
        const base::Vector6 per_unit = s.load_forces(stiffness, motion);
        for (const int row : s.all)
          forces(row, s.all[p]) = per_unit[row];
      }
    return forces.allFinite();
  }

  bool TangentSystem::is_positive()
  {
    Implementation &s = made();
    if (s.count == 0)
      return true;
    s.prepare_matrix();
    s.matrix->assemble(undamaged_stiffnesses(loaded));
    Eigen::CholmodSupernodalLLT<SurroundedSystem::Sparse> factor;
    factor.cholmod().print = 0; // the answer is the caller's matter
    factor.compute(s.around->whole(s.matrix->whole()));
    return factor.info() == Eigen::Success;
  }

  void TangentSystem::visit_state(base::StateVisitor &visitor)
  {
    if (!by_iteration)
      return;
    Eigen::MatrixXd &starts = made().starts;
    base::Column     flat(starts.data(), starts.data() + starts.size());
    visitor.column("iteration_starts", flat);
    std::copy_n(flat.data(), starts.size(), starts.data());
  }
} // namespace dem
