#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace fem
{
  /**
   * Elements of one linear elastic material in groups of `lanes`, laid out so that one vector instruction treats one number of
   * all elements of a group. Empty lanes at the end carry zero gradients and the degree of freedom 0.
   */
  struct ElementBlocks
  {
    static constexpr std::size_t lanes = 8;

    unsigned int              dim = 3, n_nodes = 0, n_points = 0;
    std::size_t               n_blocks = 0;
    std::array<double, 36>    stiffness{};       ///< [Pa], Voigt, by rows
    bool                      isotropic = false; ///< then only D_11, D_12, D_44 are used
    std::vector<double>       gradients;         ///< (block, point, node, direction, lane) [1/m]
    std::vector<double>       weights;           ///< (block, point, lane) [m^3]
    std::vector<unsigned int> dofs;              ///< (block, node, component, lane): position in the displacement array
  };

  /**
   * Adds the internal forces of small-strain elasticity to `force`, element after element: the same sum in every run.
   *
   * @param displacement [m], @param force [N]: arrays that hold every position named in `dofs`.
   */
  void add_internal_force(const ElementBlocks &elements, const double *displacement, double *force);
}
