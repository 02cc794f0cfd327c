#include "apps/runs/continuum/stress_picture.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/picture_facets.h"
#include "postprocess/pictures/picture_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace apps
{
  namespace
  {
    struct StressUnit
    {
      double      per_pascal;
      const char *name;
    };

    StressUnit stress_unit(const double largest)
    {
      if (largest >= 1e9)
        return {1e-9, "GPa"};
      if (largest >= 1e5)
        return {1e-6, "MPa"};
      return largest >= 1e2 ? StressUnit{1e-3, "kPa"} : StressUnit{1, "Pa"};
    }

    template <int dim>
    std::map<unsigned int, double>
    stress_of_elements(fem::Solid<dim> &solid, const fem::Vector &displacement, const double factor)
    {
      std::map<unsigned int, double> stress;
      solid.visit_points(displacement, [&](const fem::PointView<dim> &point) {
        double &largest = stress[point.cell->active_cell_index()];
        largest         = std::max(largest, factor * fem::mises(point.stress));
      });
      return stress;
    }

    /** Around a place, as large as a fiftieth of what is drawn. */
    postprocess::PictureCircle circle_around(const std::array<double, 3>                  &place,
                                             const PicturePlane                           &plane,
                                             const std::vector<postprocess::PictureFacet> &facets)
    {
      double low = 1e300, high = -1e300;
      for (const postprocess::PictureFacet &facet : facets)
        for (const auto &corner : facet.corner)
          {
            low  = std::min({low, corner[0], corner[1]});
            high = std::max({high, corner[0], corner[1]});
          }
      return {{place[plane.right], place[plane.up]}, 0.02 * (high - low)};
    }
  } // namespace

  template <int dim>
  std::string draw_stress(fem::Solid<dim>             &solid,
                          const fem::Vector           &displacement,
                          const fem::SolidExtremes    &extremes,
                          const std::filesystem::path &file,
                          const std::string           &title)
  {
    if (!(extremes.mises.value > 0))
      return "";
    const StressUnit unit   = stress_unit(extremes.mises.value);
    const auto       stress = stress_of_elements(solid, displacement, unit.per_pascal);
    PicturePlane     plane  = plane_of(solid, displacement, stress);
    if (dim == 3)
      plane.position = extremes.mises.place[plane.across];
    const std::vector<double> all = of_all_ranks(facets_of(solid, displacement, stress, plane), solid.communicator());
    if (!is_first_rank())
      return "";
    const double                                 magnify = magnification_of(all);
    const std::vector<postprocess::PictureFacet> facets  = as_facets(all, magnify);
    postprocess::FieldPicture                    what;
    what.highest = unit.per_pascal * extremes.mises.value;
    what.tick    = postprocess::tick_step(what.highest, 8);
    what.title   = fmt::format("{}: stress, largest in the circle; displacements x {}, largest {}{}", title, magnify,
                               postprocess::length_text(extremes.displacement.value), place_of(plane, dim));
    what.label   = fmt::format("Von Mises stress [{}]", unit.name);
    what.right   = "xyz"[plane.right];
    what.up      = "xyz"[plane.up];
    what.circles = {circle_around(extremes.mises.place, plane, as_facets(all, 0))};
    return postprocess::picture_of_field(file, facets, what);
  }

  template std::string draw_stress(fem::Solid<2> &,
                                   const fem::Vector &,
                                   const fem::SolidExtremes &,
                                   const std::filesystem::path &,
                                   const std::string &);
  template std::string draw_stress(fem::Solid<3> &,
                                   const fem::Vector &,
                                   const fem::SolidExtremes &,
                                   const std::filesystem::path &,
                                   const std::string &);
} // namespace apps
