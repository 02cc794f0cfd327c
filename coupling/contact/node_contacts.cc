#include "coupling/contact/node_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coupling
{
  using Eigen::Vector3d;

  NodeContacts::NodeContacts(Participant &round, const std::vector<Round> &of, Participant &others, const double radius)
    : rounds(round)
    , nodes(others)
    , sizes(of)
    , node_radius(radius)
    , lightest(std::numeric_limits<double>::infinity())
  {
    for (std::size_t i = 0; i < nodes.carriers(); ++i)
      lightest = std::min(lightest, nodes.mass(i));
    find();
  }

  void NodeContacts::find()
  {
    touched.clear();
    for (std::size_t r = 0; r < sizes.size(); ++r)
      {
        const Vector3d centre = rounds.position(r);
        const double   reach  = sizes[r].radius + node_radius;
        double         count  = 0;
        for (std::size_t i = 0; i < nodes.carriers(); ++i)
          {
            const Vector3d away    = nodes.position(i) - centre;
            const double   squares = away.squaredNorm();
            if (squares >= reach * reach)
              continue;
            const double distance = std::sqrt(squares), overlap = reach - distance;
            // At the centre itself there is no direction, and nothing that has come there by steps of a spring.
            touched.push_back(
              {r, i, overlap,
               distance > 0 ? Vector3d(sizes[r].stiffness * overlap / distance * away) : Vector3d(Vector3d::Zero())});
            ++count;
          }
        heaviest_push = std::max(heaviest_push, count / rounds.mass(r));
      }
    found = true;
  }

  void NodeContacts::push()
  {
    if (!found)
      find();
    for (const Touch &touch : touched)
      {
        nodes.add_force(touch.node, touch.force);
        rounds.add_force(touch.round, -touch.force);
      }
    found = false;
  }

  double NodeContacts::power() const
  {
    double sum = 0;
    for (const Touch &touch : touched)
      sum += touch.force.dot(nodes.velocity(touch.node) - rounds.velocity(touch.round));
    return sum;
  }

  void NodeContacts::account(const double window)
  {
    // With the velocities between the two times: half by the forces of the first, half by those of the second.
    done += 0.5 * window * power();
    find();
    done += 0.5 * window * power();
  }

  Vector3d NodeContacts::force_on_nodes() const
  {
    Vector3d sum = Vector3d::Zero();
    for (const Touch &touch : touched)
      sum += touch.force;
    return sum;
  }

  double NodeContacts::stored() const
  {
    double sum = 0;
    for (const Touch &touch : touched)
      sum += 0.5 * sizes[touch.round].stiffness * touch.overlap * touch.overlap;
    return sum;
  }

  double NodeContacts::stable_step(const double own) const
  {
    double stiffest = 0;
    for (const Round &round : sizes)
      stiffest = std::max(stiffest, round.stiffness);
    // Gershgorin: a row of a node has its own spring twice, one of a round carrier those of all its nodes.
    const double squared = 2 * stiffest * std::max(1 / lightest, heaviest_push);
    return 2 / std::sqrt(4 / (own * own) + squared);
  }
} // namespace coupling
