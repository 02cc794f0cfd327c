#pragma once

#include "base/state.h"
#include "coupling/participants/solid_participant.h"
#include "coupling/volume/absorber.h"
#include "coupling/volume/bond_ends.h"
#include "coupling/volume/multipliers.h"
#include "coupling/volume/node_map.h"
#include "coupling/volume/parameters.h"
#include "dem/specimen/specimen.h"

#include <optional>
#include <string>
#include <vector>

namespace coupling
{
  /** What went through the overlap since the start. */
  struct VolumeBalance
  {
    Eigen::Vector3d to_particles = Eigen::Vector3d::Zero(), to_solid = Eigen::Vector3d::Zero(); ///< momentum [N s]
    /** Angular momentum about the origin: undeformed, where the solid's displacements are small [N m s] */
    Eigen::Vector3d turn_to_particles = Eigen::Vector3d::Zero(), turn_to_solid = Eigen::Vector3d::Zero();
    double          work_on_particles = 0, work_on_solid = 0; ///< of what keeps them together [J]
    double          absorbed = 0;                             ///< by the absorber, from both [J]
    double double_counted = 0; ///< double-counted: stored in bonds of constrained particles and in elements as well [J]

    /** Made by the transfer itself, zero but for rounding (lumped and sub-cycled: lost) [J]. */
    double spurious() const { return work_on_particles + work_on_solid - double_counted; }
  };

  /**
   * Particles inside a solid: a handshake. The solid has to be made with Overlap::of_solid() as its share, unless particles are constrained.
   *
   * In each window of time: begin(), then in each step of the particles corrected_in() and correct(), and finish() before the solid takes
   * its own step.
   */
  template <int dim>
  class VolumeCoupling
  {
  public:
    /**
     * All but the parameters must outlive the coupling. Particles leave their part to the solid (Specimen::share(), Specimen::leave()).
     * @throws base::InputError where there are no particles in the overlap, where one of them is not in the solid
     */
    VolumeCoupling(dem::Specimen                  &specimen,
                   const fem::Solid<dim>          &solid,
                   fem::ExplicitSolver<dim>       &motion,
                   SolidParticipant<dim>          &participant,
                   const VolumeCouplingParameters &parameters);

    /** Whose steps it corrects, by packing number. */
    const std::vector<std::size_t> &particles() const { return watched; }
    /** How many of them lie in the overlap: the first. */
    std::size_t in_overlap() const { return overlapping; }
    std::size_t nodes() const { return node_map.nodes().size(); }
    /** The same as carriers of the solid's participant. */
    const std::vector<std::size_t> &node_carriers() const { return node_map.nodes(); }

    /** The solid is about to go through a window [s]; forces on it by others are known. */
    void begin(double window);
    /** How many of its particles, from the first, the next step corrects. @param kick halves of the steps that meet there [s] */
    std::size_t corrected_in(double kick);
    /** Of one step of the particles in it. @param first where this coupling's particles begin in the correction */
    void correct(dem::StepCorrection &correction, std::size_t first);
    /** Push the solid as the particles did in the window. */
    void finish();

    /** Bonds with an end in the overlap that both sides share: how many there are, and how many have been damaged or are gone. */
    std::size_t bonds() const { return shared_bonds; }
    std::size_t damaged_bonds() const;

    const VolumeBalance &balance() const { return exchanged; }
    /** In every step, whatever its length: lumped ties. */
    bool               loses_by_itself() const { return own.lumped; }
    const std::string &name() const { return own.name; }
    /** Bound of what constrained particles add to the squares of the solid's frequencies [1/s^2]. */
    double added_eigenvalue() const { return added; }

    void visit_state(base::StateVisitor &visitor);

  private:
    using Entry                       = typename NodeMap<dim>::Entry;
    static constexpr std::size_t axes = 6; ///< of a particle in a correction
    /** Velocities along the axes of particles in a correction. */
    using CorrectedRows = Eigen::Map<CarrierRows, Eigen::Unaligned, Eigen::OuterStride<>>;

    /** All, and damaged ones. */
    std::pair<std::size_t, std::size_t> count_shared_bonds() const;

    bool lies_in_solid(const Eigen::Vector3d &place) const;
    void refuse_order_2_where_masses_are_negative() const;
    void find_particles();
    void share();
    void leave();
    /** Forces of bonds to constrained particles in elements, while the bonds exist. @return mass of the constrained beside elements, over their whole one */
    std::vector<double> find_bond_ends();
    void                weigh_nodes();
    void                place_nodes(); ///< undeformed
    /** Nodes take what the angular momentum of the window lacks, where ties let particles slip or have acted on the way. */
    void keep_turning();
    /** Multipliers for so many steps of the particles in one of the solid. */
    void tie(double steps);
    void make_absorber();
    /** Of spins, which elements have none of. @param rates at which motion is damped [1/s] */
    void   make_spin_absorber(const Eigen::VectorXd &rates);
    double longest_absorption() const; ///< that takes one go [s]
    void   find_stiffness_of_constrained();
    /** Points of the solid just outside the overlap, where particles would be if they went on. */
    void         enter_points(AbsorberCarriers &all);
    unsigned int points_per_axis() const; ///< of an element
    CarrierRows  of_nodes(const fem::Vector &field) const;
    /** Where nodes are in the window now [m]. */
    CarrierRows nodes_now() const { return undeformed + displaced + path; }
    void        drive(dem::StepCorrection &correction, std::size_t first);
    /** Its parts: forces of constrained particles and of bond ends on nodes, and motion of the former. @return forces on them, nullptr: none */
    std::vector<const double *> push_nodes(const dem::StepCorrection &correction, std::size_t first, double kick);
    void                        move_constrained(dem::StepCorrection &correction, std::size_t first);
    void                        keep_account_of_constrained(const dem::StepCorrection         &correction,
                                                            std::size_t                        first,
                                                            const std::vector<const double *> &pulls);
    /** Of one of the watched when the step's forces act: undeformed, where the solid's displacements are small [m]. */
    Eigen::Vector3d place_at_kick(std::size_t k) const;
    /** @param before velocities of the nodes before the step */
    void keep_together(dem::StepCorrection &correction, std::size_t first, const CarrierRows &before);
    /** Its parts. @param together what multipliers change of particles is added */
    void constrain(CorrectedRows &now, CarrierRows &together);
    /** @return what it changes of particles */
    CarrierRows absorb(const CorrectedRows &before, CorrectedRows &now, const CarrierRows &nodes_before, double time);
    void        absorb_spins(dem::StepCorrection &correction, std::size_t first, double time);

    dem::Specimen            &specimen;
    const fem::Solid<dim>    &solid;
    fem::ExplicitSolver<dim> &motion;
    SolidParticipant<dim>    &participant;
    VolumeCouplingParameters  own;
    NodeMap<dim>              node_map;
    std::vector<Entry>        at_particles; ///< weights at the particles of the overlap
    Eigen::SparseMatrix<double>
      of_bond_ends; ///< stiffness of bonds of constrained particles in elements, three motions of each node [N/m]
    std::vector<BondEnd>         ends;          ///< where they turn, in place of that
    std::vector<Entry>           at_ends;       ///< likewise: weights of nodes at the ends, two of each
    bool                         turns = false; ///< constrained particles, as far as the solid does
    bool                         far = false; ///< displacements are large: moments are those of where everything is now
    std::vector<std::size_t>     watched;
    std::vector<Eigen::Vector3d> places; ///< of the watched, undeformed [m]
    std::size_t                  overlapping = 0;
    Eigen::VectorXd              whole_mass; ///< of the watched, as if they did not share [kg]
    Eigen::VectorXd parts; ///< of the particles of the overlap that lie between its sides, where multipliers need them
    CarrierRows     mass, inverse_mass, node_mass, inverse_node_mass; ///< as they count; zero inverse: prescribed
    double          ratio         = 0;                                ///< of steps for which the multipliers are
    Eigen::Index    overlap_nodes = 0;                                ///< nodes that weigh on its particles: the first
    std::optional<Multipliers>       multipliers;
    std::optional<FineScaleAbsorber> absorber, spin_absorber;
    CarrierRows                      inertia, inverse_inertia; ///< as masses
    double                           added        = 0;
    double                           waited       = 0; ///< since the absorber last damped [s]
    std::int64_t                     steps_waited = 0;
    bool                             absorbs_now  = false;

    double          window = 0;         ///< that has begun [s]
    fem::Vector     predicted;          ///< velocities at its end, if nothing of here pushed [m/s]
    CarrierRows     from, to, velocity; ///< of the nodes: at its start, as predicted for its end, now [m/s]
    CarrierRows     path;               ///< of the nodes in it so far [m]
    CarrierRows     displaced;          ///< of the nodes at its start, where that counts [m]
    CarrierRows     undeformed;         ///< places of the same [m]
    PlacesNow       constrained_now;    ///< where they turn
    double          gone = 0;           ///< of it so far [s]
    CarrierRows     impulse_together, impulse_absorber; ///< on the nodes in it [N s]
    CarrierRows     impulse_double_counted; ///< of the first that part which takes off what bonds bear in elements
    Eigen::Vector3d turn_given = Eigen::Vector3d::Zero(); ///< to the particles in it [N m s]
    VolumeBalance   exchanged;
    std::size_t     shared_bonds = 0;

    // Looking at all bonds costs as much as many steps: once per particle step that requests it.
    mutable std::int64_t counted_at = -1;
    mutable std::size_t  damaged    = 0;
  };
} // namespace coupling
