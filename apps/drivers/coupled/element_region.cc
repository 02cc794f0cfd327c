#include "apps/drivers/coupled/element_region.h"

#include "apps/scene/nearest_name.h"
#include "base/errors.h"
#include "dem/facets/facet_mesh.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace apps
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

    template <int dim>
    Vector3d in_space(const dealii::Point<dim> &place)
    {
      return {place[0], place[1], dim == 3 ? place[dim - 1] : 0.0};
    }

    Vector3d across(const std::array<Vector3d, 3> &corner, const int dimension, const Vector3d &from_inside)
    {
      const Vector3d along  = corner[1] - corner[0];
      const Vector3d normal = dimension == 2 ? Vector3d(along.y(), -along.x(), 0) : along.cross(corner[2] - corner[0]);
      return (normal.dot(from_inside) < 0 ? -1 : 1) * normal.normalized();
    }

    template <int dim>
    std::vector<InterfaceFacet> interface_of(const fem::Mesh<dim> &mesh, const dealii::types::material_id group)
    {
      std::vector<InterfaceFacet> facets;
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        if (cell->material_id() == group)
          for (const auto f : cell->face_indices())
            {
              if (cell->at_boundary(f) || cell->neighbor(f)->material_id() == group)
                continue;
              const auto     face    = cell->face(f);
              const Vector3d outward = in_space<dim>(face->center()) - in_space<dim>(cell->center());
              const auto     corner  = [&](const unsigned int v) { return in_space<dim>(face->vertex(v)); };
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

    template <int dim>
    std::vector<InterfaceFacet> interface_in(const MeshSection &section, const std::string &group)
    {
      const fem::Mesh<dim>     mesh = make_mesh<dim>(section);
      std::vector<std::string> names;
      for (const auto &[name, number] : mesh.materials)
        names.push_back(name);
      const auto found = mesh.materials.find(group);
      if (found == mesh.materials.end())
        throw base::InputError("Handshakes: the mesh has no group of elements \"" + group + "\". " +
                               did_you_mean(group, names));
      const auto facets = interface_of(mesh, found->second);
      if (facets.empty())
        throw base::InputError("Handshakes: the elements of \"" + group +
                               "\" share no face with others: particles there would touch no solid.");
      return facets;
    }
  } // namespace

  std::function<double(const Vector3d &)>
  distance_from_elements(const MeshSection &mesh, const int dimension, const std::string &group)
  {
    const auto facets = std::make_shared<const std::vector<InterfaceFacet>>(
      dimension == 2 ? interface_in<2>(mesh, group) : interface_in<3>(mesh, group));
    return [facets, dimension](const Vector3d &place) {
      double nearest = std::numeric_limits<double>::infinity(), squarely = -1, side = 1;
      for (const InterfaceFacet &facet : *facets)
        {
          const Vector3d from = place - (dimension == 2 ? dem::closest_on_segment(facet.corner, place) :
                                                          dem::closest_on_triangle(facet.corner, place))
                                          .place;
          const double distance = from.norm(), off = facet.normal.dot(from);
          // At an edge that facets share, the one that is seen most squarely tells the side.
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
    };
  }
} // namespace apps
