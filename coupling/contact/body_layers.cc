#include "coupling/contact/body_layers.h"

#include "base/errors.h"
#include "coupling/contact/solid_parts.h"
#include "coupling/surface/boundary_facets.h"

#include <deal.II/boost_adaptors/bounding_box.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    using Carriers = std::vector<std::size_t>;

    /** An element as the layers are made from it. */
    struct Cell
    {
      Carriers              nodes;
      std::vector<Carriers> faces;    ///< their nodes, around the face
      std::vector<int>      beyond;   ///< cell behind each face; -1: none
      double                measure;  ///< [m^3], in the plane [m^2]
      int                   material; ///< its number in the mesh
      std::size_t           body = 0;
    };

    /** Nodes around a face of deal.II. */
    Carriers around(Carriers nodes)
    {
      if (nodes.size() == 4)
        std::swap(nodes[2], nodes[3]);
      return nodes;
    }

    template <int dim>
    std::vector<Cell> cells_of(const fem::Solid<dim> &solid, const SolidParticipant<dim> &participant)
    {
      std::vector<Cell> cells;
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          Cell &made    = cells.emplace_back();
          made.measure  = cell->measure();
          made.material = static_cast<int>(cell->material_id());
          for (const unsigned int v : cell->vertex_indices())
            made.nodes.push_back(participant.carrier_of(cell->vertex_dof_index(v, 0)));
          for (const unsigned int f : cell->face_indices())
            {
              const auto face = cell->face(f);
              Carriers   nodes;
              for (const unsigned int v : face->vertex_indices())
                nodes.push_back(participant.carrier_of(face->vertex_dof_index(v, 0)));
              made.faces.push_back(around(nodes));
              made.beyond.push_back(face->at_boundary() ? -1 :
                                                          static_cast<int>(cell->neighbor(f)->active_cell_index()));
            }
        }
      return cells;
    }

    /** How deep a place lies below the faces of a solid. */
    template <int dim>
    class Depths
    {
    public:
      Depths(const fem::Solid<dim> &solid, const SolidParticipant<dim> &participant)
        : facets(boundary_facets(solid, participant, {}, QuadrilateralSplit::middle)) // as the layers divide them
        , boxes(boxes_of(facets.mesh))
        , tree(dealii::pack_rtree_of_indices(boxes))
      {
      }
      Depths(const Depths &)            = delete;
      Depths &operator=(const Depths &) = delete;

      double at(const Vector3d &x) const
      {
        namespace bgi = boost::geometry::index;
        double least  = std::numeric_limits<double>::infinity();
        for (auto it = tree.qbegin(bgi::nearest(point(x), static_cast<unsigned int>(facets.mesh.size())));
             it != tree.qend(); ++it)
          {
            if (boost::geometry::distance(boxes[*it], point(x)) > least)
              break;
            least = std::min(least, (dem::closest_on_facet(facets.mesh, facets.mesh.vertex, *it, x).place - x).norm());
          }
        return least;
      }

      std::set<std::size_t> surface_nodes() const { return {facets.carrier.begin(), facets.carrier.end()}; }

    private:
      static dealii::Point<dim> point(const Vector3d &x)
      {
        dealii::Point<dim> p;
        for (int d = 0; d < dim; ++d)
          p[d] = x[d];
        return p;
      }

      static std::vector<dealii::BoundingBox<dim>> boxes_of(const dem::FacetMesh &mesh)
      {
        std::vector<dealii::BoundingBox<dim>> made;
        for (const auto &facet : mesh.facet)
          {
            std::vector<dealii::Point<dim>> corners;
            for (int c = 0; c < mesh.corners; ++c)
              corners.push_back(point(mesh.vertex[static_cast<std::size_t>(facet[c])]));
            made.emplace_back(corners);
          }
        return made;
      }

      BoundaryFacets                                                                   facets;
      std::vector<dealii::BoundingBox<dim>>                                            boxes; ///< of the facets
      decltype(dealii::pack_rtree_of_indices(std::vector<dealii::BoundingBox<dim>>())) tree;
    };

    /** Divides cells into simplices. */
    template <int dim>
    class Divider
    {
    public:
      Divider(const fem::Solid<dim> &solid, const SolidParticipant<dim> &nodes)
        : participant(nodes)
        , depths(solid, nodes)
        , surface(depths.surface_nodes())
      {
        made.mesh.corners   = dim + 1;
        made.mesh.thickness = dim == 2 ? solid.options().thickness : 1.0;
      }

      bool touches_surface(const Cell &cell) const
      {
        return std::any_of(cell.nodes.begin(), cell.nodes.end(), [this](const std::size_t n) { return on_surface(n); });
      }

      /** @param in_layer whether a cell is divided as well */
      void divide(const Cell &cell, const std::int32_t body, const std::vector<bool> &in_layer)
      {
        element                  = static_cast<std::int32_t>(made.mesh.elements.size());
        bodies::BodyElement &own = made.mesh.elements.emplace_back();
        own.body                 = body;
        own.size = dim == 3 ? std::cbrt(cell.measure * cell.measure) : std::sqrt(cell.measure) * made.mesh.thickness;
        for (const std::size_t node : cell.nodes)
          own.vertices.push_back(vertex({node}));
        for (std::size_t f = 0; f < cell.faces.size(); ++f)
          if (at_surface(cell, f))
            surface_faces.insert(sorted(cell.faces[f]));
        bool whole = cell.nodes.size() == dim + 1 && !all_on_surface(cell.nodes);
        for (std::size_t f = 0; f < cell.faces.size(); ++f)
          whole = whole && !divided(cell, f);
        if (whole)
          {
            add_whole(cell, in_layer);
            return;
          }
        for (std::size_t f = 0; f < cell.faces.size(); ++f)
          for (const auto &part : parts_of(cell, f))
            {
              Corners corners = part;
              corners.push_back(cell.nodes);
              add(corners, at_surface(cell, f) ? 1u << dim : 0u, ends(cell, f, in_layer) ? 1u << dim : 0u);
            }
      }

      BodyLayers result(std::vector<std::string> names)
      {
        made.mesh.bodies = std::move(names);
        return std::move(made);
      }

    private:
      using Corners = std::vector<Carriers>; ///< each the mean of nodes

      bool on_surface(const std::size_t node) const { return surface.count(node) > 0; }
      bool all_on_surface(const Carriers &nodes) const
      {
        return std::all_of(nodes.begin(), nodes.end(), [this](const std::size_t n) { return on_surface(n); });
      }
      bool at_surface(const Cell &cell, const std::size_t face) const { return cell.beyond[face] < 0; }
      bool ends(const Cell &cell, const std::size_t face, const std::vector<bool> &in_layer) const
      {
        return cell.beyond[face] >= 0 && !in_layer[static_cast<std::size_t>(cell.beyond[face])];
      }
      /** Whether a face gets a corner of its own: seen alike from both sides. */
      bool divided(const Cell &cell, const std::size_t face) const
      {
        return cell.faces[face].size() == 4 || (!at_surface(cell, face) && all_on_surface(cell.faces[face]));
      }

      std::vector<Corners> parts_of(const Cell &cell, const std::size_t number) const
      {
        const Carriers &face = cell.faces[number];
        if (!divided(cell, number))
          {
            Corners whole;
            for (const std::size_t node : face)
              whole.push_back({node});
            return {whole};
          }
        std::vector<Corners> parts;
        for (std::size_t k = 0; k < face.size(); ++k)
          if (face.size() == 2)
            parts.push_back({{face[k]}, face});
          else
            parts.push_back({{face[k]}, {face[(k + 1) % face.size()]}, face});
        return parts;
      }

      void add_whole(const Cell &cell, const std::vector<bool> &in_layer)
      {
        unsigned int at_side = 0, inward = 0;
        for (std::size_t f = 0; f < cell.faces.size(); ++f)
          for (unsigned int c = 0; c <= dim; ++c)
            if (std::find(cell.faces[f].begin(), cell.faces[f].end(), cell.nodes[c]) == cell.faces[f].end())
              {
                at_side |= at_surface(cell, f) ? 1u << c : 0u;
                inward |= ends(cell, f, in_layer) ? 1u << c : 0u;
              }
        Corners corners;
        for (const std::size_t node : cell.nodes)
          corners.push_back({node});
        add(corners, at_side, inward);
      }

      void add(const Corners &corners, const unsigned int at_side, const unsigned int inward)
      {
        bodies::BodySimplex simplex;
        simplex.element = element;
        simplex.surface = static_cast<std::uint8_t>(at_side);
        simplex.inward  = static_cast<std::uint8_t>(inward);
        for (std::size_t c = 0; c < corners.size(); ++c)
          simplex.vertex[c] = vertex(corners[c]);
        if (made.mesh.at(simplex).volume() < 0) // sides keep their numbers but for the two corners
          {
            std::swap(simplex.vertex[0], simplex.vertex[1]);
            simplex.surface = swapped(simplex.surface);
            simplex.inward  = swapped(simplex.inward);
          }
        made.mesh.simplices.push_back(simplex);
      }

      static std::uint8_t swapped(const std::uint8_t bits)
      {
        return static_cast<std::uint8_t>((bits & ~3u) | (bits & 1u) << 1 | (bits & 2u) >> 1);
      }

      static Carriers sorted(Carriers nodes)
      {
        std::sort(nodes.begin(), nodes.end());
        return nodes;
      }

      std::int32_t vertex(const Carriers &mean_of)
      {
        const Carriers parents  = sorted(mean_of);
        const auto [at, is_new] = numbers.emplace(parents, static_cast<std::int32_t>(numbers.size()));
        if (!is_new)
          return at->second;
        Vector3d place = Vector3d::Zero();
        for (const std::size_t node : parents)
          place += participant.position(node) / static_cast<double>(parents.size());
        made.mesh.place.push_back(place);
        // The middle of a face on the surface lies on it, however warped the face is.
        const bool outside = parents.size() == 1 ? on_surface(parents.front()) : surface_faces.count(parents) > 0;
        made.mesh.depth.push_back(outside ? 0.0 : depths.at(place));
        made.parents.push_back(parents);
        return at->second;
      }

      const SolidParticipant<dim>     &participant;
      Depths<dim>                      depths;
      std::set<std::size_t>            surface;
      std::set<Carriers>               surface_faces; ///< of the cells divided so far; nodes ascending
      std::map<Carriers, std::int32_t> numbers;
      std::int32_t                     element = 0;
      BodyLayers                       made;
    };

    /** A name for each body: its material's, and a number where several have that. */
    template <int dim>
    std::vector<std::string> names_of(const fem::Solid<dim> &solid, const std::vector<Cell> &cells, std::size_t bodies)
    {
      std::vector<std::string> names(bodies);
      for (const Cell &cell : cells)
        if (names[cell.body].empty())
          for (const auto &[name, id] : solid.mesh().materials)
            if (static_cast<int>(id) == cell.material)
              names[cell.body] = name;
      return names;
    }

    std::vector<std::string> numbered(const std::vector<std::string> &names)
    {
      std::vector<std::string>   made;
      std::map<std::string, int> next;
      for (const std::string &name : names)
        made.push_back(std::count(names.begin(), names.end(), name) > 1 ? name + " " + std::to_string(++next[name]) :
                                                                          name);
      return made;
    }

    void refuse_unknown(const std::vector<std::string> &wanted, const std::vector<std::string> &materials)
    {
      for (const std::string &name : wanted)
        if (std::find(materials.begin(), materials.end(), name) == materials.end())
          {
            std::string known;
            for (const std::string &each : std::set<std::string>(materials.begin(), materials.end()))
              known += (known.empty() ? "" : ", ") + each;
            throw base::InputError("contact of bodies: no body is of a material " + name + ". There are: " + known +
                                   ".");
          }
    }
  } // namespace

  template <int dim>
  BodyLayers body_layers(const fem::Solid<dim>          &solid,
                         const SolidParticipant<dim>    &participant,
                         const std::vector<std::string> &names)
  {
    std::vector<Cell>            cells  = cells_of(solid, participant);
    const std::vector<SolidPart> parts  = solid_parts(solid, participant);
    const std::size_t            bodies = parts.size();
    for (std::size_t b = 0; b < bodies; ++b)
      for (const unsigned int cell : parts[b].cells)
        cells[cell].body = b;
    const std::vector<std::string> materials = names_of(solid, cells, bodies), all = numbered(materials);
    refuse_unknown(names, materials);
    std::vector<std::int32_t> number(bodies, -1); // among those wanted
    std::vector<std::string>  kept;
    for (std::size_t b = 0; b < bodies; ++b)
      if (names.empty() || std::find(names.begin(), names.end(), materials[b]) != names.end())
        {
          number[b] = static_cast<std::int32_t>(kept.size());
          kept.push_back(all[b]);
        }
    Divider<dim>      divider(solid, participant);
    std::vector<bool> in_layer;
    for (const Cell &cell : cells)
      in_layer.push_back(divider.touches_surface(cell));
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (in_layer[c] && number[cells[c].body] >= 0)
        divider.divide(cells[c], number[cells[c].body], in_layer);
    return divider.result(kept);
  }

  template BodyLayers
  body_layers<2>(const fem::Solid<2> &, const SolidParticipant<2> &, const std::vector<std::string> &);
  template BodyLayers
  body_layers<3>(const fem::Solid<3> &, const SolidParticipant<3> &, const std::vector<std::string> &);
} // namespace coupling
