#pragma once

#include "fem/solvers/linear_solver.h"

#include <functional>
#include <limits>
#include <optional>

namespace fem
{
  struct NewtonOptions
  {
    double       tolerance   = 1e-8; ///< unbalanced force over the largest of load, internal force and reaction
    unsigned int iterations  = 25;
    bool         line_search = true;

    /// Called for every state of the iteration: its number, and the unbalanced force over the tolerance. Empty: not called.
    std::function<void(unsigned int iteration, double over_tolerance)> on_iteration = {};
  };

  /// How the load parameter is found when it is not prescribed.
  struct PathControl
  {
    enum class Kind
    {
      indirect, ///< sum weight u = given increment: a crack opening, a deflection
      cylindrical ///< |Delta u| = given increment: arc length; smooth paths only, it loses a sharp snap-back at its corner
    };
    Kind                                                            kind = Kind::indirect;
    std::vector<std::pair<dealii::types::global_dof_index, double>> weights; ///< each on one rank only
  };

  /// What became of one step.
  struct StepReport
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    double       residual   = 0; ///< relative
    bool         rounded =
      false; ///< stopped at the rounding error of the forces, above the tolerance: slender or ill-scaled elements
    unsigned int relaxed = 0; ///< damped steps of a relaxation; 0: Newton alone
    std::string  reason;      ///< why not
  };

  /// Energies since the start [J].
  struct StaticEnergy
  {
    double external = 0; ///< work of loads and of prescribed displacements
    double internal = 0; ///< work of stresses, by trapezes over the steps
    double damped   = 0; ///< by the dampers of relaxations

    Dissipation dissipated; ///< by the materials, each point along its own path within the steps
  };

  /// All that a static analysis remembers besides the histories of its points.
  struct StaticState
  {
    double       time = 0, last_length = 0;
    StaticEnergy energy;
    Vector       displacement, last_step, internal_force;
  };

  /**
   * Equilibrium of a solid step by step: Newton with a line search, under load, displacement or path control.
   *
   * Loads and prescribed displacements follow the time; under path control they must be linear in it, and time is the
   * load parameter found by the solver (Ramm 1981; indirect: de Borst 1987). A step that fails changes nothing.
   */
  template <int dim>
  class StaticSolver
  {
  public:
    StaticSolver(Solid<dim> &solid, const NewtonOptions &newton = {}, const LinearSolverOptions &linear = {});

    static constexpr unsigned int any_number = std::numeric_limits<unsigned int>::max();

    /**
     * Tries to go to a time.
     *
     * Past the strength of a material several equilibria may lie at that time: other elements soften in each of them. An iteration
     * that wanders may end at any; the one to which the solid comes in short steps is stable.
     * @param trusted iterations up to which an equilibrium is taken as it is; one that took more must be stable, or the step fails
     */
    StepReport advance_to(double time, unsigned int trusted = any_number);

    /**
     * Goes to a time, where no equilibrium may lie near, as an overdamped body would: it lets go until it is in equilibrium.
     *
     * Dampers on all free displacements, as stiff as the solid at first, give way in implicit steps that grow while they are
     * easy; what they dissipate is energy().damped. Where Newton alone finds an equilibrium, no damper is used. A relaxation
     * that fails changes nothing.
     */
    StepReport relax_to(double time);

    /// Tries to go one increment of the control further.
    /// @throws base::InputError if loads or displacements are not linear in time.
    StepReport advance_along(const PathControl &control, double increment);

    double              time() const { return current_time; }
    const Vector       &displacement() const { return u; }
    const Vector       &internal_force() const { return f_int; } ///< at the end of the last step
    const Vector       &external_force() const { return f_ext; }
    const StaticEnergy &energy() const { return work; }
    std::string         linear_solver() const { return linear->description(); }
    unsigned int        linear_iterations() const { return linear->iterations(); }

    /// Sum of weight u over all ranks.
    double measure(const PathControl &control) const { return measure(control, u); }

    /// Resultant of the reactions on a boundary [N], for all components. Shared edges count with it.
    dealii::Tensor<1, dim> reaction(const std::string &boundary) const;

    /// What the solver carries from step to step; the histories of the points are the solid's (Solid::visit_histories()).
    StaticState state() const;

    /// Goes on from a saved state exactly as the solver that saved it would.
    void restore(const StaticState &saved);

  private:
    struct Trial
    {
      Vector u, f_int, f_ext;
      double time;
    };

    double measure(const PathControl &control, const Vector &of) const;
    bool   balanced(const Trial &trial, const Vector &r, double &scale, StepReport &report) const;
    void   set_tangent();

    /// Internal force and tangent at the trial displacement, and the product of the tangent with a direction if one is given.
    void       linearise(Trial &trial, const Vector *direction, Vector *product);
    void       unbalance(const Trial &trial, Vector &r) const;
    StepReport relax(double time);
    StepReport finish_or_fail(const StepReport &report, const Trial &trial);
    StepReport newton(Trial &trial);
    StepReport attempt(Trial &trial, double extrapolation);
    StepReport trusted_attempt(Trial &trial, double extrapolation, unsigned int trusted);

    /// Whether no direction is found on which the tangent, that of the trial that newton() ended with, does negative work.
    bool       stable();
    StepReport path_newton(Trial &trial, const PathControl &control, double increment);
    void       update_with_line_search(Trial &trial, const Vector &direction, double unbalanced);
    double     path_correction(const PathControl &control,
                               double             increment,
                               const Vector      &done,
                               const Vector      &to_balance,
                               const Vector      &by_load,
                               bool               first) const;
    void       prepare_path();

    Solid<dim>                   &solid;
    NewtonOptions                 options;
    Matrix                        tangent; // outlives the solver that refers to it
    std::unique_ptr<LinearSolver> linear;
    bool                          tangent_known = false; // linear problems: the set-up is reused
    double                        tangent_size  = 0;     // largest row sum [N/m]
    Vector                        u, f_int, f_ext, last_step;
    Vector                        load_0, load_1, support_0, support_1; // linear parts under path control
    Vector                        damper_from;      // displacement at which the dampers pull nothing
    double                        damper       = 0; // their stiffness in a step [N/m]; 0: none
    bool                          path_known   = false;
    double                        current_time = 0;
    double                        last_length  = 0; // of the last step, in time
    StaticEnergy                  work;
  };
}
