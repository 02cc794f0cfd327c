#pragma once

#include "dem/cells/cell_system.h"
#include "dem/statics/damaging_links.h"
#include "dem/statics/link_relaxation.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace dem
{
  /** How a cell finds its equilibrium. */
  struct CellResponseParameters
  {
    double tolerance      = 1e-9; ///< see Unbalanced::residual, in (0, 1e-2]
    int    max_iterations = 15; ///< of Newton's method on one part of a step, > 1; three times as many with the secant
    double growth_step = 0.5; ///< largest growth of any link's damaging strain in one part of a step, over itself, > 0
    LinkRelaxationParameters relaxation; ///< its tolerance is the one above
    /**
     * What an answer could not reach in one part is kept until commit() or begin_step(): a cascade that it went through is the start of the
     * next answers too. Where particles end after a cascade depends on the path in the last digits, so that an answer computed afresh for
     * every strain would not be smooth, and a solver that iterates on the strain would not converge. Strains near the start of the last
     * part are likewise reached from there, so that the tangent is consistent with the answer.
     */
    bool keeps_its_way = false;
  };

  /** Energies of a cell since it was made [J]. */
  struct CellEnergy
  {
    double external_work = 0; ///< of the mean stress, by the trapezoidal rule over the parts of all steps
    double stored = 0, damage = 0, friction = 0;
    double damped = 0; ///< set free by cascades, and dissipated by the damping of relaxations

    double residual() const { return external_work - stored - damage - friction - damped; }
  };

  /** How a cell answers while none of its links damages or slides: linear in the strain (dem/homogenisation/relaxed_stiffness.h). */
  struct ElasticResponse
  {
    base::Matrix6 stiffness = base::Matrix6::Zero(); ///< [Pa]
    std::vector<base::Matrix6>
      motion; ///< of each particle beyond the affine field, a column per strain component [m], [-]
  };

  /** What a cell answers to a strain. */
  struct CellResponse
  {
    base::Vector6 stress = base::Vector6::Zero(); ///< mean [Pa], order 11 22 33 23 31 12
    /**
     * Derivative of the stress by the strain with all particles in equilibrium, consistent with the links' update [Pa]; where
     * the step was taken in parts, with the last of them; at the committed strain itself that of links which go on as in the step
     * before. Zero unless it was requested.
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
   * respond() starts from the committed state as often as wanted (but see CellResponseParameters::keeps_its_way), commit() makes the last
   * answer the state. Until then its iterations begin where the last answer with a tangent says that the particles are: an
   * answer is the same whatever was evaluated before to the tolerance, not to the bit, unless begin_step() comes between.
   * A copy is whole and knows nothing of the other. Same calls, same bits, for any number of threads; copies may be used by several threads at once.
   */
  class RespondingCell
  {
  public:
    /**
     * @param cell from strained_cell()
     * @param elastic of the same cell; as long as it is an equilibrium that no link leaves, it is the answer, and nothing is solved
     * @throws base::InputError for parameters out of range
     */
    RespondingCell(std::shared_ptr<const LoadedNetwork>   cell,
                   const LinkMaterials                   &materials,
                   const CellResponseParameters          &parameters = {},
                   std::shared_ptr<const ElasticResponse> elastic    = {});
    RespondingCell(const RespondingCell &);
    RespondingCell &operator=(const RespondingCell &);
    ~RespondingCell();

    /**
     * @param strain whole, from the undeformed cell [-], with engineering shears; in the plane 11 22 12 alone
     * @throws base::InputError for a strain that is not finite or leaves the plane; NumericalError if no equilibrium is found
     */
    CellResponse respond(const base::Vector6 &strain);
    /** The same with a linear system that cells of one network may share, one thread after the other. */
    CellResponse respond(const base::Vector6 &strain, CellSystem &shared, bool with_tangent = true);
    /** CellResponse::tangent of the last answer. @throws base::NumericalError if there is none */
    base::Matrix6 tangent(CellSystem &shared);
    void          commit();
    /** Another step from the committed state is sought: no attempt before shall matter. */
    void begin_step()
    {
      fallen.reset();
      way.reset();
      near_by.reset();
      may_be_near = false;
    }
    /** Of the committed state, if no link damaged or slid further: every link answers with its secant [Pa]. */
    base::Matrix6 unloading_stiffness(CellSystem &shared) const;

    /** Of the committed state. */
    const base::Vector6 &strain() const { return committed.motion.loads; }
    CellEnergy           energy() const;
    CellEnergy           energy_of_trial() const; ///< as it would be if the last answer were committed
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
      std::int64_t  is_elastic = 1; ///< all answers so far were those of the undamaged cell
    };

    /** Where the last part of an answer in this step began, and where it ended. */
    struct Way
    {
      State         begin;
      base::Vector6 end;

      /** Whether the last part would lead to that strain almost as well. */
      bool leads_to(const base::Vector6 &strain) const
      {
        return (strain - end).norm() <= 0.25 * (end - begin.motion.loads).norm();
      }
    };

    /** An answer of this step that was found in one part, and how its particles move with the strain. */
    struct NearBy
    {
      LoadedMotion      motion;
      CellSystem::Rates rates;
    };

    /** What answers start from, but for those to which a way leads. */
    const State &start() const { return fallen ? *fallen : committed; }
    void         evaluate(const LoadedMotion &motion);
    /** Whether the elastic solution is an equilibrium in which every link still has its first stiffness; then it is the trial. */
    bool respond_elastically(const base::Vector6 &strain);
    /** In one part, from where the last answer says that the particles will be. */
    bool respond_near_by(const base::Vector6 &strain);
    void walk_to(const base::Vector6 &strain);
    bool attempt(const base::Vector6 &strain, LinkStiffness stiffness, bool limited);
    bool iterate(LinkStiffness stiffness);
    void relax(const base::Vector6 &strain);
    /** By relaxation, where Newton's method has found nothing. */
    void fall_to(const base::Vector6 &strain);
    /** Make the trial the state that the next part starts from. */
    void go_on_from_here();

    std::shared_ptr<const LoadedNetwork>   cell;
    double                                 scale; ///< that makes forces of moments [m]
    CellResponseParameters                 parameters;
    State                                  committed, trial;
    std::optional<State>                   fallen; ///< where the cascade of an answer in this step has come to
    std::optional<Way>                     way;
    std::optional<NearBy>                  near_by;
    bool                                   may_be_near = false; ///< the last answer may become `near_by`
    std::shared_ptr<const ElasticResponse> elastic;             ///< nullptr: always solved for
    std::unique_ptr<CellSystem>            own;                 ///< each copy has its own, made when first needed
    CellSystem                            *system = nullptr;    ///< in use
    CellResponse                           answer;              ///< under way
  };
} // namespace dem
