#pragma once

#include "coupling/participants/participant.h"
#include "dem/peridynamics/motion.h"

#include <optional>

namespace coupling
{
  /** A peridynamic body in explicit motion as a participant; carriers are the nodes of its grid, in their order. */
  class PeridynamicParticipant : public Participant
  {
  public:
    struct Setup
    {
      dem::peridynamics::Kinematics kinematics  = dem::peridynamics::Kinematics::nonlinear;
      double                        step_factor = 0.8; ///< of the stable step
      double                        repulsion   = 0;   ///< dem::peridynamics::Repulsion, in bond constants; 0: none
    };

    /**
     * @param bonds must outlive the participant, stay where they are, and belong to it
     * @param loads of the body's own @param velocity at the start [m/s]
     */
    PeridynamicParticipant(dem::peridynamics::Bonds       &bonds,
                           const dem::peridynamics::Loads &loads,
                           const Setup                    &setup,
                           const dem::peridynamics::Field &velocity);

    PeridynamicParticipant(const PeridynamicParticipant &)            = delete; // loads refer to it
    PeridynamicParticipant &operator=(const PeridynamicParticipant &) = delete;

    std::size_t       carriers() const override;
    Eigen::Vector3d   position(std::size_t carrier) const override;
    Eigen::Vector3d   velocity(std::size_t carrier) const override;
    double            mass(std::size_t carrier) const override;
    double            time() const override;
    double            stable_step() const override { return longest_step; } ///< of the undamaged body
    ParticipantEnergy energy() const override;

    void        advance(double window, int steps) override;
    void        add_force(std::size_t carrier, const Eigen::Vector3d &force) override;
    void        add_couple(std::size_t carrier, const Eigen::Vector3d &couple) override;
    void        apply_impulse(std::size_t carrier, const Eigen::Vector3d &change) override;
    std::size_t prescribe(const std::vector<std::size_t> &carriers, const std::array<bool, 3> &along) override;
    void        set_motion(std::size_t group, const std::vector<Eigen::Vector3d> &velocity) override;
    Reaction    reaction(std::size_t group, const Eigen::Vector3d &about) const override;
    void        save() override;
    void        restore() override;

    /** After the forces of a next step of this length, if nothing more than now pushes [m/s]. */
    Eigen::Vector3d velocity_ahead(std::size_t carrier, double step);
    /** Whether its motion is prescribed along an axis. */
    bool is_held(std::size_t carrier, int axis) const;

    /** Sum of what moves the body where its own loads prescribe how [N]. */
    Eigen::Vector3d force_on_held() const;

    const dem::peridynamics::Motion &motion() const { return *moving; }
    const dem::peridynamics::Bonds  &bonds() const { return body; }

    void visit_state(base::StateVisitor &visitor);

  private:
    struct Group
    {
      std::vector<std::size_t>     carriers;
      std::array<bool, 3>          along;
      std::vector<Eigen::Vector3d> velocity; ///< [m/s]
    };
    struct Saved
    {
      dem::peridynamics::Motion motion;
      base::Column              stiffness;
      dem::peridynamics::Field  pushed;
      std::vector<Group>        groups;
      dem::peridynamics::Held   held;
    };

    std::size_t place(const std::size_t carrier) const { return body.grid().nodes().at(carrier); }
    void        drive(double at, dem::peridynamics::Field &u) const;
    /** Let the motion know what comes from outside, for a next step of this length [s]. */
    void update_loads(double step);

    dem::peridynamics::Bonds     &body;
    dem::peridynamics::Kinematics kinematics;
    dem::peridynamics::Loads      own, all; ///< of the body, and with what comes from outside
    double                        longest_step;
    dem::peridynamics::Field      pushed; ///< from outside in the window [N]
    std::vector<Group>            groups;
    bool                          stale = true; ///< something has come from outside that the motion does not know
    std::optional<dem::peridynamics::Motion> moving;
    std::optional<Saved>                     saved;
  };
} // namespace coupling
