#include "coupling/surface/boundary_facets.h"

#include <deal.II/dofs/dof_accessor.h>

#include <map>
#include <set>
#include <stdexcept>

namespace coupling
{
  namespace
  {
    /** Corners of the facets that a face becomes, as numbers of its vertices. */
    std::vector<std::vector<unsigned int>> split(const unsigned int vertices)
    {
      if (vertices == 4)
        return {{0, 1, 3}, {0, 3, 2}};
      return vertices == 3 ? std::vector<std::vector<unsigned int>>{{0, 1, 2}} :
                             std::vector<std::vector<unsigned int>>{{0, 1}};
    }
  } // namespace

  template <int dim>
  BoundaryFacets boundary_facets(const fem::Solid<dim>          &solid,
                                 const SolidParticipant<dim>    &participant,
                                 const std::vector<std::string> &names)
  {
    std::map<dealii::types::global_dof_index, std::size_t> carrier_of; // by the first displacement
    for (std::size_t i = 0; i < participant.carriers(); ++i)
      carrier_of.emplace(participant.displacements(i)[0], i);
    std::set<dealii::types::boundary_id> ids;
    for (const std::string &name : names)
      ids.insert(solid.mesh().boundary(name));
    std::map<std::size_t, std::int32_t> vertex_of; // by the carrier
    BoundaryFacets                      found;
    found.mesh.corners       = dim;
    const auto vertex_number = [&](const std::size_t carrier) {
      const auto [at, is_new] = vertex_of.emplace(carrier, static_cast<std::int32_t>(vertex_of.size()));
      if (is_new)
        {
          found.carrier.push_back(carrier);
          found.mesh.vertex.push_back(participant.position(carrier));
        }
      return at->second;
    };
    for (const auto &cell : solid.dofs().active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && (names.empty() || ids.count(face->boundary_id()) > 0))
          for (const auto &corners : split(face->n_vertices()))
            {
              std::array<std::int32_t, 3> facet{};
              for (std::size_t k = 0; k < corners.size(); ++k)
                facet[k] = vertex_number(carrier_of.at(face->vertex_dof_index(corners[k], 0)));
              found.mesh.facet.push_back(facet);
            }
    if (found.mesh.facet.empty())
      throw std::invalid_argument("surface: this part of the boundary has no faces.");
    return found;
  }

  template BoundaryFacets
  boundary_facets<2>(const fem::Solid<2> &, const SolidParticipant<2> &, const std::vector<std::string> &);
  template BoundaryFacets
  boundary_facets<3>(const fem::Solid<3> &, const SolidParticipant<3> &, const std::vector<std::string> &);
} // namespace coupling
