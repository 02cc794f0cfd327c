#include "dem/peridynamics/stiffness.h"

#include "base/solver_turns.h"
#include "dem/peridynamics/bond_operator.h"

#include <Eigen/CholmodSupport>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace dem::peridynamics
{
  namespace
  {
    using Index  = SuiteSparse_long;
    using Lower  = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;
    using Factor = Eigen::CholmodSupernodalLLT<Lower, Eigen::Lower>;

    /** Conjugate gradients on the factor of nearly the same matrix need two or three iterations. */
    class FactorPreconditioner
    {
    public:
      const Factor *factor = nullptr;

      template <typename Matrix>
      FactorPreconditioner &analyzePattern(const Matrix &)
      {
        return *this;
      }
      template <typename Matrix>
      FactorPreconditioner &factorize(const Matrix &)
      {
        return *this;
      }
      template <typename Matrix>
      FactorPreconditioner &compute(const Matrix &)
      {
        return *this;
      }
      template <typename Right>
      Eigen::VectorXd solve(const Right &b) const
      {
        const auto turn = base::dense_kernels_turn();
        return factor->solve(Eigen::VectorXd(b));
      }
      Eigen::ComputationInfo info() { return Eigen::Success; }
    };

    /** Derivative of a bond's force to the displacement of its second end, at that end with the sign of a stiffness [N/m]. */
    Eigen::Matrix3d tangent(const Bonds           &bonds,
                            const Kinematics       kinematics,
                            const std::size_t      bond,
                            const std::size_t      o,
                            const Eigen::Vector3d &eta)
    {
      const Offset         &offset  = bonds.offsets()[o];
      const double          spacing = bonds.grid().spacing(), l = offset.length * spacing, k = bonds.stiffness()[bond];
      const Eigen::Vector3d xi = spacing * Eigen::Vector3d(offset.steps[0], offset.steps[1], offset.steps[2]);
      if (kinematics == Kinematics::linear)
        return k / (l * l * l) * xi * xi.transpose();
      const Eigen::Vector3d y   = xi + eta;
      const double          now = y.norm(), squares = eta.dot(2 * xi + eta), s = squares / (l * (l + now));
      const Eigen::Vector3d e       = y / now;
      const Eigen::Matrix3d outward = e * e.transpose();
      return k / l * outward + k * s / now * (Eigen::Matrix3d::Identity() - outward);
    }
  } // namespace

  struct Stiffness::Implementation
  {
    int                         dimension = 0;
    std::vector<Index>          unknown; ///< by place and component; -1: held, or no node
    Index                       unknowns = 0;
    std::optional<BondOperator> product; ///< in place of the matrix, where directions of bonds do not change
    Lower                       matrix;
    bool                        analysed = false;
    double                      shift    = 0; ///< part of the diagonal that the factor has besides
    Factor                      factor;

    Index &number(const std::size_t place, const int component)
    {
      return unknown[place * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(component)];
    }

    void number_unknowns(const Grid &of, const Held &held)
    {
      const std::vector<Index> before = unknown;
      dimension                       = of.dimension();
      unknown.assign(of.places() * static_cast<std::size_t>(dimension), -1);
      unknowns = 0;
      for (const std::size_t i : of.nodes())
        for (int c = 0; c < dimension; ++c)
          if (!(held[i] >> c & 1))
            number(i, c) = unknowns++;
      analysed = analysed && before == unknown;
    }

    /** Lower triangle: the columns of a node have its own rows and those of its bonds' second ends, which ascend. */
    void fill(const Bonds &bonds, const Kinematics kinematics, const Field &u)
    {
      std::vector<Eigen::Matrix3d> own(bonds.grid().places(), Eigen::Matrix3d::Zero());
      struct End
      {
        std::size_t     place;
        Eigen::Matrix3d block;
      };
      std::vector<std::vector<End>> ends(bonds.grid().nodes().size());
      bonds.each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
        const Eigen::Matrix3d block = tangent(bonds, kinematics, bond, o, u.at(j) - u.at(i));
        own[i] += block;
        own[j] += block;
        ends[static_cast<std::size_t>(bonds.grid().number(i))].push_back({j, -block});
      });
      std::vector<Index>  begin{0}, rows;
      std::vector<double> values;
      double              mean = 0;
      for (const std::size_t i : bonds.grid().nodes())
        mean += own[i].trace() / static_cast<double>(bonds.grid().nodes().size() * static_cast<std::size_t>(dimension));
      for (std::size_t n = 0; n < bonds.grid().nodes().size(); ++n)
        for (int c = 0; c < dimension; ++c)
          {
            const std::size_t i = bonds.grid().nodes()[n];
            if (number(i, c) < 0)
              continue;
            // What nothing holds any more has an ordinary stiffness of its own: it is not loaded, and stays where it is.
            if (own[i](c, c) < 1e-14 * mean)
              own[i](c, c) = mean;
            const auto add = [&](const std::size_t place, const int first, const Eigen::Matrix3d &block) {
              for (int r = first; r < dimension; ++r)
                if (number(place, r) >= 0)
                  {
                    rows.push_back(number(place, r));
                    values.push_back(block(r, c));
                  }
            };
            add(i, c, own[i]);
            for (const End &end : ends[n])
              add(end.place, 0, end.block);
            begin.push_back(static_cast<Index>(rows.size()));
          }
      matrix = Eigen::Map<const Lower>(unknowns, unknowns, static_cast<Index>(rows.size()), begin.data(), rows.data(),
                                       values.data());
    }

    /**
     * With a tiny part of the diagonal besides, so that a mechanism of nearly broken nodes does not stop it; with more of it where the body
     * is not stable as it stands: Newton's steps are then shorter, and lead away from there.
     * @return whether any part sufficed
     */
    bool factorise()
    {
      constexpr double least = 1e-10, most = 1e-2;
      for (shift = least; shift <= most; shift *= 100)
        {
          Lower shifted = matrix;
          for (Index i = 0; i < unknowns; ++i)
            shifted.coeffRef(i, i) *= 1 + shift;
          if (!analysed)
            {
              const auto turn = base::ordering_turn();
              factor.analyzePattern(shifted);
            }
          analysed        = true;
          const auto turn = base::dense_kernels_turn();
          factor.factorize(shifted);
          if (factor.info() == Eigen::Success)
            return true;
        }
      return false;
    }

    /** Whether the matrix itself is positive definite but for mechanisms. */
    bool stable() const { return shift < 1e-9; }

    /** @return whether it comes nearer to a solution: what is left, another call may take */
    template <typename Iteration>
    bool answer(
      Iteration &iteration, const int most, const Eigen::VectorXd &b, const double tolerance, Eigen::VectorXd &x) const
    {
      iteration.setTolerance(tolerance);
      iteration.setMaxIterations(most);
      x = iteration.solve(b);
      return iteration.info() == Eigen::Success || iteration.error() < nearer;
    }

    /** Residual over the right-hand side from which on a solution is one; what bears otherwise moves nothing but a mechanism. */
    static constexpr double nearer = 1e-3;
  };

  Stiffness::Stiffness(const Solver how)
    : self(std::make_unique<Implementation>())
    , solver(how)
  {
  }
  Stiffness::~Stiffness() = default;

  bool Stiffness::assemble(const Bonds &bonds, const Kinematics kinematics, const Held &held, const Field &u)
  {
    self->number_unknowns(bonds.grid(), held);
    self->product.reset();
    if (solver == Solver::iterative && kinematics == Kinematics::linear)
      {
        std::vector<bool> free;
        for (const Index n : self->unknown)
          free.push_back(n >= 0);
        self->product.emplace(bonds, free);
        return true;
      }
    self->fill(bonds, kinematics, u);
    return solver != Solver::direct || self->factorise();
  }

  bool Stiffness::solve(const Field &r, const double tolerance, Field &du) const
  {
    constexpr int     most_iterations = 20000;
    Eigen::VectorXd   b(self->unknowns);
    const std::size_t places = r.c[0].size();
    const auto        each   = [&](auto &&f) {
      for (std::size_t i = 0; i < places; ++i)
        for (int c = 0; c < self->dimension; ++c)
          if (const Index n = self->number(i, c); n >= 0)
            f(n, static_cast<std::size_t>(c), i);
    };
    each([&](const Index n, const std::size_t c, const std::size_t i) { b[n] = r.c[c][i]; });
    Eigen::VectorXd x;
    if (solver == Solver::direct && !self->stable())
      {
        const auto turn = base::dense_kernels_turn();
        x               = self->factor.solve(b);
      }
    else if (solver == Solver::direct)
      {
        Eigen::ConjugateGradient<Lower, Eigen::Lower, FactorPreconditioner> iteration(self->matrix);
        iteration.preconditioner().factor = &self->factor;
        if (!self->answer(iteration, 500, b, tolerance, x))
          return false;
      }
    else if (self->product)
      {
        if (!(self->product->solve(b, tolerance, most_iterations, x) < std::max(tolerance, Implementation::nearer)))
          return false;
      }
    else
      {
        Eigen::ConjugateGradient<Lower, Eigen::Lower> iteration(self->matrix);
        if (!self->answer(iteration, most_iterations, b, tolerance, x))
          return false;
      }
    du = Field(self->dimension, places);
    each([&](const Index n, const std::size_t c, const std::size_t i) { du.c[c][i] = x[n]; });
    return true;
  }

  std::size_t Stiffness::unknowns() const { return static_cast<std::size_t>(self->unknowns); }
} // namespace dem::peridynamics
