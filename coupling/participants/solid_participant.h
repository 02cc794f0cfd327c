#pragma once

#include "coupling/participants/participant.h"
#include "fem/explicit/explicit_solver.h"

#include <optional>

namespace coupling
{
  /**
   * A solid in explicit motion as a participant; carriers are its nodes, ascending by their first displacement's number. In the plane
   * z is zero and stays so. All of the solid is on one rank.
   */
  template <int dim>
  class SolidParticipant : public Participant
  {
  public:
    /** @param solid, motion must outlive the participant @throws base::InputError for a solid spread over several ranks */
    SolidParticipant(fem::Solid<dim> &solid, fem::ExplicitSolver<dim> &motion);

    std::size_t       carriers() const override;
    Eigen::Vector3d   position(std::size_t carrier) const override;
    Eigen::Vector3d   velocity(std::size_t carrier) const override;
    double            mass(std::size_t carrier) const override;
    double            time() const override;
    double            stable_step() const override;
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

    /** The node of a first displacement. @pre it is one */
    std::size_t carrier_of(dealii::types::global_dof_index first) const;
    /** Undeformed [m]. */
    const Eigen::Vector3d &place(std::size_t carrier) const { return nodes.at(carrier).place; }
    /** The displacements of a node, by component. */
    const std::array<dealii::types::global_dof_index, dim> &displacements(std::size_t carrier) const;

  private:
    struct Node
    {
      std::array<dealii::types::global_dof_index, dim> dofs;
      Eigen::Vector3d                                  place; ///< undeformed [m]
    };
    struct Group
    {
      std::vector<std::size_t> carriers;
      std::array<bool, 3>      along;
    };
    struct Saved
    {
      fem::ExplicitState motion;
      base::Column       points; ///< Solid::saved_points()
    };

    Eigen::Vector3d value(const fem::Vector &field, std::size_t carrier) const;

    fem::Solid<dim>          &solid;
    fem::ExplicitSolver<dim> &motion;
    std::vector<Node>         nodes;
    std::vector<Group>        groups;
    std::optional<Saved>      saved;
  };
} // namespace coupling
