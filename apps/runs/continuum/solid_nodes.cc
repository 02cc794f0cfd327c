#include "apps/runs/continuum/solid_nodes.h"

#include "coupling/participants/solid_participant.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    template <int dim>
    class NodesOfSolid : public SolidNodes
    {
    public:
      NodesOfSolid(const fem::Solid<dim>           &of,
                   const fem::ExplicitSolver<dim>  &motion_,
                   coupling::SolidParticipant<dim> &participant_)
        : solid(of)
        , motion(motion_)
        , nodes(participant_)
      {
      }

      coupling::Participant       &participant() override { return nodes; }
      const coupling::Participant &participant() const override { return nodes; }
      Eigen::Vector3d              place(const std::size_t node) const override { return nodes.place(node); }

      Eigen::Vector3d displacement(const std::size_t node) const override
      {
        Eigen::Vector3d found = Eigen::Vector3d::Zero();
        for (int c = 0; c < dim; ++c)
          found[c] = motion.displacement()[nodes.displacements(node)[c]];
        return found;
      }

      bool is_held(const std::size_t node, const int axis) const override
      {
        return axis < dim && solid.constraints().is_constrained(nodes.displacements(node)[axis]);
      }

      std::vector<std::size_t> on(const std::string &boundary) const override
      {
        std::vector<std::size_t> found;
        for (const auto first : solid.boundary_dofs(boundary, 0))
          found.push_back(nodes.carrier_of(first));
        std::sort(found.begin(), found.end());
        return found;
      }

    private:
      const fem::Solid<dim>           &solid;
      const fem::ExplicitSolver<dim>  &motion;
      coupling::SolidParticipant<dim> &nodes;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<SolidNodes> nodes_of(const fem::Solid<dim>           &solid,
                                       const fem::ExplicitSolver<dim>  &motion,
                                       coupling::SolidParticipant<dim> &participant)
  {
    return std::make_unique<NodesOfSolid<dim>>(solid, motion, participant);
  }

  template std::unique_ptr<SolidNodes>
  nodes_of(const fem::Solid<2> &, const fem::ExplicitSolver<2> &, coupling::SolidParticipant<2> &);
  template std::unique_ptr<SolidNodes>
  nodes_of(const fem::Solid<3> &, const fem::ExplicitSolver<3> &, coupling::SolidParticipant<3> &);
} // namespace apps
