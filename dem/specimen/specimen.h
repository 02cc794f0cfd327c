#pragma once

#include "base/column.h"
#include "base/mandel.h"
#include "base/state.h"
#include "dem/model/break_log.h"
#include "dem/model/energy.h"
#include "dem/model/initial_equilibrium.h"
#include "dem/model/materials.h"
#include "dem/model/packing.h"
#include "dem/model/physics.h"
#include "dem/model/rigid_clump.h"
#include "dem/specimen/results.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace dem
{
  struct ElasticNetwork;
  struct ForceServo;
  struct Surface;
  struct SurfaceParameters;

  /** How the specimen is made from a packing and integrated in time. */
  struct SpecimenParameters
  {
    Physics         physics;
    double          density           = 0; ///< of the particles, not bulk [kg/m^3], > 0
    double          interaction_ratio = 0; ///< iota: cohesive links where distance < iota (r_J + r_K), >= 1
    double          installation_gap  = 0; ///< the same where the gap is below this, besides [m], >= 0
    double          thickness         = 0; ///< [m], of the discs; two dimensions only
    std::size_t     loose       = 0;   ///< how many of the packing's last particles are linked to nothing: projectiles
    double          step_factor = 0.8; ///< time step over the stable estimate (5.1), in (0, 1)
    double          damping     = 0;   ///< local (Cundall) damping D in [0, 1)
    Eigen::Vector3d gravity     = {0, 0, 0}; ///< acceleration of what falls [m/s^2]; not in a periodic cell
  };

  /** A group of particles with prescribed motion (a grip). */
  struct Grip
  {
    std::vector<std::size_t> particles;              ///< by their number in the packing, from 0
    std::array<bool, 6>      prescribed = {};        ///< x, y, z, rotation about x, y, z
    Eigen::Vector3d          velocity   = {0, 0, 0}; ///< [m/s], of the prescribed translations
    Eigen::Vector3d          spin       = {0, 0, 0}; ///< [rad/s], of the prescribed rotations
  };

  /**
   * Particles in a step that is not over: by themselves they have moved on, and others may still correct that, as if impulses had acted on
   * them at t_n. Six numbers of each: along x, y, z and about them.
   */
  struct StepCorrection
  {
    double                          half_before = 0, half_after = 0; ///< of the steps that meet at t_n [s]
    const std::vector<std::size_t> &particles;                       ///< by their number in the packing
    /** Six numbers of one of these, by its place among them: of links, contacts, weight and push at t_n [N, N m]. */
    std::function<const double *(std::size_t)> force;
    const base::Column                        &before; ///< velocities half a step before t_n [m/s, rad/s]
    base::Column
      &velocity; ///< half a step after: what is changed here is corrected, and moves the particle with it [m/s, rad/s]
  };

  /**
 * A bonded-particle specimen: particles, cohesive links and contacts, advanced in time by leap-frog steps.
 *
 * Results are the same to the last bit for any number of OpenMP threads. A copy is whole: it goes on to the same bits, and neither
 * knows of the other; going back to an earlier state is to take a copy back.
 */
  class Specimen
  {
  public:
    /**
   * Link the packing and set it at rest. Links take the constants of the pair of materials that they join.
   * @param materials numbered as the packing does; where it does not say, all particles are of the first
   * @throws base::InputError when nothing can be made of it: see check_packing(); when no two particles are near enough to be linked;
   *         when it is to be periodic and the packing is not; or when it has a material that is not among those given.
   */
    Specimen(const Packing &packing, const SpecimenParameters &parameters, const LinkMaterials &materials);
    ~Specimen();
    Specimen(Specimen &&) noexcept;
    Specimen &operator=(Specimen &&) noexcept;
    Specimen(const Specimen &);
    Specimen &operator=(const Specimen &);

    /** Take the given number of steps. @throws base::NumericalError when the state is no longer a number. */
    void advance(std::int64_t steps);
    /** The same, asking after each step whether to go on. */
    void advance(std::int64_t steps, const std::function<bool()> &go_on);

    /**
   * Take a step that a caller corrects before it is complete: contacts, walls and the energy account use the corrected one only.
   * The work of a correction is external work. Of a particle that was left to
   * another solver (leave()) a correction prescribes the motion. Corrections of degrees of freedom prescribed by a grip are ignored.
   * @param particles that may be corrected, by packing number @throws base::InputError in a periodic cell
   */
    void advance(const std::vector<std::size_t> &particles, const std::function<void(StepCorrection &)> &correct);

    const SpecimenParameters &parameters() const;

    std::int64_t steps() const;     ///< taken since the start
    double       time() const;      ///< [s]
    double       time_step() const; ///< [s], in use
    double
    longest_step() const; ///< that may be set: the step factor times the stable step of the stiffest state so far [s]
    /** Steps of this length from now on [s]; contacts that are born may shorten it. @throws base::InputError beyond longest_step() */
    void   set_time_step(double step);
    double stable_step() const;   ///< per-particle bound (5.1) of the present state [s]
    double critical_step() const; ///< sharp: 2/sqrt(largest eigenvalue) by Lanczos, of the undamaged elastic system [s]
    Counts counts() const;
    std::size_t bytes() const; ///< memory held by particles, links and contacts

    /**
   * Before the first step: leave a part of everything to somebody else who fills the same space; several calls multiply. Bonds keep, of
   * their area, the weight of their contact point.
   * @param of_bonds weight of a place [m], in (0, 1] @param of_masses weight of each particle's mass, by packing number, likewise
   * @throws base::InputError for another weight, once there was a step, and in a periodic cell
   */
    void share(const std::function<double(const Eigen::Vector3d &)> &of_bonds, const std::vector<double> &of_masses);
    /**
   * Before the first step: leave particles to somebody else who moves them and has their mass. Bonds between two of them go, unless they
   * are to stay, and with these contacts. They rest until a correction of a step says how they move (StepCorrection). @throws base::InputError once there was a step, and in a periodic cell
   */
    void leave(const std::vector<std::size_t> &particles, bool keep_bonds_between);

    /**
   * Before the first step: particles move as one rigid body from now on (doc/theory/clumps.md). Bonds and contacts between them go.
   * @return its number, from 0 @throws base::InputError for particles that are held, left to somebody else or of another clump, for a mass or
   * an inertia that is none, once there was a step, and in a periodic cell
   */
    std::size_t add_clump(const RigidClump &clump);
    std::size_t clumps() const;
    ClumpState  clump(std::size_t number) const;
    /** The clump that a particle is a pebble of; none: it moves on its own. @param particle by packing number */
    std::optional<std::size_t> clump_of(std::size_t particle) const;

    /** Prescribe motion of a group from now on. @return its number for reaction(). @throws base::InputError in a periodic cell */
    std::size_t add_grip(const Grip &grip);
    void        set_grip_velocity(std::size_t grip, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    /** The same for each of the grip's particles on its own, in the order of Grip::particles. @throws base::InputError for another number of them */
    void set_grip_velocities(std::size_t                         grip,
                             const std::vector<Eigen::Vector3d> &velocity,
                             const std::vector<Eigen::Vector3d> &spin);
    /** Force that the grip exerts on its particles, at t_n of the last step [N]. */
    Eigen::Vector3d reaction(std::size_t grip) const;
    /** Sum of the moments that the grip exerts on its particles about their own centres, likewise [N m]. */
    Eigen::Vector3d reaction_moment(std::size_t grip) const;
    /** Moment of all that the grip exerts on its particles in prescribed directions, about a point [m], likewise [N m]. */
    Eigen::Vector3d reaction_moment(std::size_t grip, const Eigen::Vector3d &about) const;

    /**
   * Push a particle from outside [N, N m], in every step until clear_forces(). Several add up; their work is external work. Not part of
   * the state that visit_state() shows. @throws base::InputError in a periodic cell
   */
    void add_force(std::size_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &couple);
    void clear_forces();

    /**
   * Change a particle's velocity at once, where it is not prescribed [m/s, rad/s]. The energy that this gives or takes is external work;
   * before the first step it is initial energy.
   */
    void apply_impulse(std::size_t particle, const Eigen::Vector3d &change, const Eigen::Vector3d &spin);

    /**
   * A surface that particles touch from now on: a wall, or the boundary of somebody else's body. It rests until it is led.
   * @return its number, from 0 @throws base::InputError for a facet that is none; in a periodic cell; and before the first step for
   * particles behind it or in it by more than half their radius
   */
    std::size_t add_surface(const SurfaceParameters &surface);
    /** Move it as a rigid body: velocity [m/s] and spin [rad/s] of the step to come. @param about where the axis passes now [m]; moves with it */
    void set_surface_motion(std::size_t            surface,
                            const Eigen::Vector3d &velocity,
                            const Eigen::Vector3d &spin  = {0, 0, 0},
                            const Eigen::Vector3d &about = {0, 0, 0});
    /** Hold it at a force from now on; call it again for another force. @throws base::InputError for a servo that is none */
    void hold_surface(std::size_t surface, const ForceServo &servo);
    /** Each vertex moves on its own [m/s] from the next step on. @throws base::InputError for another number of them, or for a plane */
    void set_vertex_velocities(std::size_t surface, const std::vector<Eigen::Vector3d> &velocity);
    /** Put the vertices to where their owner has them [m], to the last bit: no motion, only what rounding left between the two. */
    void place_vertices(std::size_t surface, const std::vector<Eigen::Vector3d> &place);
    /**
   * Find the forces of all surfaces where everything is now; the step to come takes these. For an owner of vertices who needs them before
   * he can say how his vertices move on: at t_n both sides then feel the same force, and move with it.
   */
    void find_surface_forces();
    /**
   * Let surfaces take several steps in one of the particles (doc/theory/surface-coupling.md, 2): these glide on with the velocities that
   * they have while surfaces move, and what contacts give to them on the way is summed up, which their own step, as long as all of that,
   * then takes as its mean. Between begin_glide() and finish_glide() comes, once or more, find_surface_forces() and glide().
   * @param step [s] @param kick time that forces push for in it [s]
   */
    void begin_glide();
    void glide(double step, double kick);
    void finish_glide();
    /**
   * Before the first step: what of particles reaches through a surface is cut off, so that they touch it where they are and nothing
   * pushes yet (smoothing of a specimen's ends). @throws base::InputError once there was a step, and for a surface whose contacts are
   * spread or of a skin
   */
    void cut_off_at(std::size_t surface);
    /** The surface as it is: its vertices, and the forces on it at t_n and all that it has taken. */
    const Surface           &surface(std::size_t number) const;
    std::size_t              surfaces() const;
    void                     clear_vertex_impulses(std::size_t surface); ///< Surface::impulse is zero again
    std::vector<WallContact> wall_contacts() const;
    /** How often facets near particles were searched, and how many pairs were tested for it, since the start. */
    std::array<std::int64_t, 2> surface_searches() const;

    /**
   * Deform the periodic cell, and the particles with it, at velocity gradient G [1/s] from the next step on.
   * @throws base::InputError without a periodic cell, or for a gradient that is not finite or leaves a plane specimen's plane
   */
    void      set_velocity_gradient(const Eigen::Matrix3d &gradient);
    CellState cell() const; ///< @throws base::InputError without a periodic cell

    /**
   * Stiffness of the cell if every particle followed its strain without turning, of the links as damaged as they are (secant; closed
   * links whole) [Pa]: engineering shears, order 11 22 33 23 31 12. An upper bound of the true one (doc/theory/homogenisation.md, 2).
   */
    base::Matrix6 affine_stiffness() const;
    /**
   * Mean size of the force on a particle over the mean sum of sizes of all single forces on it (weight too), at t_n: ratio_mean of codes.
   * Prescribed particles do not count; 1 where nothing acts on any.
   */
    double force_ratio() const;
    /** Mean |force on a particle| over mean |link or contact force| at t_n; how far from equilibrium. Prescribed particles do not count. */
    double unbalanced_ratio() const;

    /** Local damping from the next step on: little while waves matter, more to come to rest. @throws base::InputError outside [0, 1) */
    void set_damping(double damping);

    /**
   * Before the first step: move the particles to where links and weight are in equilibrium, grips held where they are. Found by the
   * static solver, and followed through the change of geometry with the links' own update until it holds for the very forces that the
   * first step will see. Loose particles stay as they are, and so do a few that no links hold (one in a hundred at most, named). Displacements count from the packing; what is stored becomes initial energy.
   * @throws base::InputError, naming particles, where there is no such equilibrium or not every link stays elastic in it
   */
    InitialEquilibrium find_equilibrium();

    /** Set velocities (by packing number) before the first step; they count as initial energy. In a periodic cell: about its motion. */
    void set_velocity(std::size_t particle, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    /**
   * The same for many at once, each of them once. A clump takes the rigid motion that is nearest to what is asked of its pebbles
   * (doc/theory/clumps.md, 1); those of which nothing is asked are to rest.
   */
    void set_velocities(const std::vector<AskedVelocity> &asked);

    EnergyAccount   energy() const;                     ///< at t_n of the last step
    double          kinetic_energy() const;             ///< of it; cheap: does not visit links [J]
    double          external_work() const;              ///< likewise: of grips, walls and pushes since the start [J]
    ParticleState   particle(std::size_t number) const; ///< by packing number
    double          stiffness_around(std::size_t particle) const; ///< of its links and contacts, as (5.1) has it [N/m]
    ElasticNetwork  network() const; ///< the bonds as they lie now, undamaged; particles by packing number
    Eigen::Vector3d displacement(std::size_t particle) const; ///< of a particle, by packing number, since the start [m]
    /** Of links, contacts and surfaces on a group, from all that is not of it, at t_n [N]. @param group packing numbers, ascending */
    Eigen::Vector3d force_on(const std::vector<std::size_t> &group) const;
    /** Broken links that have an end in a group. @param group packing numbers, ascending */
    std::size_t    broken_links_of(const std::vector<std::size_t> &group) const;
    double         mean_damage() const; ///< of the links made at the start, broken ones count as 1 [-]
    ParticleOutput particles() const;
    LinkOutput     links() const;
    std::size_t    logged_breaks() const; ///< bonds and elements of them that broke so far
    /** Those from a place in the log on; their ends are packing numbers. */
    std::vector<Break> breaks(std::size_t from = 0) const;

    /** Everything needed to go on to the same bits; a reader must be given a specimen made of the same packing and parameters. */
    void visit_state(base::StateVisitor &visitor);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> self;
  };
} // namespace dem
