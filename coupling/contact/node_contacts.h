#pragma once

#include "base/state.h"
#include "coupling/participants/participant.h"

#include <vector>

namespace coupling
{
  /**
   * Round carriers of one participant that push the nodes of another: a node that lies within radius and node radius of a centre is pushed
   * away from it by a spring, without friction, and pushes back (doc/theory/peridynamics.md, 8). Momentum is kept to rounding; what the
   * springs make of energy falls with the square of the step.
   *
   * In every step: push(), both participants advance by it, then account().
   */
  class NodeContacts
  {
  public:
    struct Round
    {
      double radius    = 0; ///< [m], > 0
      double stiffness = 0; ///< of the spring of each node [N/m], > 0
    };

    /** @param round, nodes must outlive it @param of the carriers of `round`, in their order @param node_radius [m], >= 0 */
    NodeContacts(Participant &round, const std::vector<Round> &of, Participant &nodes, double node_radius);

    /** Push both during their next window. */
    void push();
    /** What has been done in the window that has passed, of this length [s]. */
    void account(double window);

    bool            touching() const { return !touched.empty(); } ///< at the last push() or account()
    Eigen::Vector3d force_on_nodes() const;                       ///< likewise [N]
    double          stored() const;                               ///< in the springs, likewise [J]
    double          spurious() const
    {
      return done + stored();
    } ///< work on both sides and what is stored: rounding and steps [J]

    /** Longest step of both with the springs between them [s]. @param own without them */
    double stable_step(double own) const;

    void visit_state(base::StateVisitor &visitor)
    {
      visitor.scalar("work", done);
      visitor.scalar("heaviest_push", heaviest_push);
      found = false;
    }

  private:
    struct Touch
    {
      std::size_t     round, node;
      double          overlap; ///< [m]
      Eigen::Vector3d force;   ///< on the node [N]
    };

    void find();
    /** Power of the springs on both sides, with the velocities that there are [W]. */
    double power() const;

    Participant       &rounds, &nodes;
    std::vector<Round> sizes;
    double             node_radius;
    double lightest, heaviest_push = 0; ///< smallest mass of a node [kg]; largest N/M so far of a round carrier [1/kg]
    bool   found = false;               ///< touched is of where both are now
    std::vector<Touch> touched;
    double             done = 0; ///< on both sides [J]
  };
} // namespace coupling
