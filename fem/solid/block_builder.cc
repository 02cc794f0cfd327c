#include "fem/solid/block_builder.h"

#include "fem/materials/mixed_control.h"
#include "fem/solid/solid.h"

namespace fem
{
  using namespace dealii;

  template <int dim, typename Number>
  BlockBuilder<dim, Number>::BlockBuilder(const Solid<dim> &solid)
    : fe(solid.dofs().get_fe())
    , options(solid.options())
    , values(solid.mapping(),
             fe.base_element(0),
             solid.quadrature(),
             update_gradients | update_JxW_values | update_quadrature_points)
    , nodes(fe.n_dofs_per_cell() / dim)
    , n_points(solid.quadrature().size())
    , trilinear(dim == 3 && solid.mesh().family == ElementFamily::hypercube && fe.degree == 1)
    , thickness(dim == 2 ? solid.options().thickness : 1.0)
  {
  }

  template <int dim, typename Number>
  ElementBlocksOf<Number> &
  BlockBuilder<dim, Number>::block_for(const MaterialPoints &material, const BlockGeometry geometry, std::size_t &lane)
  {
    const auto [entry, fresh] = known.insert({{&material, geometry}, {blocks.size(), 0}});
    if (fresh)
      {
        ElementBlocksOf<Number> e;
        const base::Stiffness  &d      = material.elastic_stiffness();
        const base::Stiffness   acting = dim == 2 && options.plane == Plane::stress ?
                                           mixed_control::condensed(d, {false, false, true, true, true, false}) :
                                           d;
        e.geometry                     = geometry;
        e.dim                          = dim;
        e.n_nodes                      = nodes;
        e.n_points                     = n_points;
        for (int i = 0; i < 36; ++i)
          e.stiffness[i] = static_cast<Number>(acting(i / 6, i % 6));
        if (dim == 2)
          e.stiffness[21] =
            static_cast<Number>(d(3, 3)); // the one shear modulus that the kernel of isotropic ones reads
        const double bulk = (d(0, 0) + 2 * d(0, 1)) / 3;
        e.isotropic       = (d - base::isotropic_stiffness(bulk, d(3, 3))).norm() <= 1e-14 * bulk;
        blocks.push_back(std::move(e));
      }
    ElementBlocksOf<Number> &e     = blocks[entry->second.first];
    constexpr std::size_t    lanes = ElementBlocksOf<Number>::lanes;
    lane                           = entry->second.second++ % lanes;
    if (lane == 0)
      {
        ++e.n_blocks;
        e.dofs.resize(e.n_blocks * nodes * dim * lanes, 0u);
        e.weights.resize(e.n_blocks * e.n_stored_points() * lanes, Number(0));
        if (geometry == BlockGeometry::gradients)
          e.gradients.resize(e.n_blocks * n_points * nodes * dim * lanes, Number(0));
        else
          e.jacobians.resize(e.n_blocks * e.n_stored_points() * 9 * lanes, Number(0));
      }
    return e;
  }

  template <int dim, typename Number>
  bool BlockBuilder<dim, Number>::find_jacobians(const typename Triangulation<dim>::cell_iterator &cell)
  {
    static const auto unit = [] {
      std::array<std::array<std::array<double, 3>, 8>, 8> all;
      for (unsigned int q = 0; q < 8; ++q)
        for (unsigned int a = 0; a < 8; ++a)
          all[q][a] = unit_gradient(q, a);
      return all;
    }();
    bool            one = true;
    Eigen::Matrix3d first;
    for (unsigned int q = 0; q < 8; ++q)
      {
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
        for (unsigned int a = 0; a < 8; ++a)
          for (int d = 0; d < dim; ++d)
            for (int i = 0; i < dim; ++i)
              jacobian(d, i) += cell->vertex(a)[d] * unit[q][a][i];
        if (q == 0)
          first = jacobian;
        one                            = one && (jacobian - first).norm() <= 1e-13 * first.norm();
        volume[q]                      = jacobian.determinant() / 8;
        const Eigen::Matrix3d inverted = jacobian.inverse();
        for (int i = 0; i < 3; ++i)
          for (int d = 0; d < 3; ++d)
            inverse[q][3 * i + d] = inverted(i, d);
      }
    return one;
  }

  template <int dim, typename Number>
  bool BlockBuilder<dim, Number>::share_volumes(const typename Triangulation<dim>::cell_iterator &cell)
  {
    if (!options.share)
      return true;
    bool whole = true;
    values.reinit(cell);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const double share = share_at(options, values.quadrature_point(q));
        whole              = whole && share == 1;
        volume[q] *= share;
      }
    return whole;
  }

  template <int dim, typename Number>
  void BlockBuilder<dim, Number>::store_jacobians(ElementBlocksOf<Number> &e, const std::size_t lane) const
  {
    constexpr std::size_t lanes  = ElementBlocksOf<Number>::lanes;
    const std::size_t     stored = e.n_stored_points();
    for (std::size_t q = 0; q < stored; ++q)
      {
        const std::size_t at         = (e.n_blocks - 1) * stored + q;
        e.weights[at * lanes + lane] = static_cast<Number>(volume[q]);
        for (std::size_t i = 0; i < 9; ++i)
          e.jacobians[(at * 9 + i) * lanes + lane] = static_cast<Number>(inverse[q][i]);
      }
  }

  template <int dim, typename Number>
  void BlockBuilder<dim, Number>::store_gradients(ElementBlocksOf<Number> &e, const std::size_t lane) const
  {
    constexpr std::size_t lanes = ElementBlocksOf<Number>::lanes;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const std::size_t at = (e.n_blocks - 1) * n_points + q;
        e.weights[at * lanes + lane] =
          static_cast<Number>(thickness * values.JxW(q) * share_at(options, values.quadrature_point(q)));
        for (unsigned int a = 0; a < nodes; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            e.gradients[((at * nodes + a) * dim + d) * lanes + lane] = static_cast<Number>(values.shape_grad(a, q)[d]);
      }
  }

  template <int dim, typename Number>
  void BlockBuilder<dim, Number>::add(const typename Triangulation<dim>::cell_iterator &cell,
                                      const std::vector<unsigned int>                  &positions,
                                      const MaterialPoints                             &material)
  {
    std::size_t lane     = 0;
    auto        geometry = BlockGeometry::gradients;
    if (trilinear)
      geometry = find_jacobians(cell) && share_volumes(cell) ? BlockGeometry::parallelepiped : BlockGeometry::trilinear;
    else
      values.reinit(cell);
    ElementBlocksOf<Number> &e = block_for(material, geometry, lane);
    if (trilinear)
      store_jacobians(e, lane);
    else
      store_gradients(e, lane);
    for (unsigned int i = 0; i < positions.size(); ++i)
      {
        const auto [c, a] = fe.system_to_component_index(i);
        e.dofs[(((e.n_blocks - 1) * nodes + a) * dim + c) * ElementBlocksOf<Number>::lanes + lane] = positions[i];
      }
  }

  template class BlockBuilder<2, double>;
  template class BlockBuilder<3, double>;
  template class BlockBuilder<2, float>;
  template class BlockBuilder<3, float>;
}
