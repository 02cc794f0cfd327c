#pragma once

#include "base/state.h"
#include "dem/kernels/particle_pass.h"
#include "dem/model/particles.h"
#include "dem/model/rigid_clump.h"

#include <Eigen/Geometry>

#include <array>
#include <functional>
#include <vector>

namespace dem
{
  /**
   * The rigid clumps of a specimen (doc/theory/clumps.md). Their pebbles have no mass of their own: the particle pass sums up what acts on
   * them and moves them on as before, and the clumps then say where they really go.
   */
  class Clumps
  {
  public:
    /** @param planar motion in the plane z = 0 @param members its pebbles in the particles' order @param mass_shares of these, sum 1 */
    void add(const RigidClump                &clump,
             const std::vector<std::int32_t> &members,
             const std::vector<double>       &mass_shares,
             const Particles                 &particles,
             bool                             planar);

    bool        empty() const { return bodies.empty(); }
    std::size_t size() const { return bodies.size(); }
    /** Of all clumps, in the particles' order. */
    const std::vector<std::int32_t> &pebbles() const { return all_pebbles; }
    ClumpState                       state(std::size_t clump) const;
    /** Mass that a pebble stands for [kg]. @pre it is one */
    double mass_of_pebble(const Particles &particles, std::size_t pebble) const;

    /**
     * Velocities of a clump before the first step: the rigid motion nearest to its pebbles', by their masses (doc/theory/clumps.md, 1).
     * @param given which components of each particle are prescribed; empty: all
     */
    void
    take_velocities(const Particles &particles, std::size_t clump, const std::vector<std::array<bool, 6>> &given = {});
    /** Pebbles move as their clumps do, or as one of these does. */
    void drive(Particles &particles) const;
    void drive(Particles &particles, std::size_t clump) const;

    /**
     * Take the step that the pass has just taken with the pebbles.
     * @param accounts of blocks of particles, theirs the last: damping, kinetic energy, what pushing works on their true motion, and the largest
     * displacement are added there
     */
    void move(Particles                         &particles,
              const StepHalves                  &halves,
              double                             damping,
              const Eigen::Vector3d             &gravity,
              std::vector<ParticleBlockAccount> &accounts);

    /** [J] */
    double kinetic_of_velocities() const;
    double weight_work(const Eigen::Vector3d &gravity) const;     ///< of the weight since the start, at t_n [J]
    double power_of_weight(const Eigen::Vector3d &gravity) const; ///< [W]

    /**
     * Stable step of a clump [s]: as that of one particle, where a contact at a distance d has (1 + m d^2/I) of its stiffness.
     * @param stiffness of what acts on a particle [N/m]
     */
    double stable_step(const Particles                           &particles,
                       std::size_t                                clump,
                       const std::function<double(std::int32_t)> &stiffness) const;

    void visit_state(base::StateVisitor &visitor);

  private:
    struct Body
    {
      std::vector<std::int32_t>    members;
      std::vector<Eigen::Vector3d> arms;   ///< of the pebbles, at the start [m]
      std::vector<double>          shares; ///< of the mass, for queries of a pebble's weight
      bool                         planar = false;
      double                       mass   = 0;
      Eigen::Vector3d              start  = Eigen::Vector3d::Zero(); ///< of the centre [m]
      Eigen::Matrix3d    inertia, inverse_inertia; ///< at the start; a clump of the plane has no inverse but for z
      Eigen::Vector3d    travelled   = Eigen::Vector3d::Zero(); ///< of the centre, at the start of the step to come [m]
      Eigen::Vector3d    last_travel = Eigen::Vector3d::Zero(); ///< in the last step [m]
      Eigen::Quaterniond turn        = Eigen::Quaterniond::Identity(); ///< likewise
      Eigen::Vector3d    velocity    = Eigen::Vector3d::Zero();        ///< half a step back [m/s]
      Eigen::Vector3d    spin        = Eigen::Vector3d::Zero();        ///< likewise [rad/s]
      Eigen::Vector3d    angular_momentum = Eigen::Vector3d::Zero();   ///< about the centre, likewise

      Eigen::Vector3d arm(std::size_t member) const { return turn * arms[member]; }
      /** Of a pebble about its own centre: inertia over mass [m^2]. */
      double          own_gyration(const Particles &particles, std::size_t member) const;
      Eigen::Vector3d spin_of(const Eigen::Quaterniond &turned, const Eigen::Vector3d &momentum) const;
      /** Turn on for a time [s] with the angular momentum as it is. */
      void turn_on(double time);
    };

    static void
    sum_forces(const Body &body, const Particles &particles, Eigen::Vector3d &force, Eigen::Vector3d &couple);

    std::vector<Body>         bodies;
    std::vector<std::int32_t> all_pebbles;
  };
} // namespace dem
