#pragma once

#include "base/column.h"
#include "base/state.h"
#include "dem/kernels/particle_pass.h"
#include "dem/model/particles.h"
#include "dem/specimen/energy_book.h"
#include "dem/specimen/grip.h"
#include "dem/specimen/turning_face.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace dem
{
  /**
   * The particles of a specimen whose motion is prescribed: by grips, each with a rate for all of its members or one for each of them; and
   * those left to a partner, which corrects their motion in every step. Forces and moments are those of the last force evaluation.
   */
  class HeldParticles
  {
  public:
    /**
     * Hold a group from now on; its rates come with set_rates().
     * @param slot place of each packing number among the particles @return the grip's number, from 0
     * @throws base::InputError where it has a face that turns, and its particles lie on a line
     */
    std::size_t add(const Grip &grip, const std::vector<std::int32_t> &slot, Particles &particles, int dimension);
    /** The members of a grip take corrections of a step from now on. */
    void leave_to_partner(std::size_t grip, std::size_t particles);

    std::size_t size() const { return grips.size(); }
    /** Of all grips, in the particles' order, each once. */
    const std::vector<std::int32_t> &members() const { return all_members; }
    const Grip                      &grip(const std::size_t number) const { return grips.at(number).grip; }

    /**
     * Rates of all members alike, from now on [m/s, rad/s].
     * @param work takes up what the sudden change gives: an impulse; nullptr before the first step, where it is initial energy [J]
     */
    void set_rates(std::size_t            grip,
                   const Eigen::Vector3d &velocity,
                   const Eigen::Vector3d &spin,
                   Particles             &particles,
                   EnergyFlow            *work);
    /**
     * Rates of each member on its own, in the order of Grip::particles.
     * @throws base::InputError for another number of them, or where the grip's face turns by itself
     */
    void set_own_rates(std::size_t                         grip,
                       const std::vector<Eigen::Vector3d> &velocity,
                       const std::vector<Eigen::Vector3d> &spin,
                       Particles                          &particles,
                       EnergyFlow                         *work);
    /**
     * Another rate of one component of a particle that was left to a partner.
     * @return kinetic energy that this gives [J]; none where no grip prescribes the component
     */
    std::optional<double>
    correct_rate(const Particles &particles, std::size_t particle, std::size_t component, double before, double now);

    /** Members of grips whose faces turn, in the particles' order. */
    const std::vector<std::int32_t> &turning_members() const { return all_turning; }
    /** Turn faces faster by the forces on members at t_n, for a time [s]. @return six rates that each turning member has from now on */
    std::vector<std::pair<std::size_t, std::array<double, 6>>> push_faces(const Particles &particles, double time);

    /** Sum up what links and weight do to each grip's members. */
    void sum_forces(const Particles &particles);
    /** Work of all grips in the half steps before and after t_n. */
    void add_work(const Particles &particles, const StepHalves &halves, EnergyFlow &work);

    Eigen::Vector3d reaction(std::size_t grip) const; ///< force of the grip on its members [N]
    Eigen::Vector3d
    reaction_moment(std::size_t grip) const; ///< sum of the moments about the members' own centres [N m]
    /** Moment of all that the grip exerts in prescribed directions, about a point [m], [N m]. */
    Eigen::Vector3d reaction_moment(const Particles &particles, std::size_t grip, const Eigen::Vector3d &about) const;

    void visit_state(base::StateVisitor &visitor);

  private:
    struct HeldGrip
    {
      Grip                      grip;
      std::vector<std::int32_t> members; ///< in the particles' order
      std::vector<std::size_t>  given;   ///< which of grip.particles each member is
      std::array<double, 6>     pull =
        {};                   ///< sum of the links' (and weight's) force and moment over the members, at t_n [N, N m]
      base::Column own_rates; ///< 6 of each member, where members move each on its own; empty: all alike
      double       own_power = 0; ///< that the grip puts in at these rates and the forces at t_n [W]
      base::Column lost_velocity; ///< of each member, 6 components: what new rates took away since the last step
      bool         may_have_lost = false; ///< otherwise these are all zero
      std::optional<TurningFace> face;

      double rate(std::size_t member, int component) const;
      /** Of a member of a face that turns: six rates with its turn. */
      std::array<double, 6> turning_rates(std::size_t member) const;
      double                power() const; ///< that the grip puts into the specimen [W]
      void                  lose(std::size_t member, std::size_t component, double velocity);
      /** In the half step before t_n, as members had other velocities before their rates changed; nothing is lost any more [W]. */
      double take_lost_power(const Particles &particles);
    };

    static void set_rate(HeldGrip &held, std::size_t member, int component, Particles &particles, EnergyFlow *work);

    std::vector<HeldGrip>     grips;
    std::vector<std::int32_t> all_members, all_turning;
    std::vector<std::pair<std::int32_t, std::size_t>>
      left; ///< of each particle the grip and its member that a partner moves; -1: none does; empty: none was left
  };
} // namespace dem
