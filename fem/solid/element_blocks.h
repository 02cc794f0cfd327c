#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <vector>

namespace fem
{
  /// Memory that starts where the widest vectors of any processor like it.
  template <typename T>
  struct CacheLineAllocator
  {
    using value_type     = T;
    CacheLineAllocator() = default;
    template <typename U>
    CacheLineAllocator(const CacheLineAllocator<U> &)
    {
    }
    T   *allocate(const std::size_t n) { return static_cast<T *>(::operator new(n * sizeof(T), std::align_val_t(64))); }
    void deallocate(T *p, std::size_t) { ::operator delete(p, std::align_val_t(64)); }
    bool operator==(const CacheLineAllocator &) const { return true; }
    bool operator!=(const CacheLineAllocator &) const { return false; }
  };

  template <typename T>
  using AlignedColumn = std::vector<T, CacheLineAllocator<T>>;

  /// What is stored of the geometry of the elements in a block.
  enum class BlockGeometry
  {
    gradients,     ///< shape gradients at every point: any element
    trilinear,     ///< inverse Jacobians at the 2 x 2 x 2 points of hexahedra with 8 nodes: a third of the memory
    parallelepiped ///< the same with one Jacobian per element
  };

  /**
   * Elements of one linear elastic material in groups of `lanes`, laid out so that one vector instruction treats one number of
   * all elements of a group. Empty lanes at the end carry zero geometry and the degree of freedom 0.
   */
  template <typename Number>
  struct ElementBlocksOf
  {
    static constexpr std::size_t lanes = 64 / sizeof(Number);

    BlockGeometry          geometry = BlockGeometry::gradients;
    unsigned int           dim = 3, n_nodes = 0, n_points = 0;
    std::size_t            n_blocks = 0;
    std::array<Number, 36> stiffness{};       ///< [Pa], Voigt, by rows
    bool                   isotropic = false; ///< then only D_11, D_12, D_44 are used
    AlignedColumn<Number>  gradients;         ///< (block, point, node, direction, lane) [1/m]
    AlignedColumn<Number>
      jacobians; ///< (block, point, unit direction, direction, lane) [1/m]; one point: parallelepiped
    AlignedColumn<Number>       weights; ///< (block, point, lane) [m^3]; one point: parallelepiped
    AlignedColumn<unsigned int> dofs;    ///< (block, node, component, lane): position in the displacement array

    /// Points with a geometry of their own.
    unsigned int n_stored_points() const { return geometry == BlockGeometry::parallelepiped ? 1 : n_points; }
  };

  using ElementBlocks = ElementBlocksOf<double>;

  /// Derivatives of the 8 shape functions of the unit hexahedron along its axes at its 2 x 2 x 2 Gauss points (x runs fastest).
  std::array<double, 3> unit_gradient(unsigned int point, unsigned int node);

  /**
   * Adds the internal forces of small-strain elasticity to `force`, element after element: the same sum in every run.
   *
   * @param displacement [m], @param force [N]: arrays that hold every position named in `dofs`.
   */
  template <typename Number>
  void add_internal_force(const ElementBlocksOf<Number> &elements, const Number *displacement, Number *force);

  /// Adds the diagonal of the stiffness [N/m] to an array laid out like the force.
  template <typename Number>
  void add_diagonal(const ElementBlocksOf<Number> &elements, Number *diagonal);
}
