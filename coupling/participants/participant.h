#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace coupling
{
  /** What holds a group of carriers where it is prescribed to be. */
  struct Reaction
  {
    Eigen::Vector3d force  = Eigen::Vector3d::Zero(); ///< [N]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero(); ///< about the given point [N m]
  };

  /** The energy account of a participant, in the terms that both sides have [J]. */
  struct ParticipantEnergy
  {
    double put_in = 0; ///< at the start, and by weight
    double external_work =
      0; ///< by forces, impulses and prescribed motion from outside, and by the participant's own loads
    double kinetic       = 0;
    double internal      = 0; ///< stored and dissipated
    double balance_error = 0; ///< what is missing or too much, over the largest of them [-]
  };

  /** Of all carriers together. */
  struct Momentum
  {
    Eigen::Vector3d linear  = Eigen::Vector3d::Zero(); ///< [N s]
    Eigen::Vector3d angular = Eigen::Vector3d::Zero(); ///< about the origin [N m s]
  };

  /**
   * One side of a coupling: a body of carriers (particles, or nodes of a mesh) that moves in time by explicit steps, and that others
   * push, hold and read. An adapter needs nothing more of either side, and sub-cycling and iteration need no more than
   * save() and restore().
   *
   * Reading never changes a participant. Whatever is done to it from outside stands in its energy account.
   */
  class Participant
  {
  public:
    virtual ~Participant() = default;

    virtual std::size_t       carriers() const                    = 0;
    virtual Eigen::Vector3d   position(std::size_t carrier) const = 0; ///< now [m]
    virtual Eigen::Vector3d   velocity(std::size_t carrier) const = 0; ///< half a step back [m/s]
    virtual double            mass(std::size_t carrier) const     = 0; ///< [kg]
    virtual double            time() const                        = 0; ///< [s]
    virtual double            stable_step() const                 = 0; ///< longest step that advance() takes now [s]
    virtual ParticipantEnergy energy() const                      = 0;

    /**
     * Move on by a window of time in equal steps of the participant's own, more of them where the state needs shorter ones on the
     * way. @param window [s], > 0 @param steps at least this many, > 0
     * @throws what the side throws when its state is no longer a number
     */
    virtual void advance(double window, int steps) = 0;

    /** Push a carrier during the whole of the next window [N]; several forces add up. */
    virtual void add_force(std::size_t carrier, const Eigen::Vector3d &force) = 0;

    /** Turn a carrier during the whole of the next window [N m]. @throws std::logic_error where carriers cannot turn: a node */
    virtual void add_couple(std::size_t carrier, const Eigen::Vector3d &couple) = 0;

    /** Change a carrier's velocity at once, where it is not prescribed [m/s]. */
    virtual void apply_impulse(std::size_t carrier, const Eigen::Vector3d &change) = 0;

    /** From now on these carriers move as prescribed along these axes, at first not at all. @return the group's number */
    virtual std::size_t prescribe(const std::vector<std::size_t> &carriers, const std::array<bool, 3> &along) = 0;

    /** Velocities of a group's carriers, in its order, until the next call [m/s]; what is not prescribed is ignored. */
    virtual void set_motion(std::size_t group, const std::vector<Eigen::Vector3d> &velocity) = 0;

    /**
     * What holds the group; inertia does not count. At the last state whose forces are known: the start of the last step for particles,
     * its end for a solid. @param about point of the moment [m]
     */
    virtual Reaction reaction(std::size_t group, const Eigen::Vector3d &about) const = 0;

    /** Keep the present state, histories included, in memory; one state at a time. */
    virtual void save() = 0;

    /** Back to the state that was kept, as often as wanted: the same steps give the same bits. @throws std::logic_error without one */
    virtual void restore() = 0;
  };

  /** Without spin: of carriers that are points. Central differences keep the sum of x(n) and m v(n-1/2). */
  Momentum momentum_of(const Participant &participant);
} // namespace coupling
