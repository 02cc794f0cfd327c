#pragma once

#include "base/state.h"
#include "dem/model/initial_equilibrium.h"
#include "dem/model/materials.h"
#include "dem/model/packing.h"
#include "dem/ranks/ranks.h"
#include "dem/specimen/observation.h"
#include "dem/specimen/partners.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace dem
{
  /**
   * A bonded-particle specimen: particles, cohesive links and contacts, advanced in time by leap-frog steps. Its boundaries, its rigid
   * clumps and the door for other models are parts with headers of their own.
   *
   * Results are the same to the last bit for any number of OpenMP threads. A copy is whole: it goes on to the same bits, independent of the
   * original; to go back to an earlier state, take a copy back.
   */
  class Specimen : public ObservedSpecimen
  {
  public:
    /**
     * Link the packing and set it at rest. Links take the constants of the pair of materials that they join.
     * @param materials numbered as the packing does; where it does not say, all particles are of the first
     * @param found_by ranks that make the same specimen, and search for what is to be linked together; null: each by itself
     * @throws base::InputError for an unusable packing: see check_packing(); when no two particles are near enough to be linked;
     *         when it is to be periodic and the packing is not; or when it has a material that is not among those given.
     */
    Specimen(const Packing            &packing,
             const SpecimenParameters &parameters,
             const LinkMaterials      &materials,
             Ranks                    *found_by = nullptr);
    ~Specimen();
    Specimen(Specimen &&) noexcept;
    Specimen &operator=(Specimen &&) noexcept;
    Specimen(const Specimen &);
    Specimen &operator=(const Specimen &);

    /** Take the given number of steps. @throws base::NumericalError when the state is no longer a number. */
    void advance(std::int64_t steps);
    /** The same, as long as a condition that is tested after each step holds. */
    void advance(std::int64_t steps, const std::function<bool()> &go_on);

    using ObservedSpecimen::clumps;
    using ObservedSpecimen::grips;
    using ObservedSpecimen::surfaces;
    Grips       grips();
    Surfaces    surfaces();
    RigidClumps clumps();
    Partners    partners();

    /** Steps of this length from now on [s]; contacts that are born may shorten it. @throws base::InputError beyond longest_step() */
    void set_time_step(double step);
    /** Local damping from the next step on: little while waves matter, more to come to rest. @throws base::InputError outside [0, 1) */
    void set_damping(double damping);
    /**
     * Share the work of steps with other ranks, which have the same specimen and make the same calls from now on (doc/theory/ranks.md). What is
     * read of it then is gathered from all of them, so all must read it; readings that say they are cheap are not.
     * @param move_every steps after which other ranks get other parts, for tests; 0: never
     */
    void share_among(std::shared_ptr<Ranks> ranks, std::int64_t move_every = 0);
    /** Set velocities (by packing number) before the first step; they count as initial energy. In a periodic cell: about its motion. */
    void set_velocity(std::size_t particle, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    /**
     * The same for many at once, each of them once. A clump takes the rigid motion that is nearest to the velocities given for its pebbles
     * (doc/theory/clumps.md, 1); pebbles without one are to rest.
     */
    void set_velocities(const std::vector<PrescribedVelocity> &prescribed);
    /**
     * Deform the periodic cell, and the particles with it, at velocity gradient G [1/s] from the next step on.
     * @throws base::InputError without a periodic cell, or for a gradient that is not finite or leaves a plane specimen's plane
     */
    void set_velocity_gradient(const Eigen::Matrix3d &gradient);
    /**
     * Before the first step: move the particles to where links and weight are in equilibrium, grips held where they are. Found by the
     * static solver, and followed through the change of geometry with the links' own update until it holds for the very forces that the
     * first step will see. Loose particles stay as they are, and so do a few that no links hold (one in a hundred at most, named).
     * Displacements count from the packing; the stored energy becomes initial energy.
     * @throws base::InputError, naming particles, where there is no such equilibrium or not every link stays elastic in it
     */
    InitialEquilibrium find_equilibrium(const EquilibriumWatch &watch = {});

    /** Everything needed to go on to the same bits; a reader must be given a specimen made of the same packing and parameters. */
    void visit_state(base::StateVisitor &visitor);
  };
} // namespace dem
