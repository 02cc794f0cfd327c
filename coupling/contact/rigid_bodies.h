#pragma once

#include "base/state.h"
#include "coupling/participants/solid_participant.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace coupling
{
  /**
   * Parts of a solid that move as rigid bodies (doc/theory/body-contact.md, 5): their nodes are prescribed to go where the resultant of all
   * forces on them takes the body, by leap-frog for centre and angular momentum. Mass and inertia are those of the nodes.
   */
  template <int dim>
  class RigidBodies
  {
  public:
    /**
     * Before the first step. @param materials of the bodies; each connected part is one. Both others must outlive it.
     * @throws base::InputError for a material that is not there, or that shares nodes with another
     */
    RigidBodies(const fem::Solid<dim>          &solid,
                fem::ExplicitSolver<dim>       &motion,
                SolidParticipant<dim>          &participant,
                const std::vector<std::string> &materials);

    bool empty() const { return bodies.empty(); }

    /** What the solver's next step does with them, once all forces for it are there. @param kick time that forces push for in it [s] */
    void drive(double kick, double step);

    /** A reader must have the same solid. */
    void visit_state(base::StateVisitor &visitor);

  private:
    struct Body
    {
      std::vector<std::size_t>     carriers;
      std::size_t                  group = 0;                       ///< of the participant's
      std::vector<Eigen::Vector3d> arm;                             ///< from the centre, unturned [m]
      Eigen::Matrix3d              inertia;                         ///< about the centre, unturned [kg m^2]
      double                       mass = 0;                        ///< [kg]
      Eigen::Vector3d              centre, velocity, spin_momentum; ///< [m], half a step back [m/s], [N m s]
      Eigen::Quaterniond           turn = Eigen::Quaterniond::Identity();
    };

    void begin(Body &body) const;
    void move(Body &body, double kick, double step);

    fem::ExplicitSolver<dim> &motion;
    SolidParticipant<dim>    &participant;
    std::vector<Body>         bodies;
  };
} // namespace coupling
