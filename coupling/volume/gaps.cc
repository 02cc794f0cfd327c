#include "coupling/volume/gaps.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <Eigen/Geometry>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    /** Over the longest bond of a particle: how far it is from places that it fills. Beyond half of it and the radius the packing has a hole. */
    constexpr double holes_of_a_packing = 1.5;

    /** Particles, each as large as its bonds are long, found by place. */
    class Filling
    {
    public:
      Filling(const BondedParticles &all, const Overlap &overlap)
        : particles(all)
        , reach(all.centre.size(), 0)
      {
        for (const Bond &bond : all.bonds)
          for (const std::size_t end : {bond.first, bond.second})
            reach[end] = std::max(reach[end], holes_of_a_packing * bond.length);
        leave_out_detached(overlap);
        size              = *std::max_element(reach.begin(), reach.end());
        double      sum   = 0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < reach.size(); ++i)
          if (reach[i] > 0)
            {
              boxes[box_of(all.centre[i])].push_back(i);
              sum += reach[i] / holes_of_a_packing;
              ++count;
            }
        longest = count > 0 ? sum / static_cast<double>(count) : 0.0;
      }

      bool   empty() const { return boxes.empty(); }
      double mean_bond() const { return longest; } ///< the longest of each particle [m]

      bool holds(const Vector3d &place) const
      {
        const Box at = box_of(place);
        for (std::int64_t k = 0; k < 27; ++k)
          if (const auto box = boxes.find({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
              box != boxes.end() && std::any_of(box->second.begin(), box->second.end(), [&](const std::size_t i) {
                return away(i, place) <= reach[i];
              }))
            return true;
        return false;
      }

      /** To the nearest centre, as reach is measured [m]. */
      double distance(const Vector3d &place) const
      {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < reach.size(); ++i)
          if (reach[i] > 0)
            least = std::min(least, away(i, place));
        return least;
      }

    private:
      using Box = std::array<std::int64_t, 3>;

      /** Along the axis on which it is furthest: in the corner of a box, particles end before its faces on three axes at once. */
      double away(const std::size_t i, const Vector3d &place) const
      {
        return (particles.centre[i] - place).lpNorm<Eigen::Infinity>();
      }

      Box box_of(const Vector3d &place) const
      {
        Box box;
        for (std::size_t c = 0; c < 3; ++c)
          box[c] = static_cast<std::int64_t>(std::floor(place[static_cast<Eigen::Index>(c)] / size));
        return box;
      }

      /** Those that no chain of bonds joins to the region hold nothing. */
      void leave_out_detached(const Overlap &overlap)
      {
        std::vector<std::size_t> of(particles.centre.size());
        std::iota(of.begin(), of.end(), std::size_t{0});
        const auto first = [&of](std::size_t i) {
          while (of[i] != i)
            i = of[i] = of[of[i]];
          return i;
        };
        for (const Bond &bond : particles.bonds)
          of[first(bond.first)] = first(bond.second);
        std::vector<bool> in_region(of.size(), false);
        for (std::size_t i = 0; i < of.size(); ++i)
          if (overlap.distance(particles.centre[i]) < 0)
            in_region[first(i)] = true;
        for (std::size_t i = 0; i < of.size(); ++i)
          if (!in_region[first(i)])
            reach[i] = 0;
      }

      const BondedParticles                  &particles;
      std::vector<double>                     reach; ///< 0: holds nothing [m]
      double                                  size = 0, longest = 0;
      std::map<Box, std::vector<std::size_t>> boxes;
    };

    std::string text_of(const Vector3d &place)
    {
      return "(" + base::number_text(place.x()) + ", " + base::number_text(place.y()) + ", " +
             base::number_text(place.z()) + ")";
    }

    template <int dim>
    Vector3d in_space(const dealii::Point<dim> &x)
    {
      return {x[0], x[1], dim == 3 ? x[dim - 1] : 0.0};
    }

    /**
     * Calls look(place) for places all over the elements that come nearer to a region than a distance: no further apart than wanted
     * where that is not much finer than the element.
     */
    template <int dim, typename Look>
    void each_place(
      const fem::Solid<dim> &solid, const Overlap &overlap, const double nearer, const double apart, const Look &look)
    {
      constexpr double finest = 8;
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          if (overlap.distance(in_space(cell->center())) > nearer + cell->diameter())
            continue;
          const double wide  = cell->diameter() / std::sqrt(dim);
          const auto   parts = static_cast<unsigned int>(std::clamp(std::ceil(wide / apart), 1.0, finest));
          const dealii::QIterated<dim> places(dealii::QTrapezoid<1>(), parts);
          for (const auto &point : places.get_points())
            if (cell->reference_cell().contains_point(point, 1e-9))
              look(in_space(solid.mapping().transform_unit_to_real_cell(cell, point)));
        }
    }
  } // namespace

  template <int dim>
  void
  refuse_gaps(const fem::Solid<dim> &solid, const BondedParticles &particles, const VolumeCouplingParameters &coupling)
  {
    if (particles.bonds.empty())
      return;
    const Filling     filling(particles, coupling.overlap);
    const std::string name = "Handshakes/" + coupling.name + ": ";
    if (filling.empty())
      throw base::InputError(name +
                             "no bond joins particles of the overlap to any of the region: is there a packing in it?");
    // Slaves beyond the reach of bonds only ride along.
    const double width = coupling.overlap.width, mean = filling.mean_bond(),
                 last = coupling.method == VolumeMethod::multipliers ? width : std::min(width, mean),
                 from = coupling.method == VolumeMethod::multipliers ? -std::numeric_limits<double>::infinity() : 0.0;
    const double        rounding = 1e-9 * (width + mean);
    Eigen::AlignedBox3d gap;
    double              furthest = 0;
    each_place(solid, coupling.overlap, last, mean, [&](const Vector3d &place) {
      const double d = coupling.overlap.distance(place);
      if (d < from - rounding || d > last + rounding || filling.holds(place))
        return;
      gap.extend(place);
      furthest = std::max(furthest, filling.distance(place));
    });
    if (!gap.isEmpty())
      throw base::InputError(
        name + "between " + text_of(gap.min()) + " and " + text_of(gap.max()) +
        " m elements of the overlap have no particles: places there are up to " + base::number_text(furthest) +
        " m from the nearest that bonds join to the region. Let the packing fill the region and its "
        "overlap, or move the region to where particles are.");
  }

  template void refuse_gaps(const fem::Solid<2> &, const BondedParticles &, const VolumeCouplingParameters &);
  template void refuse_gaps(const fem::Solid<3> &, const BondedParticles &, const VolumeCouplingParameters &);
} // namespace coupling
