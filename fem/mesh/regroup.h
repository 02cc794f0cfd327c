#pragma once

#include "fem/mesh/extent.h"
#include "fem/mesh/mesh.h"

#include <deal.II/base/point.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace fem
{
  /// Box around the elements of a group, the parts of all ranks together. @param group "": all @pre the group has elements
  template <int dim>
  Extent<dim> extent_of(const Mesh<dim> &mesh, const std::string &group);

  /**
   * Share out the elements of a group among new ones, by their middles.
   *
   * @param group "": all elements @param names of the new groups, which may be that of the old one
   * @param of number of the new group at each of so many places
   * @return elements of each new group, on all ranks
   * @throws base::InputError for a group that there is not, or a new one that the mesh has already
   */
  template <int dim>
  std::vector<std::size_t>
  regroup(Mesh<dim>                                                                              &mesh,
          const std::string                                                                      &group,
          const std::vector<std::string>                                                         &names,
          const std::function<std::vector<std::size_t>(const std::vector<dealii::Point<dim>> &)> &of);
} // namespace fem
