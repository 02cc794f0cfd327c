#include "apps/runs/continuum/picture_facets.h"

#include "postprocess/pictures/picture_axes.h"

#include <deal.II/base/mpi.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace apps
{
  namespace
  {
    template <typename Cell>
    FacetCorner
    corner_of(const Cell &cell, const unsigned int vertex, const fem::Vector &displacement, const PicturePlane &plane)
    {
      return {cell->vertex(vertex)[plane.right], cell->vertex(vertex)[plane.up],
              displacement[cell->vertex_dof_index(vertex, plane.right)],
              displacement[cell->vertex_dof_index(vertex, plane.up)]};
    }

    /** All of a plane element. */
    template <typename Cell>
    std::vector<FacetCorner> outline_of(const Cell         &cell,
                                        const fem::Vector  &displacement,
                                        const PicturePlane &plane,
                                        std::integral_constant<int, 2>)
    {
      static constexpr unsigned int around[4] = {0, 1, 3, 2};
      std::vector<FacetCorner>      corners;
      for (unsigned int i = 0; i < cell->n_vertices(); ++i)
        corners.push_back(corner_of(cell, cell->n_vertices() == 4 ? around[i] : i, displacement, plane));
      return corners;
    }

    /** The section of the plane with a solid element; nothing where they do not meet. */
    template <typename Cell>
    std::vector<FacetCorner> outline_of(const Cell         &cell,
                                        const fem::Vector  &displacement,
                                        const PicturePlane &plane,
                                        std::integral_constant<int, 3>)
    {
      const bool               is_simplex = cell->n_vertices() == 4;
      std::vector<FacetCorner> corners;
      FacetCorner              centre = {};
      for (unsigned int v = 0; v < cell->n_vertices(); ++v)
        for (unsigned int w = v + 1; w < cell->n_vertices(); ++w)
          {
            const unsigned int differ  = v ^ w;
            const bool         is_edge = is_simplex || (differ & (differ - 1)) == 0; // corners of a cube: one bit apart
            const double       from    = cell->vertex(v)[plane.across] - plane.position,
                         to            = cell->vertex(w)[plane.across] - plane.position;
            if (!is_edge || (from >= 0) == (to >= 0))
              continue;
            const double      part  = from / (from - to);
            const FacetCorner one   = corner_of(cell, v, displacement, plane),
                              other = corner_of(cell, w, displacement, plane);
            corners.emplace_back();
            for (std::size_t i = 0; i < 4; ++i)
              centre[i] += corners.back()[i] = one[i] + part * (other[i] - one[i]);
          }
      for (double &c : centre)
        c /= static_cast<double>(corners.size());
      const auto angle = [&](const FacetCorner &c) { return std::atan2(c[1] - centre[1], c[0] - centre[0]); };
      std::sort(corners.begin(), corners.end(), [&](const auto &p, const auto &q) { return angle(p) < angle(q); });
      return corners;
    }

    /** Extents along the axes, of the mesh and of its displacement, over all ranks. */
    template <int dim>
    struct Extents
    {
      std::array<double, dim> low, high, displacement;

      Extents(const fem::Solid<dim> &solid, const fem::Vector &u)
      {
        std::array<double, dim> least, most;
        low.fill(1e300), least.fill(1e300), high.fill(-1e300), most.fill(-1e300);
        for (const auto &cell : solid.dofs().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              for (unsigned int c = 0; c < dim; ++c)
                {
                  const double x = cell->vertex(v)[c], moved = u[cell->vertex_dof_index(v, c)];
                  low[c]   = std::min(low[c], x);
                  high[c]  = std::max(high[c], x);
                  least[c] = std::min(least[c], moved);
                  most[c]  = std::max(most[c], moved);
                }
        const MPI_Comm comm = solid.communicator();
        for (unsigned int c = 0; c < dim; ++c)
          {
            low[c]          = dealii::Utilities::MPI::min(low[c], comm);
            high[c]         = dealii::Utilities::MPI::max(high[c], comm);
            displacement[c] = dealii::Utilities::MPI::max(most[c], comm) - dealii::Utilities::MPI::min(least[c], comm);
          }
      }
      double of(const unsigned int c) const { return high[c] - low[c]; }
    };

    /** Where along an axis most of a quantity is: the middle of the slice that holds most of it, the most central of equals. */
    template <int dim>
    double position_of_most(const fem::Solid<dim>                &solid,
                            const std::map<unsigned int, double> &of_elements,
                            const Extents<dim>                   &extents,
                            const unsigned int                    axis)
    {
      constexpr int       slices = 41; // odd: one is the middle
      const double        width  = extents.of(axis) / slices;
      std::vector<double> sums(slices, 0.0);
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          if (!cell->is_locally_owned())
            continue;
          double from = 1e300, to = -1e300;
          for (const unsigned int v : cell->vertex_indices())
            {
              from = std::min(from, cell->vertex(v)[axis]);
              to   = std::max(to, cell->vertex(v)[axis]);
            }
          const double section = of_elements.at(cell->active_cell_index()) * cell->measure() / (to - from);
          for (int s = 0; s < slices; ++s)
            if (const double at = extents.low[axis] + (s + 0.5) * width; at >= from && at < to)
              sums[static_cast<std::size_t>(s)] += section;
        }
      dealii::Utilities::MPI::sum(sums, solid.communicator(), sums);
      int best = slices / 2;
      for (int distance = 1; distance <= slices / 2; ++distance)
        for (const int s : {slices / 2 - distance, slices / 2 + distance})
          if (sums[static_cast<std::size_t>(s)] > 1.01 * sums[static_cast<std::size_t>(best)])
            best = s;
      return extents.low[axis] + (best + 0.5) * width;
    }
  } // namespace

  void append_polygon(std::vector<double> &facets, const std::vector<FacetCorner> &corners, const double value)
  {
    for (std::size_t i = 1; i + 1 < corners.size(); i += 2)
      {
        for (const std::size_t c : {std::size_t(0), i, i + 1, std::min(i + 2, corners.size() - 1)})
          facets.insert(facets.end(), corners[c].begin(), corners[c].end());
        facets.push_back(value);
      }
  }

  template <int dim>
  PicturePlane plane_of(const fem::Solid<dim>                &solid,
                        const fem::Vector                    &displacement,
                        const std::map<unsigned int, double> &of_elements)
  {
    PicturePlane plane;
    if constexpr (dim == 3)
      {
        const Extents<dim> extents(solid, displacement);
        const auto        &moves = extents.displacement;
        const auto loaded = static_cast<unsigned int>(std::max_element(moves.begin(), moves.end()) - moves.begin());
        const unsigned int one = loaded == 0 ? 1 : 0, other = loaded == 2 ? 1 : 2;
        const unsigned int longer = extents.of(other) > (1 + 1e-9) * extents.of(one) ? other : one;
        plane.across              = 3 - loaded - longer;
        plane.right               = std::min(loaded, longer);
        plane.up                  = std::max(loaded, longer);
        plane.position            = position_of_most(solid, of_elements, extents, plane.across);
      }
    return plane;
  }

  template <int dim>
  std::vector<double> facets_of(const fem::Solid<dim>                &solid,
                                const fem::Vector                    &displacement,
                                const std::map<unsigned int, double> &of_elements,
                                const PicturePlane                   &plane)
  {
    std::vector<double> facets;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        append_polygon(facets, outline_of(cell, displacement, plane, std::integral_constant<int, dim>()),
                       of_elements.at(cell->active_cell_index()));
    return facets;
  }

  std::vector<double> of_all_ranks(const std::vector<double> &mine, const MPI_Comm communicator)
  {
    std::vector<double> all;
    for (const auto &part : dealii::Utilities::MPI::all_gather(communicator, mine))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  std::vector<postprocess::PictureFacet> as_facets(const std::vector<double> &all, const double magnify)
  {
    std::vector<postprocess::PictureFacet> facets(all.size() / facet_length);
    for (std::size_t i = 0; i < facets.size(); ++i)
      {
        const double *numbers = &all[i * facet_length];
        for (std::size_t c = 0; c < 4; ++c)
          facets[i].corner[c] = {numbers[4 * c] + magnify * numbers[4 * c + 2],
                                 numbers[4 * c + 1] + magnify * numbers[4 * c + 3]};
        facets[i].value = numbers[16];
      }
    return facets;
  }

  std::string place_of(const PicturePlane &plane, const int dim)
  {
    return dim == 2 ?
             "" :
             fmt::format(", section at {} = {}", "xyz"[plane.across], postprocess::length_text(plane.position));
  }

  double magnification_of(const std::vector<double> &facets)
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
    return postprocess::round_magnification(0.05 * (high - low) / most);
  }

  template PicturePlane plane_of(const fem::Solid<2> &, const fem::Vector &, const std::map<unsigned int, double> &);
  template PicturePlane plane_of(const fem::Solid<3> &, const fem::Vector &, const std::map<unsigned int, double> &);
  template std::vector<double>
  facets_of(const fem::Solid<2> &, const fem::Vector &, const std::map<unsigned int, double> &, const PicturePlane &);
  template std::vector<double>
  facets_of(const fem::Solid<3> &, const fem::Vector &, const std::map<unsigned int, double> &, const PicturePlane &);
} // namespace apps
