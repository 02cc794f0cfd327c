#pragma once

#include "fem/solid/solid.h"

#include <array>

namespace fem
{
  /// Which part of an element a node has where the element's share varies (SolidOptions::share).
  enum class SharedMass
  {
    rows, ///< sum over a row of the consistent mass: all together have the element's centre; of linear elements, others as `nearest`
    nearest ///< what lies nearest to it: a half, quarter or eighth of a linear element
  };

  struct ExplicitOptions
  {
    std::map<std::string, double> density;       ///< [kg/m^3], for every material name of the mesh
    double                        damping = 0.0; ///< alpha of the damping force alpha M v [1/s]
    double                        safety  = 0.9; ///< step over the critical step of the elements
    std::array<double, 3> gravity = {0, 0, 0};   ///< acceleration of what falls; its work is external work [m/s^2]
    SharedMass            shared  = SharedMass::rows;
  };

  /// Energies [J]; `external + start = kinetic + internal + damped` up to balance().
  struct ExplicitEnergy
  {
    double kinetic  = 0;
    double internal = 0; ///< work of stresses: stored and dissipated by the material
    double external = 0; ///< work of loads and prescribed motion
    double damped   = 0;
    double start    = 0; ///< kinetic energy given at the start

    /// What is missing or too much, over the largest of them.
    double balance() const;
  };

  /// What acts on a motion from outside, besides the solid's own loads.
  struct ExplicitOutside
  {
    Vector                         force;   ///< [N]; empty: none
    std::map<unsigned int, double> driven;  ///< velocity of prescribed displacements, by local number [m/s]
    std::map<unsigned int, double> carried; ///< displacements in the next step that are known, likewise [m]
    double work = 0, damped = 0, start = 0; ///< what changes since the last step add to the account, on this rank [J]
  };

  /// What the stable step of a deformed element was found with.
  struct ElementStep
  {
    std::vector<double> distances;      ///< squared, of its vertices from each other [m^2]
    double              eigenvalue = 0; ///< largest, of lumped mass and stiffness [1/s^2]
  };

  /// All that a motion remembers besides the histories of its points.
  struct ExplicitState
  {
    double                   time        = 0;
    bool                     started     = false;
    double                   last_length = 0; ///< of the step that led here [s]
    ExplicitEnergy           energy;
    Vector                   displacement, velocity, internal_force, mean_velocity;
    Vector                   last_motion; ///< displacement in the last step [m]
    ExplicitOutside          outside;
    Vector                   external_force; ///< as it was added up: what pushed and was taken back leaves its rounding
    std::vector<ElementStep> elements;       ///< locally owned ones, with large displacements
    std::int64_t             since_look = 0;
  };

  /**
   * Motion of a solid by central differences with a lumped mass (doc/theory/explicit-solver.md, 1).
   *
   * Mass lumped by scaling the diagonal of the consistent one (Hinton, Rock and Zienkiewicz 1976): positive for all elements.
   * Critical step 2 / omega with the largest eigenvalue of any element, which bounds that of the mesh (Irons and Treharne 1971). With large
   * displacements it follows the deformation: an element is updated when lengths in it have changed.
   */
  template <int dim>
  class ExplicitSolver
  {
  public:
    /// @throws base::InputError for a missing or non-positive density, a safety outside (0, 1], or negative damping.
    ExplicitSolver(Solid<dim> &solid, const ExplicitOptions &options);

    /// [s]; with large displacements of the elements as they are deformed now, to some per cent.
    double critical_step() const { return step_limit; }
    double step() const { return options.safety * step_limit; }

    /// Velocity at the start [m/s]; only before the first step.
    void set_velocity(const VectorOf<dim> &velocity);

    /// One step of this length [s], which may differ from the last one's. @throws MaterialFailure if a force is not a number.
    void advance(double length);

    double                time() const { return current_time; }
    const Vector         &displacement() const { return u; }
    const Vector         &velocity() const { return v; } ///< half a step back
    const Vector         &mass() const { return lumped; }
    double                density(dealii::types::material_id id) const; ///< [kg/m^3]
    const Vector         &internal_force() const { return f_int; }
    const Vector         &external_force() const { return f_ext; }
    const ExplicitEnergy &energy() const { return account; }
    double                largest_element_eigenvalue() const { return 4 / (step_limit * step_limit); } ///< [1/s^2]

    /// Before the first step: mass of something that rides on a locally owned displacement [kg].
    void add_mass(dealii::types::global_dof_index dof, double mass);

    /**
     * Push a locally owned displacement from outside [N], in every step until clear_forces(). Several add up; their work is external
     * work.
     */
    void add_force(dealii::types::global_dof_index dof, double force);
    void clear_forces();

    /// Velocities after a step of this length [s], if nothing more than now pushes [m/s].
    void predict(double length, Vector &velocity);
    /// Force that makes a locally owned displacement this much faster in that step [N/(m/s)]; 0: what is prescribed.
    double force_for_velocity(dealii::types::global_dof_index dof, double length) const;

    /**
     * In the next step a locally owned displacement grows by this much [m], and not by its velocity at the step's end: a coupling
     * has moved it in shorter steps. Ignored where it is prescribed.
     */
    void carry(dealii::types::global_dof_index dof, double by);

    /**
     * Change the velocity of a locally owned displacement at once [m/s], unless it is prescribed. The energy that this gives or takes
     * is external work, in the account after the next step; before the first step it is energy of the start.
     */
    void apply_impulse(dealii::types::global_dof_index dof, double change);

    /// From now on a locally owned displacement moves at this velocity [m/s]. @throws base::InputError where the solid's loads prescribe it
    void prescribe(dealii::types::global_dof_index dof, double velocity);

    /// Force that holds a prescribed displacement where it is, at the last whole step, inertia not counted [N].
    double reaction(dealii::types::global_dof_index dof) const;

    /// Internal force of a displacement, by the kernel that the steps use (elastic parts), histories untouched until the next step.
    void internal_force_at(const Vector &displacement, Vector &force);

    /// What the solver carries from step to step; the histories of the points are the solid's (Solid::visit_histories()).
    ExplicitState state() const;

    /// Goes on from a saved state exactly as the solver that saved it would.
    void restore(const ExplicitState &saved);

  private:
    void lump_mass();
    void find_weight();
    void find_step();
    void limit_step(double largest_eigenvalue); ///< of this rank's elements
    void follow_deformation();                  ///< the step of elements whose lengths have changed
    /// Squared distances of an element's vertices where they are now [m^2].
    std::vector<double> vertex_distances(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const;
    double kicked(unsigned int i, double old, double kick) const; ///< velocity after a kick by the present forces
    void   find_forces_of_start();
    double next_velocity(unsigned int i, double length, double kick) const; ///< @pre `target` is that of the step's end
    double kick_of(double length) const; ///< time that forces push for in a step of this length [s]
    void   keep_account(double length, double pushed);
    void   find_external_force();
    unsigned int local(dealii::types::global_dof_index dof) const;

    Solid<dim>              &solid;
    ExplicitOptions          options;
    std::vector<char>        held; ///< whether each owned displacement is prescribed
    ExplicitOutside          outside;
    double                   last_length = 0;
    Vector                   u, v, f_int, f_ext, lumped;
    Vector                   weight; ///< of every displacement along its own axis [N]; empty: none
    Vector                   mean;   ///< velocity at the last whole step, for the damping work
    Vector                   moved, target, f_before, e_before; ///< of a step
    std::vector<ElementStep> elements;                          ///< locally owned ones, with large displacements only
    std::int64_t             since_look   = 0;                  ///< steps since lengths were last compared
    double                   step_limit   = 0;
    double                   current_time = 0;
    bool                     started      = false;
    ExplicitEnergy           account;
  };
}
