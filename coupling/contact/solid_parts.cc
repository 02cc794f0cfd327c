#include "coupling/contact/solid_parts.h"

#include <deal.II/dofs/dof_accessor.h>

#include <numeric>

namespace coupling
{
  namespace
  {
    /** Sets of nodes that grow together. */
    class Sets
    {
    public:
      explicit Sets(const std::size_t count)
        : root(count)
      {
        std::iota(root.begin(), root.end(), std::size_t{0});
      }
      std::size_t of(std::size_t i)
      {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      }
      void join(const std::size_t a, const std::size_t b) { root[of(a)] = of(b); }

    private:
      std::vector<std::size_t> root;
    };
  } // namespace

  template <int dim>
  std::vector<SolidPart> solid_parts(const fem::Solid<dim> &solid, const SolidParticipant<dim> &participant)
  {
    const auto                                  &fe = solid.dofs().get_fe();
    std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
    Sets                                         sets(participant.carriers());
    std::vector<std::size_t>                     node_of_cell;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      {
        cell->get_dof_indices(indices);
        const std::size_t first = participant.carrier_of(cell->vertex_dof_index(0, 0));
        for (unsigned int i = 0; i < indices.size(); ++i)
          if (fe.system_to_component_index(i).first == 0)
            sets.join(participant.carrier_of(indices[i]), first);
        node_of_cell.push_back(first);
      }
    constexpr auto           none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> number(participant.carriers(), none); // of the part, by the root of its nodes
    std::vector<SolidPart>   parts;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      {
        std::size_t &of = number[sets.of(node_of_cell[cell->active_cell_index()])];
        if (of == none)
          {
            of = parts.size();
            parts.emplace_back();
          }
        parts[of].cells.push_back(cell->active_cell_index());
        parts[of].materials.insert(cell->material_id());
      }
    for (std::size_t i = 0; i < participant.carriers(); ++i)
      parts[number[sets.of(i)]].carriers.push_back(i);
    return parts;
  }

  template std::vector<SolidPart> solid_parts<2>(const fem::Solid<2> &, const SolidParticipant<2> &);
  template std::vector<SolidPart> solid_parts<3>(const fem::Solid<3> &, const SolidParticipant<3> &);
} // namespace coupling
