#pragma once

#include "coupling/participants/participant.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace fem
{
  template <int dim>
  class Solid;
  template <int dim>
  class ExplicitSolver;
} // namespace fem

namespace coupling
{
  template <int dim>
  class SolidParticipant;
}

namespace apps
{
  /** The nodes of a solid in explicit motion, as a program sees and moves them; whatever the dimension. In the plane z is zero. */
  class SolidNodes
  {
  public:
    virtual ~SolidNodes() = default;

    virtual coupling::Participant       &participant()                        = 0; ///< carriers are the nodes
    virtual const coupling::Participant &participant() const                  = 0;
    virtual Eigen::Vector3d              place(std::size_t node) const        = 0; ///< undeformed [m]
    virtual Eigen::Vector3d              displacement(std::size_t node) const = 0; ///< [m]

    /** Whether the solid's own loads prescribe where it is. @param axis along x, y or z: 0, 1, 2 */
    virtual bool is_held(std::size_t node, int axis) const = 0;

    /** Numbers of the nodes on a boundary, ascending. @throws base::InputError on an unknown one, which lists those there are */
    virtual std::vector<std::size_t> on(const std::string &boundary) const = 0;
  };

  /** All must outlive it. */
  template <int dim>
  std::unique_ptr<SolidNodes> nodes_of(const fem::Solid<dim>           &solid,
                                       const fem::ExplicitSolver<dim>  &motion,
                                       coupling::SolidParticipant<dim> &participant);
} // namespace apps
