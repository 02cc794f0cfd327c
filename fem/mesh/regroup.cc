#include "fem/mesh/regroup.h"

#include "base/errors.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /// Whether elements are of a group.
    template <int dim>
    std::function<bool(types::material_id)> members_of(const Mesh<dim> &mesh, const std::string &group)
    {
      if (group.empty())
        return [](types::material_id) { return true; };
      const auto found = mesh.materials.find(group);
      if (found == mesh.materials.end())
        {
          std::string all;
          for (const auto &[name, number] : mesh.materials)
            all += (all.empty() ? "" : ", ") + name;
          throw base::InputError("the mesh has no group of elements \"" + group + "\". It has: " + all + ".");
        }
      return [id = found->second](const types::material_id number) { return number == id; };
    }
  } // namespace

  template <int dim>
  Extent<dim> extent_of(const Mesh<dim> &mesh, const std::string &group)
  {
    const auto     is_member    = members_of(mesh, group);
    const MPI_Comm communicator = mesh.triangulation->get_communicator();
    Extent<dim>    box;
    for (int d = 0; d < dim; ++d)
      {
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          if (cell->is_locally_owned() && is_member(cell->material_id()))
            for (const unsigned int v : cell->vertex_indices())
              {
                low  = std::min(low, cell->vertex(v)[d]);
                high = std::max(high, cell->vertex(v)[d]);
              }
        box.low[d]  = Utilities::MPI::min(low, communicator);
        box.high[d] = Utilities::MPI::max(high, communicator);
      }
    return box;
  }

  template <int dim>
  std::vector<std::size_t>
  regroup(Mesh<dim>                                                                              &mesh,
          const std::string                                                                      &group,
          const std::vector<std::string>                                                         &names,
          const std::function<std::vector<std::size_t>(const std::vector<dealii::Point<dim>> &)> &of)
  {
    const auto         is_member = members_of(mesh, group);
    types::material_id next      = 0;
    for (const auto &[name, number] : mesh.materials)
      next = std::max<types::material_id>(next, number + 1);
    if (group.empty())
      mesh.materials.clear();
    else
      mesh.materials.erase(group);
    const types::material_id first = next;
    for (const std::string &name : names)
      if (!mesh.materials.emplace(name, next++).second)
        throw base::InputError("the mesh has a group of elements \"" + name + "\" already. Choose another name.");

    std::vector<typename Triangulation<dim>::active_cell_iterator> members;
    std::vector<Point<dim>>                                        middles;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      if (!cell->is_artificial() && is_member(cell->material_id()))
        {
          members.push_back(cell);
          middles.push_back(cell->center());
        }
    const std::vector<std::size_t> numbers = of(middles);
    std::vector<std::size_t>       counts(names.size(), 0);
    for (std::size_t i = 0; i < members.size(); ++i)
      {
        members[i]->set_material_id(first + static_cast<types::material_id>(numbers.at(i)));
        counts.at(numbers[i]) += members[i]->is_locally_owned() ? 1 : 0;
      }
    for (std::size_t &count : counts)
      count = Utilities::MPI::sum(count, mesh.triangulation->get_communicator());
    return counts;
  }

  template Extent<2> extent_of(const Mesh<2> &, const std::string &);
  template Extent<3> extent_of(const Mesh<3> &, const std::string &);
  template std::vector<std::size_t>
  regroup(Mesh<2> &,
          const std::string &,
          const std::vector<std::string> &,
          const std::function<std::vector<std::size_t>(const std::vector<Point<2>> &)> &);
  template std::vector<std::size_t>
  regroup(Mesh<3> &,
          const std::string &,
          const std::vector<std::string> &,
          const std::function<std::vector<std::size_t>(const std::vector<Point<3>> &)> &);
} // namespace fem
