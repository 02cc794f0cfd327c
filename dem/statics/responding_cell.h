#pragma once

#include "dem/statics/damaging_links.h"
#include "dem/statics/link_relaxation.h"
#include "dem/statics/tangent_system.h"

#include <cstdint>
#include <memory>

namespace dem
{
  /** How a cell finds its equilibrium. */
  struct CellResponseParameters
  {
    double tolerance      = 1e-9; ///< see Unbalanced::residual, in (0, 1e-2]
    int    max_iterations = 15; ///< of Newton's method on one part of a step, > 1; three times as many with the secant
    double growth_step = 0.5; ///< largest growth of any link's damaging strain in one part of a step, over itself, > 0
    LinkRelaxationParameters relaxation; ///< its tolerance is the one above
  };

  /** Energies of a cell since it was made [J]. */
  struct CellEnergy
  {
    double external_work = 0; ///< of the mean stress, by the trapezoidal rule over the parts of all steps
    double stored = 0, damage = 0, friction = 0;
    double damped = 0; ///< set free by cascades, and dissipated by the damping of relaxations

    double residual() const { return external_work - stored - damage - friction - damped; }
  };

  /** What a cell answers to a strain. */
  struct CellResponse
  {
    base::Vector6 stress = base::Vector6::Zero(); ///< mean [Pa], order 11 22 33 23 31 12
    /**
     * Derivative of the stress by the strain with all particles in equilibrium, consistent with the links' update [Pa]; where
     * the step was taken in parts, with the last of them.
     */
    base::Matrix6 tangent          = base::Matrix6::Zero();
    int           iterations       = 0; ///< linear solutions
    int           parts            = 0; ///< the step was taken in
    std::int64_t  relaxation_steps = 0; ///< above 0: a cascade, equilibrium was found by dynamics
    double        residual         = 0; ///< see Unbalanced::residual
  };

  /**
   * A periodic cell of links that damage and slide, as a material point: strain in, stress and consistent tangent out
   * (doc/theory/periodic-cell.md). Small strain; without inertia.
   *
   * respond() starts from the committed state as often as wanted, commit() makes the last answer the state. A copy is whole and
   * knows nothing of the other. Same calls, same bits, for any number of threads; copies may be used by several threads at once.
   */
  class RespondingCell
  {
  public:
    /** @param cell from strained_cell() @throws base::InputError for parameters out of range */
    RespondingCell(std::shared_ptr<const LoadedNetwork> cell,
                   const LinkMaterials                 &materials,
                   const CellResponseParameters        &parameters = {});
    RespondingCell(const RespondingCell &);
    RespondingCell &operator=(const RespondingCell &);
    ~RespondingCell();

    /**
     * @param strain whole, from the undeformed cell [-], with engineering shears; in the plane 11 22 12 alone
     * @throws base::InputError for a strain that is not finite or leaves the plane; NumericalError if no equilibrium is found
     */
    CellResponse respond(const base::Vector6 &strain);
    void         commit();

    /** Of the committed state. */
    const base::Vector6 &strain() const { return committed.motion.loads; }
    CellEnergy           energy() const;
    const DamagingLinks &links() const { return committed.links; }
    const LoadedMotion  &motion() const { return committed.motion; }

    /** Everything committed. */
    void visit_state(base::StateVisitor &visitor);

  private:
    struct State
    {
      DamagingLinks links;
      LoadedMotion  motion;
      Unbalanced    unbalanced;
      double        external_work = 0, damped = 0;
    };

    void evaluate(const LoadedMotion &motion);
    bool attempt(const base::Vector6 &strain, LinkStiffness stiffness, bool limited);
    bool iterate(LinkStiffness stiffness);
    void relax(const base::Vector6 &strain);
    /** Make the trial the state that the next part starts from. */
    void go_on_from_here();

    std::shared_ptr<const LoadedNetwork> cell;
    double                               scale; ///< that makes forces of moments [m]
    CellResponseParameters               parameters;
    State                                committed, trial;
    std::unique_ptr<TangentSystem>       system; ///< each copy has its own, made when first needed
    CellResponse                         answer; ///< under way
  };
} // namespace dem
