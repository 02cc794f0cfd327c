#include "apps/drivers/continuum_picture.h"

#include "apps/mpi_session.h"
#include "postprocess/field_picture.h"

#include <deal.II/base/mpi.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace apps
{
  namespace
  {
    /** A facet as plain numbers, to be sent: x, y, u, v of four corners, and the value. */
    constexpr std::size_t facet_length = 17;

    /** Largest damage of the points of every owned element, by its index. */
    template <int dim>
    std::map<unsigned int, double> damage_of_elements(fem::Solid<dim> &solid, const fem::Vector &displacement)
    {
      std::map<unsigned int, double> damage;
      solid.visit_points(displacement, [&](const fem::PointView<dim> &point) {
        double &largest = damage[point.cell->active_cell_index()];
        point.material->visit(point.index, [&](const char *column, const double *value, const int) {
          if (std::strcmp(column, "damage") == 0)
            largest = std::max(largest, *value);
        });
      });
      return damage;
    }

    /** Corners of a facet, in order around. */
    template <typename Accessor>
    void append_facet(std::vector<double> &facets,
                      const Accessor      &facet,
                      const double         value,
                      const fem::Vector   &displacement)
    {
      static constexpr unsigned int around[4] = {0, 1, 3, 2};
      for (unsigned int i = 0; i < 4; ++i)
        {
          const unsigned int v = facet->n_vertices() == 4 ? around[i] : std::min(i, 2u);
          facets.push_back(facet->vertex(v)[0]);
          facets.push_back(facet->vertex(v)[1]);
          for (unsigned int c = 0; c < 2; ++c)
            facets.push_back(displacement[facet->vertex_dof_index(v, c)]);
        }
      facets.push_back(value);
    }

    template <int dim, typename Face>
    bool looks_along_z(const Face &face)
    {
      if constexpr (dim == 3)
        {
          const dealii::Tensor<1, 3> n =
            cross_product_3d(face->vertex(1) - face->vertex(0), face->vertex(2) - face->vertex(0));
          return std::fabs(n[2]) > 0.7 * n.norm();
        }
      return false;
    }

    template <int dim>
    std::vector<double> facets_of(fem::Solid<dim> &solid, const fem::Vector &displacement)
    {
      const auto          damage = damage_of_elements(solid, displacement);
      std::vector<double> facets;
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          if (!cell->is_locally_owned())
            continue;
          const double value = damage.at(cell->active_cell_index());
          if constexpr (dim == 2)
            append_facet(facets, cell, value, displacement);
          else
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary() && looks_along_z<dim>(cell->face(f)) &&
                  cell->face(f)->center()[2] > cell->center()[2])
                append_facet(facets, cell->face(f), value, displacement);
        }
      return facets;
    }

    /** So that the largest displacement shows as a twentieth of the extent; a round number. */
    double magnification(const std::vector<double> &facets)
    {
      double low = 1e300, high = -1e300, most = 0;
      for (std::size_t i = 0; i < facets.size(); i += facet_length)
        for (std::size_t c = 0; c < 16; c += 4)
          {
            low  = std::min({low, facets[i + c]});
            high = std::max({high, facets[i + c]});
            most = std::max(most, std::hypot(facets[i + c + 2], facets[i + c + 3]));
          }
      if (!(most > 0))
        return 1;
      const double wished = 0.05 * (high - low) / most, decade = std::pow(10, std::floor(std::log10(wished)));
      return wished < 1 ? 1 : std::floor(wished / decade) * decade;
    }
  } // namespace

  template <int dim>
  std::string draw_damage(fem::Solid<dim>             &solid,
                          const fem::Vector           &displacement,
                          const std::filesystem::path &file,
                          const std::string           &title)
  {
    if (solid.linear())
      return "";
    std::vector<double> all;
    for (const auto &part : dealii::Utilities::MPI::gather(solid.communicator(), facets_of(solid, displacement)))
      all.insert(all.end(), part.begin(), part.end());
    if (!is_first_rank())
      return "";
    const double                           magnify = magnification(all);
    std::vector<postprocess::PictureFacet> facets(all.size() / facet_length);
    for (std::size_t i = 0; i < facets.size(); ++i)
      {
        const double *numbers = &all[i * facet_length];
        for (std::size_t c = 0; c < 4; ++c)
          facets[i].corner[c] = {numbers[4 * c] + magnify * numbers[4 * c + 2],
                                 numbers[4 * c + 1] + magnify * numbers[4 * c + 3]};
        facets[i].value = numbers[16];
      }
    postprocess::FieldPicture what;
    what.title = fmt::format("{}: damage, displacements x {}", title, magnify);
    what.label = "Damage";
    return postprocess::picture_of_field(file, facets, what);
  }

  template std::string
  draw_damage(fem::Solid<2> &, const fem::Vector &, const std::filesystem::path &, const std::string &);
  template std::string
  draw_damage(fem::Solid<3> &, const fem::Vector &, const std::filesystem::path &, const std::string &);
} // namespace apps
