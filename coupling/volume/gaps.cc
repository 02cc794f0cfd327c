#include "coupling/volume/gaps.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "fem/mesh/point_in_space.h"

#include <Eigen/Geometry>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

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
        find_pieces();
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
              box != boxes.end() && std::any_of(box->second.begin(), box->second.end(),
                                                [&](const std::size_t i) { return away(i, place) <= reach[i]; }))
            return true;
        return false;
      }

      /** Call use(particle) for those whose centre lies in a box. */
      template <typename Use>
      void each_in(const Eigen::AlignedBox3d &where, const Use &use) const
      {
        const Box low = box_of(where.min()), high = box_of(where.max());
        for (Box at = low; at[0] <= high[0]; ++at[0])
          for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
            for (at[2] = low[2]; at[2] <= high[2]; ++at[2])
              if (const auto box = boxes.find(at); box != boxes.end())
                for (const std::size_t i : box->second)
                  if (where.contains(particles.centre[i]))
                    use(i);
      }

      const Vector3d &centre(const std::size_t i) const { return particles.centre[i]; }
      /** The chain of bonds that a particle belongs to: the number of one of its particles. */
      std::size_t piece_of(const std::size_t i) const { return piece[i]; }

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

      void find_pieces()
      {
        piece.resize(particles.centre.size());
        std::iota(piece.begin(), piece.end(), std::size_t{0});
        const auto first = [this](std::size_t i) {
          while (piece[i] != i)
            i = piece[i] = piece[piece[i]];
          return i;
        };
        for (const Bond &bond : particles.bonds)
          piece[first(bond.first)] = first(bond.second);
        for (std::size_t i = 0; i < piece.size(); ++i)
          piece[i] = first(i);
      }

      /** Those that no chain of bonds joins to the region hold nothing. */
      void leave_out_detached(const Overlap &overlap)
      {
        std::vector<bool> in_region(piece.size(), false);
        for (std::size_t i = 0; i < piece.size(); ++i)
          if (overlap.distance(particles.centre[i]) < 0)
            in_region[piece[i]] = true;
        for (std::size_t i = 0; i < piece.size(); ++i)
          if (!in_region[piece[i]])
            reach[i] = 0;
      }

      const BondedParticles                  &particles;
      std::vector<double>                     reach; ///< 0: holds nothing [m]
      std::vector<std::size_t>                piece;
      double                                  size = 0, longest = 0;
      std::map<Box, std::vector<std::size_t>> boxes;
    };

    std::string text_of(const Vector3d &place)
    {
      return "(" + base::number_text(place.x()) + ", " + base::number_text(place.y()) + ", " +
             base::number_text(place.z()) + ")";
    }

    /**
     * Calls visit(place) for places all over the elements that come nearer to a region than a distance: no further apart than wanted
     * where that is not much finer than the element.
     */
    template <int dim, typename Visit>
    void each_place(
      const fem::Solid<dim> &solid, const Overlap &overlap, const double nearer, const double apart, const Visit &visit)
    {
      constexpr double finest = 8;
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          if (overlap.distance(fem::in_space(cell->center())) > nearer + cell->diameter())
            continue;
          const double wide  = cell->diameter() / std::sqrt(dim);
          const auto   parts = static_cast<unsigned int>(std::clamp(std::ceil(wide / apart), 1.0, finest));
          const dealii::QIterated<dim> places(dealii::QTrapezoid<1>(), parts);
          for (const auto &point : places.get_points())
            if (cell->reference_cell().contains_point(point, 1e-9))
              visit(fem::in_space(solid.mapping().transform_unit_to_real_cell(cell, point)));
        }
    }
    /** Where places that should have particles have none. */
    struct Gap
    {
      Eigen::AlignedBox3d around;
      double              furthest = 0; ///< from a particle that bonds join to the region [m]

      void add(const Vector3d &place, const Filling &filling)
      {
        around.extend(place);
        furthest = std::max(furthest, filling.distance(place));
      }
      std::string text() const { return "between " + text_of(around.min()) + " and " + text_of(around.max()) + " m "; }
    };

    /** Places all over a box, no further apart than wanted where that is not much finer than the box. */
    std::vector<Vector3d> places_in(const Eigen::AlignedBox3d &box, const double apart)
    {
      constexpr double      finest = 8;
      std::array<int, 3>    parts;
      std::vector<Vector3d> places;
      for (std::size_t c = 0; c < 3; ++c)
        parts[c] = static_cast<int>(std::min(std::ceil(box.sizes()[static_cast<Eigen::Index>(c)] / apart), finest));
      const auto at = [&](const Eigen::Index c, const int k) {
        return box.min()[c] + box.sizes()[c] * k / std::max(parts[static_cast<std::size_t>(c)], 1);
      };
      for (int i = 0; i <= parts[0]; ++i)
        for (int j = 0; j <= parts[1]; ++j)
          for (int k = 0; k <= parts[2]; ++k)
            places.emplace_back(at(0, i), at(1, j), at(2, k));
      return places;
    }

    /** Refuse elements of the region in which there is not one particle. */
    void refuse_holes(const Filling &filling, const VolumeCouplingParameters &coupling, const std::string &name)
    {
      Gap gap;
      for (const Eigen::AlignedBox3d &element : coupling.taken)
        {
          std::vector<Vector3d> places = places_in(element, filling.mean_bond());
          if (coupling.empty)
            places.erase(std::remove_if(places.begin(), places.end(), coupling.empty), places.end());
          if (std::none_of(places.begin(), places.end(), [&](const Vector3d &place) { return filling.holds(place); }))
            for (const Vector3d &place : places)
              gap.add(place, filling);
        }
      if (!gap.around.isEmpty())
        throw base::InputError(
          name + gap.text() +
          "the region has taken the place of elements and there are no particles: places there are up to " +
          base::number_text(gap.furthest) +
          " m from the nearest. Let the packing fill the region, end the region where particles "
          "do, or leave these elements out of the mesh.");
    }

    /** Of each particle: whether it is of the body, in its region or overlap, and belongs to a piece large enough to be a side of that. */
    std::vector<char>
    on_a_side(const BondedParticles &particles, const Filling &filling, const VolumeCouplingParameters &coupling)
    {
      constexpr double         least = 0.05; // of the particles there: smaller ones are crumbs of a random packing
      const std::size_t        all   = particles.centre.size();
      std::vector<std::size_t> count(all, 0);
      std::vector<char>        found(all, 0);
      for (const Eigen::AlignedBox3d &element : coupling.taken)
        filling.each_in(element, [&](const std::size_t i) { found[i] = 1; });
      for (std::size_t i = 0; i < all; ++i)
        if (found[i] != 0 || coupling.overlap.contains(particles.centre[i]))
          {
            found[i] = 1;
            ++count[filling.piece_of(i)];
          }
      const auto there = static_cast<double>(std::accumulate(count.begin(), count.end(), std::size_t{0}));
      for (std::size_t i = 0; i < all; ++i)
        if (static_cast<double>(count[filling.piece_of(i)]) <= least * there)
          found[i] = 0;
      return found;
    }

    /** Particles of two sides that are nearest to each other. */
    struct Across
    {
      std::size_t from = 0, to = 0;
      double      apart = std::numeric_limits<double>::infinity(); ///< [m]; infinite: there are not two sides

      void visit(const std::vector<std::size_t> &one, const std::vector<std::size_t> &other, const Filling &filling)
      {
        for (const std::size_t i : one)
          for (const std::size_t j : other)
            if (const double d = (filling.centre(i) - filling.centre(j)).norm();
                filling.piece_of(i) != filling.piece_of(j) && d < apart)
              {
                from  = i;
                to    = j;
                apart = d;
              }
      }
    };

    /** Refuse pieces that no bond joins in one element, or in two that touch: a cut through the body. */
    void refuse_cuts(const BondedParticles          &particles,
                     const Filling                  &filling,
                     const VolumeCouplingParameters &coupling,
                     const std::string              &name)
    {
      const std::vector<char>          is_side  = on_a_side(particles, filling, coupling);
      std::vector<Eigen::AlignedBox3d> elements = coupling.taken;
      std::sort(elements.begin(), elements.end(),
                [](const Eigen::AlignedBox3d &a, const Eigen::AlignedBox3d &b) { return a.min().x() < b.min().x(); });
      std::vector<std::vector<std::size_t>> members(elements.size());
      std::vector<std::set<std::size_t>>    pieces(elements.size());
      const double                          rounding = 1e-9 * filling.mean_bond();
      Across                                gap;
      for (std::size_t e = 0; e < elements.size(); ++e)
        {
          elements[e].min().array() -= rounding;
          elements[e].max().array() += rounding;
          const auto enter = [&](const std::size_t i) {
            if (is_side[i] == 0)
              return;
            members[e].push_back(i);
            pieces[e].insert(filling.piece_of(i));
          };
          filling.each_in(elements[e], enter);
          if (members[e].empty()) // the gap itself
            {
              const Vector3d beside = Vector3d::Constant(filling.mean_bond());
              filling.each_in({elements[e].min() - beside, elements[e].max() + beside}, enter);
            }
        }
      for (std::size_t e = 0; e < elements.size(); ++e)
        for (std::size_t f = e; f < elements.size() && elements[f].min().x() <= elements[e].max().x(); ++f)
          if (elements[e].intersects(elements[f]) && (pieces[e] != pieces[f] || pieces[e].size() > 1))
            gap.visit(members[e], members[f], filling);
      if (std::isfinite(gap.apart))
        throw base::InputError(
          name + "no bond joins the particles of the region across a gap of " + base::number_text(gap.apart) +
          " m between the centres " + text_of(filling.centre(gap.from)) + " and " + text_of(filling.centre(gap.to)) +
          " m: the body would be cut in two. Let the packing fill the region, or raise Interaction ratio.");
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
    // Constrained particles beyond the reach of bonds only ride along.
    const double width = coupling.overlap.width, mean = filling.mean_bond(),
                 last = coupling.method == VolumeMethod::multipliers ? width : std::min(width, mean),
                 from = coupling.method == VolumeMethod::multipliers ? -std::numeric_limits<double>::infinity() : 0.0;
    const double rounding = 1e-9 * (width + mean);
    Gap          gap;
    each_place(solid, coupling.overlap, last, mean, [&](const Vector3d &place) {
      const double d = coupling.overlap.distance(place);
      if (d < from - rounding || d > last + rounding || filling.holds(place))
        return;
      gap.add(place, filling);
    });
    if (!gap.around.isEmpty())
      throw base::InputError(
        name + gap.text() + "elements of the overlap have no particles: places there are up to " +
        base::number_text(gap.furthest) +
        " m from the nearest that bonds join to the region. Let the packing fill the region and its "
        "overlap, or move the region to where particles are.");
    refuse_holes(filling, coupling, name);
    refuse_cuts(particles, filling, coupling, name);
  }

  template void refuse_gaps(const fem::Solid<2> &, const BondedParticles &, const VolumeCouplingParameters &);
  template void refuse_gaps(const fem::Solid<3> &, const BondedParticles &, const VolumeCouplingParameters &);
} // namespace coupling
