#pragma once

#include "fem/solid/solid.h"

#include <memory>
#include <string>

namespace fem
{
  enum class LinearMethod
  {
    automatic, ///< direct up to `direct_limit` unknowns; else geometric where it fits, iterative where not
    direct,    ///< UMFPACK, on the first rank for all
    iterative, ///< algebraic multigrid (Trilinos ML) in conjugate gradients, or in GMRES where the matrix is not symmetric
    geometric ///< geometric multigrid in conjugate gradients, no matrix: elastic solids on meshes refined as a whole
  };

  struct LinearSolverOptions
  {
    LinearMethod method     = LinearMethod::automatic;
    double       tolerance  = 1e-10; ///< residual over right-hand side, iterative methods; well below Newton's own
    unsigned int iterations = 2000;
    unsigned int direct_limit =
      0; ///< unknowns; 0: 200 000 in two dimensions, 30 000 in three (fill-in grows faster there)
  };

  /// Solves with the tangent of a solid; factorises or sets up once, solves for several right-hand sides.
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /// @throws MaterialFailure if the matrix is singular: a solver answers with a shorter step.
    virtual void set_matrix(const Matrix &matrix) = 0;

    /// @throws MaterialFailure if the iteration does not converge.
    virtual void solve(Vector &solution, const Vector &right_side) = 0;

    /// Whether set_matrix() must be called before solve(); a method without a matrix knows the solid itself.
    virtual bool wants_matrix() const { return true; }

    /// Without a matrix: a lower bound of its largest row sum [N/m], for the rounding of the forces.
    virtual double matrix_size() const { return 0; }

    /// Which method, and why it was chosen.
    virtual std::string description() const = 0;

    /// Iterations of the last solve; 1 for direct methods.
    virtual unsigned int iterations() const { return 1; }
  };

  /// Call it after the loads of the solid are set.
  /// @param symmetric whether the tangent always is (elastic materials).
  /// @throws base::InputError if the requested method does not fit the solid, with the reason.
  template <int dim>
  std::unique_ptr<LinearSolver>
  make_linear_solver(const Solid<dim> &solid, const LinearSolverOptions &options, bool symmetric);
}
