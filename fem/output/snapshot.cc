#include "fem/output/snapshot.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace fem
{
  using namespace dealii;

  namespace
  {
    constexpr int viewer_order[6] = {0, 1, 2, 5, 3, 4}; // of a tensor xx yy zz xy yz xz in Voigt's order

    /// Number in VTK's file format, and the nodes in its order.
    template <int dim>
    struct ViewedElement
    {
      int                     type;
      std::vector<Point<dim>> nodes;
    };

    /// Corners, then mid-edges, mid-faces and centre of an element of the second order.
    template <int dim>
    ViewedElement<dim> viewed_element(const ElementFamily family, const unsigned int degree)
    {
      using List      = std::vector<std::array<double, 3>>;
      const bool cube = family == ElementFamily::hypercube, second = degree == 2;
      List       nodes, between;
      int        type = 0;
      if (dim == 2 && cube)
        {
          type    = second ? 28 : 9;
          nodes   = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
          between = {{.5, 0, 0}, {1, .5, 0}, {.5, 1, 0}, {0, .5, 0}, {.5, .5, 0}};
        }
      else if (dim == 2)
        {
          type    = second ? 22 : 5;
          nodes   = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
          between = {{.5, 0, 0}, {.5, .5, 0}, {0, .5, 0}};
        }
      else if (cube)
        {
          type    = second ? 29 : 12;
          nodes   = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
          between = {{.5, 0, 0},  {1, .5, 0},  {.5, 1, 0},  {0, .5, 0},  {.5, 0, 1},  {1, .5, 1},  {.5, 1, 1},
                     {0, .5, 1},  {0, 0, .5},  {1, 0, .5},  {1, 1, .5},  {0, 1, .5},  {0, .5, .5}, {1, .5, .5},
                     {.5, 0, .5}, {.5, 1, .5}, {.5, .5, 0}, {.5, .5, 1}, {.5, .5, .5}};
        }
      else
        {
          type    = second ? 24 : 10;
          nodes   = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
          between = {{.5, 0, 0}, {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {.5, 0, .5}, {0, .5, .5}};
        }
      if (second)
        nodes.insert(nodes.end(), between.begin(), between.end());
      ViewedElement<dim> element;
      element.type = type;
      for (const auto &x : nodes)
        {
          Point<dim> p;
          for (unsigned int c = 0; c < dim; ++c)
            p[c] = x[c];
          element.nodes.push_back(p);
        }
      return element;
    }

    /// Names that any rank knows, the same and in the same order on all.
    template <typename Value>
    std::vector<std::string> names_on_all_ranks(const std::map<std::string, Value> &own, const MPI_Comm comm)
    {
      std::vector<std::string> names;
      for (const auto &entry : own)
        names.push_back(entry.first);
      std::map<std::string, int> all;
      for (const auto &of_rank : Utilities::MPI::all_gather(comm, names))
        for (const auto &name : of_rank)
          all[name] = 1;
      names.clear();
      for (const auto &entry : all)
        names.push_back(entry.first);
      return names;
    }

    /// Averages of tensors of points at the vertices of a mesh.
    template <int dim>
    class VertexAverages
    {
    public:
      explicit VertexAverages(const Solid<dim> &solid)
        : dofs(*solid.mesh().triangulation)
      {
        if (solid.mesh().family == ElementFamily::hypercube)
          element = std::make_unique<FE_Q<dim>>(1);
        else
          element = std::make_unique<FE_SimplexP<dim>>(1);
        dofs.distribute_dofs(*element);
        DoFTools::extract_locally_relevant_dofs(dofs, relevant);
        indices.resize(element->n_dofs_per_cell());
      }

      /// @param tensor in Voigt's order
      void add(const PointView<dim> &point, const Point<dim> &unit, const std::string &name, const double *tensor)
      {
        Sums &sums = made(name);
        go_to(point.cell->level(), point.cell->index());
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const double share = point.volume * element->shape_value(i, unit);
            sums.weight[indices[i]] += share;
            for (int c = 0; c < 6; ++c)
              sums.value[c][indices[i]] += share * tensor[c];
          }
      }

      /// Completes the averages.
      void finish()
      {
        for (const std::string &name : names())
          {
            Sums &sums = made(name);
            sums.weight.compress(VectorOperation::add);
            for (Vector &value : sums.value)
              {
                value.compress(VectorOperation::add);
                for (unsigned int i = 0; i < value.locally_owned_size(); ++i)
                  if (sums.weight.local_element(i) > 0)
                    value.local_element(i) /= sums.weight.local_element(i);
                value.update_ghost_values();
              }
          }
      }

      std::vector<std::string> names() const { return names_on_all_ranks(fields, dofs.get_communicator()); }

      /// Tensor of a finished average, in Voigt's order.
      template <typename Cell>
      std::array<double, 6> at(const Cell &cell, const Point<dim> &unit, const std::string &name)
      {
        const Sums           &sums   = fields.at(name);
        std::array<double, 6> tensor = {};
        go_to(cell->level(), cell->index());
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const double share = element->shape_value(i, unit);
            for (int c = 0; c < 6; ++c)
              tensor[c] += share * sums.value[c][indices[i]];
          }
        return tensor;
      }

    private:
      struct Sums
      {
        std::array<Vector, 6> value;
        Vector                weight;
      };

      Sums &made(const std::string &name)
      {
        Sums &sums = fields[name];
        if (sums.weight.size() == 0)
          {
            sums.weight.reinit(dofs.locally_owned_dofs(), relevant, dofs.get_communicator());
            sums.value.fill(sums.weight);
          }
        return sums;
      }

      void go_to(const int level, const int index)
      {
        const typename DoFHandler<dim>::active_cell_iterator cell(&dofs.get_triangulation(), level, index, &dofs);
        cell->get_dof_indices(indices);
      }

      std::unique_ptr<FiniteElement<dim>>  element;
      DoFHandler<dim>                      dofs;
      IndexSet                             relevant;
      std::map<std::string, Sums>          fields;
      std::vector<types::global_dof_index> indices; // of the element last gone to
    };

    /// Largest value of the points of every element, for histories of one number.
    class ElementMaxima
    {
    public:
      explicit ElementMaxima(const unsigned int cells)
        : n_cells(cells)
      {
      }

      void add(const unsigned int cell, const std::string &name, const double value)
      {
        auto &field = fields[name];
        if (field.empty())
          field.resize(n_cells);
        field[cell] = std::max(field[cell], value);
      }

      std::vector<std::string> names(const MPI_Comm comm) const { return names_on_all_ranks(fields, comm); }

      double at(const unsigned int cell, const std::string &name) const
      {
        const auto field = fields.find(name);
        return field == fields.end() ? 0.0 : field->second[cell];
      }

    private:
      unsigned int                               n_cells;
      std::map<std::string, std::vector<double>> fields;
    };

    /// Nodes and elements of what this rank owns; nodes are shared between elements.
    template <int dim>
    class Nodes
    {
    public:
      Nodes(const Solid<dim> &solid_, const ViewedElement<dim> &shape)
        : solid(solid_)
        , indices(solid.dofs().get_fe().n_dofs_per_cell())
      {
        const FiniteElement<dim> &base    = solid.dofs().get_fe().base_element(0);
        const auto               &support = base.get_unit_support_points();
        for (const Point<dim> &node : shape.nodes)
          {
            const auto found = std::find_if(support.begin(), support.end(),
                                            [&](const Point<dim> &p) { return p.distance(node) < 1e-6; });
            if (found == support.end())
              throw std::logic_error("a node that the viewer needs is none of the element");
            of_base.push_back(static_cast<unsigned int>(found - support.begin()));
          }
      }

      /// @param visit(node of the element, whether it is new)
      template <typename Cell, typename Visit>
      void each(const Cell &cell, const Visit &visit)
      {
        cell->get_dof_indices(indices);
        for (unsigned int n = 0; n < of_base.size(); ++n)
          {
            const auto [entry, is_new] = numbers.try_emplace(dof(n, 0), static_cast<std::int64_t>(numbers.size()));
            visit(n, entry->second, is_new);
          }
      }

      /// Of a component at a node of the element last visited.
      types::global_dof_index dof(const unsigned int node, const unsigned int component) const
      {
        return indices[solid.dofs().get_fe().component_to_system_index(component, of_base[node])];
      }

    private:
      const Solid<dim>                                         &solid;
      std::vector<unsigned int>                                 of_base; // number within one component
      std::vector<types::global_dof_index>                      indices;
      std::unordered_map<types::global_dof_index, std::int64_t> numbers;
    };

    void append(SolidSnapshot::Field &field, const std::array<double, 6> &tensor, const PointQuantity::Kind kind)
    {
      const double shear = kind == PointQuantity::Kind::strain ? 0.5 : 1; // engineering shears
      for (const int c : viewer_order)
        field.values.push_back(static_cast<float>((c < 3 ? 1 : shear) * tensor[static_cast<std::size_t>(c)]));
    }

    /// What is shown of the points of a solid, by its name: stress and strain, and what its materials show of their histories.
    template <int dim>
    std::map<std::string, PointQuantity> shown_quantities(const Solid<dim> &solid)
    {
      using Kind                                 = PointQuantity::Kind;
      std::map<std::string, PointQuantity> shown = {{"stress", {"stress", "Pa", "", Kind::stress}},
                                                    {"strain", {"strain", "-", "", Kind::strain}}};
      for (const auto &group : solid.groups())
        for (const PointQuantity &of : group.second->quantities())
          if (of.shown != PointQuantity::Shown::nowhere)
            {
              const auto [known, is_new] = shown.emplace(of.name, of);
              if (!is_new && (known->second.kind != of.kind || std::string(known->second.unit) != of.unit))
                throw std::logic_error(std::string(group.second->material_name()) + ": another quantity is called " +
                                       of.name);
            }
      return shown;
    }
  }

  template <int dim>
  SolidSnapshot take_snapshot(Solid<dim> &solid, const Vector &displacement, const Vector &reaction)
  {
    VertexAverages<dim>                        averages(solid);
    ElementMaxima                              maxima(solid.mesh().triangulation->n_active_cells());
    const std::map<std::string, PointQuantity> shown = shown_quantities(solid);
    unsigned int                               q     = 0;
    solid.visit_points(displacement, [&](const PointView<dim> &point) {
      const Point<dim> unit = solid.quadrature().point(q);
      q                     = (q + 1) % solid.quadrature().size();
      averages.add(point, unit, "stress", point.stress.data());
      averages.add(point, unit, "strain", point.strain.data());
      point.material->visit(point.index, [&](const PointQuantity &of, const double *values) {
        if (of.shown == PointQuantity::Shown::nowhere)
          return;
        if (of.kind == PointQuantity::Kind::number)
          maxima.add(point.cell->active_cell_index(), of.name, *values);
        else
          averages.add(point, unit, of.name, values);
      });
    });
    averages.finish();

    const auto    shape = viewed_element<dim>(solid.mesh().family, solid.options().degree);
    SolidSnapshot snapshot;
    snapshot.element_type  = shape.type;
    snapshot.element_nodes = static_cast<int>(shape.nodes.size());
    snapshot.at_nodes      = {{"displacement", "m", 3, {}}, {"reaction", "N", 3, {}}};
    for (const std::string &name : averages.names())
      snapshot.at_nodes.push_back({name, shown.at(name).unit, 6, {}});
    for (const std::string &name : maxima.names(solid.communicator()))
      snapshot.of_elements.push_back({name, shown.at(name).unit, 1, {}});

    Nodes<dim> nodes(solid, shape);
    for (const auto &cell : solid.dofs().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        for (SolidSnapshot::Field &field : snapshot.of_elements)
          field.values.push_back(static_cast<float>(maxima.at(cell->active_cell_index(), field.name)));
        nodes.each(cell, [&](const unsigned int n, const std::int64_t number, const bool is_new) {
          snapshot.elements.push_back(number);
          if (!is_new)
            return;
          const Point<dim> place = solid.mapping().transform_unit_to_real_cell(cell, shape.nodes[n]);
          for (unsigned int c = 0; c < 3; ++c)
            {
              snapshot.place.push_back(c < dim ? static_cast<float>(place[c]) : 0.0f);
              snapshot.at_nodes[0].values.push_back(c < dim ? static_cast<float>(displacement[nodes.dof(n, c)]) : 0.0f);
              snapshot.at_nodes[1].values.push_back(c < dim ? static_cast<float>(reaction[nodes.dof(n, c)]) : 0.0f);
            }
          for (std::size_t f = 2; f < snapshot.at_nodes.size(); ++f)
            {
              SolidSnapshot::Field &field = snapshot.at_nodes[f];
              append(field, averages.at(cell, shape.nodes[n], field.name), shown.at(field.name).kind);
            }
        });
      }
    return snapshot;
  }

  template SolidSnapshot take_snapshot(Solid<2> &, const Vector &, const Vector &);
  template SolidSnapshot take_snapshot(Solid<3> &, const Vector &, const Vector &);
}
