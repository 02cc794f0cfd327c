#include "coupling/surface/boundary_facets.h"

#include "base/errors.h"

#include <deal.II/dofs/dof_accessor.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>

namespace coupling
{
  namespace
  {
    /** Corners of a face in the order around it. */
    std::vector<unsigned int> around(const unsigned int vertices)
    {
      if (vertices == 4)
        return {0, 1, 3, 2};
      return vertices == 3 ? std::vector<unsigned int>{0, 1, 2} : std::vector<unsigned int>{0, 1};
    }

    /** Which side of a face is out of its cell. @param ring its corners */
    template <int dim>
    signed char
    outward(const BoundaryFacets &found, const std::vector<std::int32_t> &ring, const Eigen::Vector3d &within)
    {
      std::array<Eigen::Vector3d, 3> corner;
      for (std::size_t c = 0; c < 3; ++c)
        corner[c] = found.mesh.vertex[static_cast<std::size_t>(ring[std::min<std::size_t>(c, ring.size() - 1)])];
      return dem::facet_normal(corner, dim == 2).dot(corner[0] - within) > 0 ? 1 : -1;
    }

    /** Four triangles about a vertex that is the mean of the corners. @param ring corners around the face */
    void split_about_middle(const std::vector<std::int32_t> &ring, BoundaryFacets &found)
    {
      const auto number = static_cast<std::int32_t>(found.carrier.size() + found.middle.size());
      auto      &nodes  = found.middle.emplace_back();
      auto      &place  = found.mesh.vertex.emplace_back(Eigen::Vector3d::Zero());
      for (std::size_t k = 0; k < 4; ++k)
        {
          nodes[k] = static_cast<std::size_t>(ring[k]);
          place += 0.25 * found.mesh.vertex[nodes[k]];
          found.mesh.facet.push_back({ring[k], ring[(k + 1) % 4], number});
        }
    }
  } // namespace

  template <int dim>
  BoundaryFacets boundary_facets(const fem::Solid<dim>          &solid,
                                 const SolidParticipant<dim>    &participant,
                                 const std::vector<std::string> &names,
                                 const QuadrilateralSplit        split)
  {
    std::set<dealii::types::boundary_id> ids;
    for (const std::string &name : names)
      ids.insert(solid.mesh().boundary(name));
    std::map<std::size_t, std::int32_t>    vertex_of; // by the carrier
    std::vector<std::vector<std::int32_t>> faces;
    std::vector<signed char>               leaves; // the body, each face's normal
    BoundaryFacets                         found;
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
          {
            auto &corners = faces.emplace_back();
            for (const unsigned int v : around(face->n_vertices()))
              corners.push_back(vertex_number(participant.carrier_of(face->vertex_dof_index(v, 0))));
            Eigen::Vector3d within = Eigen::Vector3d::Zero();
            for (const unsigned int v : cell->vertex_indices())
              within += participant.position(participant.carrier_of(cell->vertex_dof_index(v, 0))) / cell->n_vertices();
            leaves.push_back(outward<dim>(found, corners, within));
          }
    for (std::size_t f = 0; f < faces.size(); ++f)
      {
        const std::vector<std::int32_t> &corner = faces[f];
        if (corner.size() < 4)
          found.mesh.facet.push_back({corner[0], corner[1], corner.size() == 3 ? corner[2] : 0});
        else if (split == QuadrilateralSplit::middle)
          split_about_middle(corner, found);
        else
          {
            found.mesh.facet.push_back({corner[0], corner[1], corner[2]});
            found.mesh.facet.push_back({corner[0], corner[2], corner[3]});
          }
        found.mesh.outward.resize(found.mesh.facet.size(), leaves[f]);
      }
    if (found.mesh.facet.empty())
      throw base::InputError("surface: this part of the boundary has no faces.");
    return found;
  }

  template BoundaryFacets boundary_facets<2>(const fem::Solid<2> &,
                                             const SolidParticipant<2> &,
                                             const std::vector<std::string> &,
                                             QuadrilateralSplit);
  template BoundaryFacets boundary_facets<3>(const fem::Solid<3> &,
                                             const SolidParticipant<3> &,
                                             const std::vector<std::string> &,
                                             QuadrilateralSplit);
} // namespace coupling
