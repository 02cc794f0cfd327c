#include "coupling/contact/contact_coupling.h"

#include "base/errors.h"
#include "base/state_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <sstream>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    std::vector<std::size_t> all_parents(const BodyLayers &layers)
    {
      std::set<std::size_t> nodes;
      for (const auto &parents : layers.parents)
        nodes.insert(parents.begin(), parents.end());
      return {nodes.begin(), nodes.end()};
    }
  } // namespace

  template <int dim>
  ContactCoupling<dim>::ContactCoupling(const fem::Solid<dim>           &solid,
                                        SolidParticipant<dim>           &participant_,
                                        const ContactCouplingParameters &parameters)
    : ContactCoupling(body_layers(solid, participant_, parameters.bodies), participant_, parameters)
  {
  }

  template <int dim>
  ContactCoupling<dim>::ContactCoupling(BodyLayers                     &&layers,
                                        SolidParticipant<dim>           &participant_,
                                        const ContactCouplingParameters &parameters)
    : participant(participant_)
    , own_name(parameters.name)
    , carriers(all_parents(layers))
    , parents(std::move(layers.parents))
    , bodies(std::move(layers.mesh), parameters.contact)
    , vertex_place(bodies.mesh().place)
    , force(carriers.size(), Vector3d::Zero())
  {
    for (auto &nodes : parents)
      for (std::size_t &node : nodes)
        node = static_cast<std::size_t>(std::lower_bound(carriers.begin(), carriers.end(), node) - carriers.begin());
    for (const std::size_t carrier : carriers)
      place.push_back(participant.position(carrier));
    refuse_overlap();
  }

  template <int dim>
  void ContactCoupling<dim>::refuse_overlap()
  {
    constexpr double rounding = 1e-9; // of places, in parts of the bodies
    kinematics_to_dem();
    double volume = 0;
    for (const bodies::BodySimplex &simplex : bodies.mesh().simplices)
      volume += bodies.mesh().thickness * bodies.mesh().at(simplex).volume();
    if (bodies.overlap() > rounding * volume)
      {
        std::ostringstream text;
        text << "at the start bodies lie in each other with " << bodies.overlap() << " m^3. Move them apart.";
        throw base::InputError(text.str());
      }
  }

  template <int dim>
  double ContactCoupling<dim>::added_eigenvalue() const
  {
    std::vector<double> stiffness(carriers.size(), 0.0);
    for (std::size_t v = 0; v < parents.size(); ++v)
      for (const std::size_t c : parents[v])
        stiffness[c] += bodies.stiffness()[v] / static_cast<double>(parents[v].size());
    double most = 0;
    for (std::size_t c = 0; c < carriers.size(); ++c)
      most = std::max(most, stiffness[c] / participant.mass(carriers[c]));
    return most;
  }

  template <int dim>
  void ContactCoupling<dim>::kinematics_to_dem()
  {
    std::vector<Vector3d> moved(carriers.size());
    for (std::size_t c = 0; c < carriers.size(); ++c)
      {
        const Vector3d now = participant.position(carriers[c]);
        moved[c]           = now - place[c];
        place[c]           = now;
        account.work += 0.5 * force[c].dot(moved[c]);
      }
    for (std::size_t v = 0; v < vertex_place.size(); ++v)
      {
        vertex_place[v].setZero();
        for (const std::size_t c : parents[v])
          vertex_place[v] += place[c];
        vertex_place[v] /= static_cast<double>(parents[v].size());
      }
    bodies.move_to(vertex_place);
    gather(bodies.force());
    for (std::size_t c = 0; c < carriers.size(); ++c)
      account.work += 0.5 * force[c].dot(moved[c]);
    account.energy = bodies.energy();
  }

  template <int dim>
  void ContactCoupling<dim>::gather(const std::vector<Vector3d> &of_vertices)
  {
    std::fill(force.begin(), force.end(), Vector3d::Zero());
    for (std::size_t v = 0; v < of_vertices.size(); ++v)
      if (!of_vertices[v].isZero(0))
        for (const std::size_t c : parents[v])
          force[c] += of_vertices[v] / static_cast<double>(parents[v].size());
  }

  template <int dim>
  void ContactCoupling<dim>::forces_to_fem(const double kick)
  {
    for (std::size_t c = 0; c < carriers.size(); ++c)
      {
        if (force[c].isZero(0))
          continue;
        participant.add_force(carriers[c], force[c]);
        account.momentum += kick * force[c];
        account.turn += kick * place[c].cross(force[c]);
      }
  }

  namespace
  {
    void visit(base::StateVisitor &visitor, const std::string &name, Vector3d &value)
    {
      for (int d = 0; d < 3; ++d)
        visitor.scalar(name + "_" + "xyz"[d], value[d]);
    }
  } // namespace

  template <int dim>
  void ContactCoupling<dim>::visit_state(base::StateVisitor &visitor)
  {
    const std::string group = "contact_" + own_name + "_";
    visit(visitor, group + "momentum", account.momentum);
    visit(visitor, group + "turn", account.turn);
    visitor.scalar(group + "work", account.work);
    base::visit_vectors(visitor, group + "node_place", place);
    base::visit_vectors(visitor, group + "node_force", force);
    bodies.visit_state(visitor, group);
    account.energy = bodies.energy();
  }

  template class ContactCoupling<2>;
  template class ContactCoupling<3>;
} // namespace coupling
