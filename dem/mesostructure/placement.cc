#include "dem/mesostructure/placement.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15ull; // golden ratio: unlike seeds of neighbouring runs

    void check(const std::vector<double> &diameters, const AggregatePlacement &p)
    {
      const auto refuse = [](const std::string &what, const double value, const std::string &rule) {
        throw base::InputError("Aggregates: " + what + " = " + base::number_text(value) + ": must be " + rule + ".");
      };
      if (!(p.box.minCoeff() > 0))
        refuse("edge of the box", p.box.minCoeff(), "above 0");
      if (!(p.clearance >= 0.001 && p.clearance <= 1))
        refuse("clearance", p.clearance, "in [0.001, 1]");
      if (!(p.distance >= 0))
        refuse("distance", p.distance, "0 or above");
      if (!(p.wall >= 0))
        refuse("distance from faces", p.wall, "0 or above");
      for (const double d : diameters)
        if (!(d > 0 && std::isfinite(d)))
          refuse("diameter", d, "above 0");
    }

    std::shared_ptr<const ConvexShape> shape_of(const AggregateShape &shape, UniformRandom &random)
    {
      switch (shape.kind)
        {
        case AggregateShape::Kind::ellipsoid:
          return ellipsoid(shape.elongation, shape.flatness);
        case AggregateShape::Kind::polyhedron:
          return random_polyhedron(shape.corners, shape.elongation, shape.flatness, random);
        default:
          return unit_sphere();
        }
    }

    /** All aggregates of a box, and whether one may lie where it does. */
    class Places
    {
    public:
      explicit Places(const AggregatePlacement &parameters)
        : p(parameters)
      {
      }

      double gap(const Inclusion &one, const Inclusion &other) const
      {
        return std::max(p.clearance * (one.radius + other.radius), p.distance);
      }

      /** From the centre of the other, or its nearest image, to that of one. */
      Vector3d between(const Inclusion &one, const Inclusion &other) const
      {
        Vector3d apart = one.centre - other.centre;
        if (p.periodic)
          for (int d = 0; d < 3; ++d)
            apart[d] -= p.box[d] * std::round(apart[d] / p.box[d]);
        return apart;
      }

      bool apart(const Inclusion &one, const Inclusion &other) const
      {
        const double wanted = gap(one, other);
        if (!p.periodic)
          return are_apart(one, other, wanted);
        const Vector3d nearest = one.centre - other.centre - between(one, other);
        if (2 * (one.reach() + other.reach() + wanted) <= p.box.minCoeff())
          return are_apart(one, other, wanted, nearest);
        for (int x = -1; x <= 1; ++x)
          for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
              if (!are_apart(one, other, wanted, nearest + p.box.cwiseProduct(Vector3d(x, y, z))))
                return false;
        return true;
      }

      /** Room for the centre of one along each edge: from `low` to `high`; of a periodic box all of it. */
      std::pair<Vector3d, Vector3d> room(const Inclusion &one) const
      {
        Vector3d low = Vector3d::Zero(), high = p.box;
        if (!p.periodic)
          for (int d = 0; d < 3; ++d)
            {
              low[d]  = p.wall + (one.centre - one.furthest(-Vector3d::Unit(d)))[d];
              high[d] = p.box[d] - p.wall - (one.furthest(Vector3d::Unit(d)) - one.centre)[d];
            }
        return {low, high};
      }

      bool inside(const Inclusion &one) const
      {
        const auto [low, high] = room(one);
        return p.periodic || ((one.centre - low).minCoeff() >= 0 && (high - one.centre).minCoeff() >= 0);
      }

    private:
      const AggregatePlacement &p;
    };

    class Placer
    {
    public:
      Placer(const std::vector<double> &sizes, const AggregatePlacement &parameters, const std::uint64_t seed)
        : p(parameters)
        , places(parameters)
        , random(seed)
        , diameters(sizes)
      {
      }

      /** All of them, scaled by a factor, one after the other. */
      bool place(const double scale)
      {
        placed.clear();
        for (const double d : diameters)
          if (!place_one(0.5 * d * scale))
            return false;
        return true;
      }

      /** From placed ones of some scale to the full one. @return the scale that is reached */
      double grow(double scale)
      {
        constexpr int most_attempts = 300;
        double        jump          = 0.02;
        for (int attempt = 0; attempt < most_attempts && scale < 1; ++attempt)
          {
            const std::vector<Inclusion> before = placed;
            const double                 next   = std::min(1.0, scale * (1 + jump));
            set_scale(next);
            if (come_apart())
              {
                scale = next;
                jump  = std::min(1.5 * jump, 0.02);
              }
            else
              {
                placed = before;
                jump   = std::max(0.5 * jump, 2e-3);
              }
            set_scale(scale);
            for (int sweep = 0; sweep < 20; ++sweep)
              stir(0.1);
          }
        return scale;
      }

      std::vector<Inclusion> &result() { return placed; }

    private:
      bool place_one(const double radius)
      {
        Inclusion one;
        one.radius = radius;
        one.shape  = shape_of(p.shape, random);
        for (std::int64_t draw = 0; draw < p.tries; ++draw)
          {
            one.centre.setZero();
            if (!one.shape->is_sphere())
              one.axes = random_rotation(random);
            const auto [low, high] = places.room(one);
            if (!((high - low).minCoeff() >= 0))
              {
                if (one.shape->is_sphere())
                  break;
                continue;
              }
            for (int d = 0; d < 3; ++d)
              one.centre[d] = low[d] + random() * (high[d] - low[d]);
            if (is_free(one, placed.size()))
              {
                placed.push_back(one);
                return true;
              }
          }
        return false;
      }

      /** @param self number of the one that is left out */
      bool is_free(const Inclusion &one, const std::size_t self) const
      {
        for (std::size_t i = 0; i < placed.size(); ++i)
          if (i != self && !places.apart(one, placed[i]))
            return false;
        return true;
      }

      /** Every one moves, and turns, at random, if it may. @param step of the radius */
      void stir(const double step)
      {
        for (std::size_t i = 0; i < placed.size(); ++i)
          {
            Inclusion to = placed[i];
            for (int d = 0; d < 3; ++d)
              to.centre[d] += step * to.radius * (2 * random() - 1);
            if (!to.shape->is_sphere())
              {
                const double angle = step * (2 * random() - 1);
                to.axes = Eigen::AngleAxisd(angle, random_rotation(random).col(0)).toRotationMatrix() * to.axes;
              }
            if (places.inside(to) && is_free(to, i))
              placed[i] = to;
          }
      }

      void set_scale(const double scale)
      {
        for (std::size_t i = 0; i < placed.size(); ++i)
          placed[i].radius = 0.5 * diameters[i] * scale;
      }

      /** Push those that overlap apart, and into the box, until none does. @return false: they still do */
      bool come_apart()
      {
        constexpr int most_sweeps = 60;
        for (int sweep = 0; sweep < most_sweeps; ++sweep)
          {
            bool pushed = false;
            for (std::size_t i = 0; i < placed.size(); ++i)
              for (std::size_t j = 0; j < i; ++j)
                if (!places.apart(placed[i], placed[j]))
                  {
                    push(placed[i], placed[j]);
                    pushed = true;
                  }
            for (Inclusion &one : placed)
              if (!places.inside(one))
                {
                  const auto [low, high] = places.room(one);
                  one.centre             = one.centre.cwiseMax(low).cwiseMin(high);
                  pushed                 = true;
                }
            if (!pushed)
              return true;
          }
        return false;
      }

      /** Along the line of their centres: spheres until they are apart, others by a little; the larger one less. */
      void push(Inclusion &one, Inclusion &other) const
      {
        constexpr double beyond = 1e-4, little = 0.01; // beyond what is needed: so that a chain of pushes ends
        const Vector3d   between = places.between(one, other);
        const double     centres = between.norm(), wanted = one.reach() + other.reach() + places.gap(one, other);
        const Vector3d   away   = centres > 0 ? Vector3d(between / centres) : Vector3d::UnitX();
        const double     share  = other.radius / (one.radius + other.radius);
        const double     way    = wanted - centres + beyond * wanted;
        const double     pushed = one.shape->is_sphere() ? way : std::min(way, little * wanted);
        one.centre += share * pushed * away;
        other.centre -= (1 - share) * pushed * away;
      }

      const AggregatePlacement  &p;
      Places                     places;
      UniformRandom              random;
      const std::vector<double> &diameters;
      std::vector<Inclusion>     placed;
    };

    std::vector<Inclusion> grown(const std::vector<double> &diameters, const AggregatePlacement &p)
    {
      double reached = 0;
      for (double scale = 0.9; scale > 0.3; scale *= 0.9)
        {
          Placer placer(diameters, p, p.seed);
          if (!placer.place(scale))
            continue;
          reached = placer.grow(scale);
          if (reached >= 1)
            return placer.result();
          break;
        }
      double volume = 0;
      for (const double d : diameters)
        volume += M_PI / 6 * d * d * d;
      const double requested = volume / p.box.prod();
      throw base::InputError("Aggregates: content = " + base::number_text(requested) + " of the box: " +
                             (reached > 0 ?
                                base::number_text(requested * reached * reached * reached) + " was reached" :
                                "no place was found for them at a third of their size") +
                             ". Lower the content or the distances, or enlarge the specimen.");
    }
  } // namespace

  PlacedAggregates place_inclusions(const std::vector<double> &diameters, const AggregatePlacement &p)
  {
    check(diameters, p);
    std::vector<double> sizes = diameters;
    std::sort(sizes.begin(), sizes.end(), std::greater<double>());
    if (!sizes.empty() && sizes.front() > p.box.minCoeff())
      throw base::InputError("Aggregates: the largest, of " + base::number_text(sizes.front()) +
                             " m, is larger than the specimen's edge of " + base::number_text(p.box.minCoeff()) +
                             " m. Enlarge the specimen, or take a finer grading.");
    PlacedAggregates found;
    found.structure.box      = p.box;
    found.structure.periodic = p.periodic;
    for (found.restarts = 0; found.restarts <= p.restarts; ++found.restarts)
      {
        Placer placer(sizes, p, p.seed + static_cast<std::uint64_t>(found.restarts) * other_stream);
        if (placer.place(1))
          {
            found.structure.inclusions = std::move(placer.result());
            return found;
          }
      }
    found.grown                = true;
    found.structure.inclusions = grown(sizes, p);
    return found;
  }
} // namespace dem
