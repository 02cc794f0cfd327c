#include "coupling/volume/mesh_elements.h"

#include "base/errors.h"
#include "dem/facets/facet_mesh.h"
#include "fem/mesh/point_in_space.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    /** A face between a group and the others. */
    struct InterfaceFacet
    {
      std::array<Vector3d, 3> corner; ///< in the plane the first two
      Vector3d                normal; ///< away from the group, unit
    };

    Vector3d across(const std::array<Vector3d, 3> &corner, const int dimension, const Vector3d &from_inside)
    {
      const Vector3d along  = corner[1] - corner[0];
      const Vector3d normal = dimension == 2 ? Vector3d(along.y(), -along.x(), 0) : along.cross(corner[2] - corner[0]);
      return (normal.dot(from_inside) < 0 ? -1 : 1) * normal.normalized();
    }

    /** Signed by the facet that is seen most squarely of those that are nearest. */
    double distance_from_facets(const std::vector<InterfaceFacet> &facets, const int dimension, const Vector3d &place)
    {
      double nearest = std::numeric_limits<double>::infinity(), squarely = -1, side = 1;
      for (const InterfaceFacet &facet : facets)
        {
          const Vector3d from = place - (dimension == 2 ? dem::closest_on_segment(facet.corner, place) :
                                                          dem::closest_on_triangle(facet.corner, place))
                                          .place;
          const double distance = from.norm(), off = facet.normal.dot(from);
          // At an edge that facets share, the one that is seen most squarely decides the side.
          constexpr double rounding = 1e-9;
          const bool       nearer   = distance < (1 - rounding) * nearest;
          if (nearer || (distance <= (1 + rounding) * nearest && std::fabs(off) > squarely))
            {
              nearest  = nearer ? distance : nearest;
              squarely = std::fabs(off);
              side     = off < 0 ? -1 : 1;
            }
        }
      return side * nearest;
    }

    template <int dim>
    class ElementsOf : public MeshElements
    {
    public:
      explicit ElementsOf(fem::Mesh<dim> given)
        : mesh(std::move(given))
        , centres(mesh.triangulation->n_active_cells())
      {
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          centres[cell->active_cell_index()] = fem::in_space(cell->center());
      }

      std::vector<std::string> groups() const override
      {
        std::vector<std::string> names;
        for (const auto &[name, number] : mesh.materials)
          names.push_back(name);
        return names;
      }

      Set of_group(const std::string &group) const override
      {
        const auto found = mesh.materials.find(group);
        if (found == mesh.materials.end())
          throw base::InputError("the mesh has no group of elements \"" + group + "\".");
        return those([&](const auto &cell) { return cell->material_id() == found->second; });
      }

      Set within(const std::function<bool(const Vector3d &)> &is_such) const override
      {
        return those([&](const auto &cell) {
          const auto corners = cell->vertex_indices();
          return std::all_of(corners.begin(), corners.end(),
                             [&](const unsigned int v) { return is_such(fem::in_space(cell->vertex(v))); });
        });
      }

      Set filled(const Set &elements) const override
      {
        std::set<unsigned int> corners;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          if (elements.count(cell->active_cell_index()) != 0)
            for (const unsigned int v : cell->vertex_indices())
              corners.insert(cell->vertex_index(v));
        return those([&](const auto &cell) {
          const auto own = cell->vertex_indices();
          return std::all_of(own.begin(), own.end(),
                             [&](const unsigned int v) { return corners.count(cell->vertex_index(v)) != 0; });
        });
      }

      Set around(const std::vector<Vector3d> &places, const double distance) const override
      {
        constexpr double      rounding = 1e-6;
        const Set             at_them  = near(places, rounding * distance);
        std::vector<Vector3d> corners;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          if (at_them.count(cell->active_cell_index()) != 0)
            for (const unsigned int v : cell->vertex_indices())
              corners.push_back(fem::in_space(cell->vertex(v)));
        Set found = near(corners, (1 - rounding) * distance);
        found.insert(at_them.begin(), at_them.end());
        return found;
      }

      std::vector<Eigen::AlignedBox3d> boxes_of(const Set &elements) const override
      {
        std::vector<Eigen::AlignedBox3d> boxes;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          if (elements.count(cell->active_cell_index()) != 0)
            {
              boxes.emplace_back();
              for (const unsigned int v : cell->vertex_indices())
                boxes.back().extend(fem::in_space(cell->vertex(v)));
            }
        return boxes;
      }

      Vector3d centre_of(const unsigned int element) const override { return centres.at(element); }

      unsigned int with_centre(const Vector3d &place) const override
      {
        const auto nearest =
          std::min_element(centres.begin(), centres.end(), [&](const Vector3d &a, const Vector3d &b) {
            return (a - place).squaredNorm() < (b - place).squaredNorm();
          });
        return static_cast<unsigned int>(nearest - centres.begin());
      }

      std::function<double(const Vector3d &)> distance_from(const Set &elements, const std::string &name) const override
      {
        const auto facets = std::make_shared<const std::vector<InterfaceFacet>>(interface_of(elements));
        if (facets->empty())
          throw base::InputError("Handshakes: the elements of \"" + name +
                                 "\" share no face with others: particles there would touch no solid.");
        return [facets](const Vector3d &place) { return distance_from_facets(*facets, dim, place); };
      }

    private:
      Set near(const std::vector<Vector3d> &places, const double distance) const
      {
        return those([&](const auto &cell) {
          for (const unsigned int v : cell->vertex_indices())
            for (const Vector3d &place : places)
              if ((fem::in_space(cell->vertex(v)) - place).norm() < distance)
                return true;
          return false;
        });
      }

      template <typename Predicate>
      Set those(const Predicate &is_such) const
      {
        Set found;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          if (is_such(cell))
            found.insert(cell->active_cell_index());
        return found;
      }

      std::vector<InterfaceFacet> interface_of(const Set &elements) const
      {
        std::vector<InterfaceFacet> facets;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          if (elements.count(cell->active_cell_index()) != 0)
            for (const auto f : cell->face_indices())
              {
                if (cell->at_boundary(f) || elements.count(cell->neighbor(f)->active_cell_index()) != 0)
                  continue;
                const auto     face    = cell->face(f);
                const Vector3d outward = fem::in_space(face->center()) - fem::in_space(cell->center());
                const auto     corner  = [&](const unsigned int v) { return fem::in_space(face->vertex(v)); };
                const auto     add     = [&](const std::array<Vector3d, 3> &of) {
                  facets.push_back({of, across(of, dim, outward)});
                };
                if (dim == 2)
                  add({corner(0), corner(1), corner(1)});
                else
                  add({corner(0), corner(1), corner(2)});
                if (dim == 3 && face->n_vertices() == 4)
                  add({corner(1), corner(3), corner(2)});
              }
        return facets;
      }

      fem::Mesh<dim>        mesh;
      std::vector<Vector3d> centres;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<MeshElements> elements_of(fem::Mesh<dim> mesh)
  {
    return std::make_unique<ElementsOf<dim>>(std::move(mesh));
  }

  template std::unique_ptr<MeshElements> elements_of<2>(fem::Mesh<2>);
  template std::unique_ptr<MeshElements> elements_of<3>(fem::Mesh<3>);
} // namespace coupling
