// Supports of a solid: which displacements are prescribed, and whether they hold it.
#include "base/errors.h"
#include "fem/mesh/extent.h"
#include "fem/solid/rigid_motion.h"
#include "fem/solid/solid.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <cmath>
#include <set>
#include <sstream>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /// The vertex at which `score` is largest, the same on every rank (ties: the first in rank order).
    template <int dim, typename Score>
    Point<dim> best_vertex(const Mesh<dim> &mesh, const Score &score)
    {
      std::pair<double, Point<dim>> best{-1e300, Point<dim>()};
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        if (cell->is_locally_owned())
          for (unsigned int v = 0; v < cell->n_vertices(); ++v)
            if (score(cell->vertex(v)) > best.first)
              best = {score(cell->vertex(v)), cell->vertex(v)};
      for (const auto &candidate : Utilities::MPI::all_gather(mesh.triangulation->get_communicator(), best))
        if (candidate.first > best.first)
          best = candidate;
      for (const auto &candidate : Utilities::MPI::all_gather(mesh.triangulation->get_communicator(), best))
        if (candidate.first == best.first)
          return candidate.second;
      return best.second;
    }
  }

  template <int dim>
  template <typename Visit>
  void Solid<dim>::visit_nodes(const Visit &visit) const
  {
    std::vector<types::global_dof_index> indices(element->n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            visit(cell, i, indices[i], element->system_to_component_index(i).first,
                  [&, i] { return geometry->transform_unit_to_real_cell(cell, element->unit_support_point(i)); });
        }
  }

  template <int dim>
  void Solid<dim>::add_prescribed(const types::global_dof_index dof,
                                  const unsigned int            component,
                                  const Point<dim>             &place,
                                  const ScalarOf<dim>          &value)
  {
    const auto known = prescribed_dofs.find(dof);
    if (known == prescribed_dofs.end())
      {
        prescribed_dofs[dof] = {place, component, value};
        return;
      }
    // Two boundaries may share an edge if they agree there, at the start and later.
    for (const double time : {0.0, 0.3, 1.0})
      {
        const double a = known->second.value(place, time), b = value(place, time);
        if (std::fabs(a - b) > 1e-12 * std::max(std::fabs(a), std::fabs(b)))
          {
            std::ostringstream text;
            text << "displacement at " << place << ": two boundary conditions prescribe " << a << " m and " << b
                 << " m at time " << time << ". Let them agree on the shared edge, or drop one component.";
            throw base::InputError(text.str());
          }
      }
  }

  template <int dim>
  void Solid<dim>::hold_boundary(const PrescribedDisplacement<dim> &p)
  {
    if (p.component >= dim)
      throw base::InputError("boundary = " + p.boundary + ": the model has no displacement component " +
                             std::to_string(p.component) + ".");
    const types::boundary_id             id = grid.boundary(p.boundary);
    std::set<types::global_dof_index>    on_boundary;
    std::vector<types::global_dof_index> indices;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && cell->at_boundary())
        for (const unsigned int face : cell->face_indices())
          if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == id)
            {
              indices.resize(element->n_dofs_per_face(face));
              cell->face(face)->get_dof_indices(indices);
              on_boundary.insert(indices.begin(), indices.end());
            }
    // A node of an element may lie on a boundary face of its neighbour only: every element is visited.
    visit_nodes([&](const auto &, unsigned int, const types::global_dof_index dof, const unsigned int component,
                    const auto &place) {
      if (component == p.component && on_boundary.count(dof) > 0)
        add_prescribed(dof, component, place(), p.value);
    });
  }

  template <int dim>
  void Solid<dim>::hold_node(const PrescribedNode<dim> &node)
  {
    const double extent   = extent_of(grid).diagonal();
    double       distance = 1e300;
    visit_nodes(
      [&](const auto &, unsigned int, types::global_dof_index, const unsigned int component, const auto &place) {
        if (component == node.component)
          distance = std::min(distance, place().distance(node.where));
      });
    distance = Utilities::MPI::min(distance, communicator());
    if (distance > node.tolerance * extent)
      {
        std::ostringstream text;
        text << "support at " << node.where << ": the nearest node is " << distance << " m away, the tolerance is "
             << node.tolerance * extent << " m. Move the support to a node or refine the mesh.";
        throw base::InputError(text.str());
      }
    visit_nodes([&](const auto &, unsigned int, const types::global_dof_index dof, const unsigned int component,
                    const auto &place) {
      if (component == node.component && place().distance(node.where) <= distance + 1e-10 * extent)
        add_prescribed(dof, component, place(), node.value);
    });
  }

  namespace
  {
    /// How far a point lies outside a box.
    template <int dim>
    double distance_to_box(const Point<dim> &x, const Point<dim> &low, const Point<dim> &high)
    {
      double squares = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double outside = std::max({0.0, low[d] - x[d], x[d] - high[d]});
          squares += outside * outside;
        }
      return std::sqrt(squares);
    }

    constexpr double box_tolerance = 1e-6; // of the mesh's extent: coordinates as meshers write them
  }

  template <int dim>
  void Solid<dim>::hold_box(const PrescribedBox<dim> &box)
  {
    const double tolerance = box_tolerance * extent_of(grid).diagonal();
    double       distance  = 1e300;
    visit_nodes([&](const auto &, unsigned int, const types::global_dof_index dof, const unsigned int component,
                    const auto &place) {
      if (component != box.component)
        return;
      const double off = distance_to_box(place(), box.low, box.high);
      distance         = std::min(distance, off);
      if (off <= tolerance)
        add_prescribed(dof, component, place(), box.value);
    });
    distance = Utilities::MPI::min(distance, communicator());
    if (distance > tolerance)
      {
        std::ostringstream text;
        text << "support from " << box.low << " to " << box.high << ": no node lies in it, the nearest is " << distance
             << " m away. Move the support to a node, enlarge its box or refine the mesh.";
        throw base::InputError(text.str());
      }
  }

  template <int dim>
  std::vector<types::global_dof_index> Solid<dim>::boundary_dofs(const std::string &boundary,
                                                                 const unsigned int component) const
  {
    ComponentMask mask(dim, false);
    mask.set(component, true);
    std::vector<types::global_dof_index> found;
    for (const auto dof : DoFTools::extract_boundary_dofs(dof_handler, mask, {grid.boundary(boundary)}))
      if (owned.is_element(dof))
        found.push_back(dof);
    return found;
  }

  template <int dim>
  std::vector<types::global_dof_index>
  Solid<dim>::dofs_within(const Point<dim> &low, const Point<dim> &high, const unsigned int component) const
  {
    const double                      tolerance = box_tolerance * extent_of(grid).diagonal();
    std::set<types::global_dof_index> found;
    visit_nodes(
      [&](const auto &, unsigned int, const types::global_dof_index dof, const unsigned int c, const auto &place) {
        if (c == component && owned.is_element(dof) && distance_to_box(place(), low, high) <= tolerance)
          found.insert(dof);
      });
    return {found.begin(), found.end()};
  }

  template <int dim>
  void Solid<dim>::hold_rigid_motion()
  {
    const auto zero   = [](const Point<dim> &, double) { return 0.0; };
    const auto hold   = [&](const Point<dim> &where, const unsigned int c) { hold_node({where, c, zero, 1e-9}); };
    const auto corner = extent_of(grid).low;

    const Point<dim> a = best_vertex<dim>(grid, [&](const Point<dim> &x) { return -x.distance(corner); });
    for (unsigned int c = 0; c < dim; ++c)
      hold(a, c);

    const Point<dim>     b     = best_vertex<dim>(grid, [&](const Point<dim> &x) { return x.distance(a); });
    const Tensor<1, dim> along = b - a;
    unsigned int         k     = 0; // axis closest to a-b: the others turn with it
    for (unsigned int c = 1; c < dim; ++c)
      if (std::fabs(along[c]) > std::fabs(along[k]))
        k = c;
    for (unsigned int c = 0; c < dim; ++c)
      if (c != k)
        hold(b, c);
    if constexpr (dim == 3)
      {
        const auto       normal = [&](const Point<dim> &x) { return cross_product_3d(along, x - a); };
        const Point<dim> third  = best_vertex<dim>(grid, [&](const Point<dim> &x) { return normal(x).norm(); });
        unsigned int     m      = 0;
        for (unsigned int c = 1; c < dim; ++c)
          if (std::fabs(normal(third)[c]) > std::fabs(normal(third)[m]))
            m = c;
        hold(third, m);
      }
  }

  template <int dim>
  void Solid<dim>::refuse_free_motion() const
  {
    const auto       extent = extent_of(grid);
    RigidMotion<dim> motion(extent.low, extent.diagonal());
    for (const auto &entry : prescribed_dofs)
      if (owned.is_element(entry.first))
        motion.hold(entry.second.place, entry.second.component);
    const std::string free = motion.free_motion(communicator());
    if (!free.empty())
      throw base::InputError("supports: the solid can move as a rigid body (mainly " + free +
                             "). Prescribe more displacements, or have the rigid motion removed.");
  }

  template <int dim>
  void Solid<dim>::place_supports()
  {
    prescribed_dofs.clear();
    for (const auto &p : loads.displacements)
      hold_boundary(p);
    for (const auto &p : loads.nodes)
      hold_node(p);
    for (const auto &p : loads.boxes)
      hold_box(p);
    if (loads.remove_rigid_motion)
      hold_rigid_motion();
    if (!loads.may_move_freely)
      refuse_free_motion();

    supports.reinit(relevant);
    for (const auto &entry : prescribed_dofs)
      supports.add_line(entry.first);
    supports.make_consistent_in_parallel(owned, relevant, communicator());
    supports.close();
  }

  template <int dim>
  void Solid<dim>::prescribed(const double time, Vector &values) const
  {
    values = 0;
    for (const auto &entry : prescribed_dofs)
      if (owned.is_element(entry.first))
        values[entry.first] = entry.second.value(entry.second.place, time);
    values.update_ghost_values();
  }

  template void                                 Solid<2>::place_supports();
  template void                                 Solid<3>::place_supports();
  template void                                 Solid<2>::prescribed(double, Vector &) const;
  template std::vector<types::global_dof_index> Solid<2>::boundary_dofs(const std::string &, unsigned int) const;
  template std::vector<types::global_dof_index> Solid<3>::boundary_dofs(const std::string &, unsigned int) const;
  template std::vector<types::global_dof_index>
  Solid<2>::dofs_within(const Point<2> &, const Point<2> &, unsigned int) const;
  template std::vector<types::global_dof_index>
                Solid<3>::dofs_within(const Point<3> &, const Point<3> &, unsigned int) const;
  template void Solid<3>::prescribed(double, Vector &) const;
}
