#pragma once

#include "coupling/contact/bodies/body_contacts.h"
#include "coupling/contact/body_layers.h"

namespace coupling
{
  /** Bodies of a solid that touch each other. */
  struct ContactCouplingParameters
  {
    std::string                   name;   ///< for messages
    std::vector<std::string>      bodies; ///< by their materials; empty: all
    bodies::BodyContactParameters contact;
  };

  /** What the contacts of bodies have done so far. */
  struct ContactBalance
  {
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero(); ///< given to all together, zero but for rounding [N s]
    Eigen::Vector3d turn     = Eigen::Vector3d::Zero(); ///< angular momentum about the origin, the same [N m s]
    double          work     = 0;                       ///< on the bodies [J]
    bodies::BodyContactEnergy energy;

    /** By the contacts themselves: by steps in time, and what the form of the force does not keep [J]. */
    double spurious() const { return work + energy.normal + energy.shear + energy.dissipated; }
  };

  /**
   * Contact between the bodies of one solid (doc/theory/body-contact.md): the discrete side finds overlaps and forces, the nodes feel
   * them by the weights by which they move the vertices.
   */
  template <int dim>
  class ContactCoupling
  {
  public:
    /**
     * All must outlive the coupling. @throws base::InputError as body_layers(), base::InputError as bodies::BodyContacts, and for bodies that lie in each
     * other at the start */
    ContactCoupling(const fem::Solid<dim>           &solid,
                    SolidParticipant<dim>           &participant,
                    const ContactCouplingParameters &parameters);

    /** Bound of what the contacts add now to the squares of the solid's frequencies [1/s^2]. */
    double added_eigenvalue() const;

    /** The bodies are where the nodes are: find the forces there, and what they have worked on the way. @throws base::NumericalError */
    void kinematics_to_dem();
    /** Push the nodes in the solid's next step. @param kick time that forces push for in it [s] */
    void forces_to_fem(double kick);

    const ContactBalance       &balance() const { return account; }
    const bodies::BodyContacts &contacts() const { return bodies; }
    const std::string          &name() const { return own_name; }

    /** A reader must have the same solid. */
    void visit_state(base::StateVisitor &visitor);

  private:
    ContactCoupling(BodyLayers                     &&layers,
                    SolidParticipant<dim>           &participant,
                    const ContactCouplingParameters &parameters);

    void refuse_overlap();
    void gather(const std::vector<Eigen::Vector3d> &of_vertices);

    SolidParticipant<dim>                &participant;
    std::string                           own_name;
    std::vector<std::size_t>              carriers; ///< nodes of the layers, ascending
    std::vector<std::vector<std::size_t>> parents;  ///< of each vertex, in the list of carriers: it is their mean
    bodies::BodyContacts                  bodies;
    std::vector<Eigen::Vector3d>          vertex_place;
    std::vector<Eigen::Vector3d>          place, force; ///< of the carriers [m], [N]
    ContactBalance                        account;
  };
} // namespace coupling
