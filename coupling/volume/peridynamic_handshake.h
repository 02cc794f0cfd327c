#pragma once

#include "coupling/participants/peridynamic_participant.h"
#include "coupling/volume/multipliers.h"
#include "coupling/volume/node_map.h"
#include "coupling/volume/parameters.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace coupling
{
  /** Leave stiffness and mass in an overlap to the solid as far as they are its. @throws base::InputError for a node beyond the overlap */
  void share_with_solid(dem::peridynamics::Bonds &bonds, const VolumeCouplingParameters &parameters);

  /**
   * A peridynamic core inside a solid, in explicit motion (doc/theory/peridynamics.md, 8): in the overlap both share stiffness and mass, and
   * multipliers keep their velocities together after each step, which both take at once.
   */
  template <int dim>
  class PeridynamicHandshake
  {
  public:
    /**
     * All but the parameters must outlive it.
     * @param core of bonds that share_with_solid() has seen
     * @param solid made with Overlap::of_solid() as its share
     * @throws base::InputError where no node lies in the overlap, or one of them not in the solid
     */
    PeridynamicHandshake(PeridynamicParticipant         &core,
                         const fem::Solid<dim>          &solid,
                         fem::ExplicitSolver<dim>       &motion,
                         SolidParticipant<dim>          &around,
                         const VolumeCouplingParameters &parameters);

    std::size_t in_overlap() const { return carriers.size(); } ///< nodes of the core
    std::size_t nodes() const { return node_map.nodes().size(); }

    /** Of both [s]; what is shared is never stiffer over its mass than what is whole. */
    double stable_step() const { return std::min(core.stable_step(), around.stable_step()); }

    /** A step of both, no longer than the stable one [s]. */
    void advance(double step);

    const Eigen::Vector3d &to_core() const { return given_to_core; }     ///< momentum [N s]
    const Eigen::Vector3d &to_solid() const { return given_to_solid; }   ///< likewise
    double                 work_on_core() const { return done_on_core; } ///< of what keeps both together [J]
    double work_on_solid() const { return done_on_solid; } ///< likewise; both add up to nothing but rounding
    /** Largest velocity between both, as multipliers leave it: of the mean around a node, or at a node of the core [m/s]. */
    double apart() const { return left_apart; }

    void visit_state(base::StateVisitor &visitor);

  private:
    void find_nodes();
    void weigh();
    /** @param of_core, of_solid velocities after the step, before what is changed */
    void keep_account(const CarrierRows &of_core, const CarrierRows &of_solid, const CarrierChanges &change);

    PeridynamicParticipant    &core;
    const fem::Solid<dim>     &solid;
    fem::ExplicitSolver<dim>  &motion;
    SolidParticipant<dim>     &around;
    VolumeCouplingParameters   own;
    NodeMap<dim>               node_map;
    std::vector<std::size_t>   carriers; ///< of the core
    WeightRows                 weights;
    std::optional<Multipliers> multipliers;
    fem::Vector                predicted;
    CarrierRows                core_mass, solid_mass;
    Eigen::Vector3d            given_to_core = Eigen::Vector3d::Zero(), given_to_solid = Eigen::Vector3d::Zero();
    double                     left_apart = 0, done_on_core = 0, done_on_solid = 0;
  };
} // namespace coupling
