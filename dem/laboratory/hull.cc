#include "dem/laboratory/hull.h"

#include "base/errors.h"
#include "dem/neighbours/cell_list.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

namespace dem
{
  namespace
  {
    using Eigen::Vector3d;

    constexpr double full_turn = 2 * M_PI;
    /** By which radii differ in the search, so that a ball never touches one particle more than it must: crystals. */
    constexpr double shaken = 1e-7;

    /** Between 0 and 1, of a particle's number alone. */
    double shake_of(const std::size_t number)
    {
      std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
      z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z               = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      return static_cast<double>((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
    }

    /** The ball on its way along a circle. */
    struct Circle
    {
      Vector3d middle, start, across; ///< place = middle + cos(angle) start + sin(angle) across [m]

      Vector3d at(const double angle) const { return middle + std::cos(angle) * start + std::sin(angle) * across; }
    };

    /** What the ball runs against, and where its centre is then. */
    struct Stop
    {
      std::int32_t particle = -1;
      Vector3d     ball     = Vector3d::Zero();
    };

    class Roller
    {
    public:
      Roller(const std::vector<Vector3d> &centre_,
             const std::vector<double>   &radius,
             const int                    dimension,
             const double                 ball)
        : centre(centre_)
        , reach(radius)
        , near(radius.size())
      {
        if (dimension == 2)
          for (Vector3d &x : centre)
            x[2] = 0;
        for (std::size_t i = 0; i < reach.size(); ++i)
          reach[i] += ball * (1 + shaken * shake_of(i));
        for (const NeighbourPair &pair : find_pairs(centre, radius, 1.0, 2 * ball * (1 + 2 * shaken), std::nullopt))
          {
            near[static_cast<std::size_t>(pair.first)].push_back(pair.second);
            near[static_cast<std::size_t>(pair.second)].push_back(pair.first);
          }
      }

      const Vector3d &place(const std::int32_t i) const { return centre[static_cast<std::size_t>(i)]; }

      /** Farthest along x: nothing is in the way of a ball beside it. */
      std::int32_t outermost() const
      {
        std::size_t found = 0;
        for (std::size_t i = 1; i < reach.size(); ++i)
          if (centre[i][0] + reach[i] > centre[found][0] + reach[found])
            found = i;
        return static_cast<std::int32_t>(found);
      }
      Vector3d beside(const std::int32_t i) const { return place(i) + reach_of(i) * Vector3d::UnitX(); }

      /** Roll over particle i towards a direction, in the plane of both. */
      Stop roll_over(const std::int32_t i, const Vector3d &ball, const Vector3d &towards) const
      {
        const Vector3d start = ball - place(i);
        const Vector3d across =
          (towards - towards.dot(start) / start.squaredNorm() * start).normalized() * start.norm();
        return first_stop({place(i), start, across}, i, -1);
      }
      /** Roll over the edge from i to j, to the right of it as the ball sees it. */
      Stop roll_over(const std::int32_t i, const std::int32_t j, const Vector3d &ball) const
      {
        const Vector3d axis   = (place(j) - place(i)).normalized();
        const Vector3d middle = place(i) + axis.dot(ball - place(i)) * axis, start = ball - middle;
        return first_stop({middle, start, axis.cross(start)}, i, j);
      }

    private:
      double reach_of(const std::int32_t i) const { return reach[static_cast<std::size_t>(i)]; }

      /** The first particle, of those near i, that the ball enters on its way. */
      Stop first_stop(const Circle &circle, const std::int32_t i, const std::int32_t j) const
      {
        double best = 2 * full_turn;
        Stop   found;
        for (const std::int32_t k : near[static_cast<std::size_t>(i)])
          {
            if (k == j)
              continue;
            // |middle + cos a start + sin a across - x|^2 = R^2, entered at the lesser angle
            const Vector3d apart = place(k) - circle.middle;
            const double   along = 2 * apart.dot(circle.start), aside = 2 * apart.dot(circle.across);
            const double   wanted = apart.squaredNorm() + circle.start.squaredNorm() - reach_of(k) * reach_of(k);
            const double   size   = std::hypot(along, aside);
            if (!(std::abs(wanted) < size))
              continue;
            double angle = std::fmod(std::atan2(aside, along) - std::acos(wanted / size), full_turn);
            if (angle < 0)
              angle += full_turn;
            if (angle > full_turn - 1e-9) // it rests there already, and leaves
              angle = 0;
            if (angle < best)
              {
                best  = angle;
                found = {k, circle.at(angle)};
              }
          }
        return found;
      }

      std::vector<Vector3d>                  centre;
      std::vector<double>                    reach; ///< of the ball's centre from that of each particle it touches [m]
      std::vector<std::vector<std::int32_t>> near;
    };

    /** As many facets as no body has: the ball has lost its way. */
    std::size_t most_facets(const std::size_t particles) { return 16 * particles + 64; }

    [[noreturn]] void lost()
    {
      throw base::NumericalError("the ball that finds a membrane's particles does not come back to where it began. "
                                 "Choose another Membrane ball.");
    }

    Hull chain(const Roller &roller, const std::size_t particles)
    {
      Hull                        hull;
      std::int32_t                from  = roller.outermost();
      Vector3d                    ball  = roller.beside(from);
      std::array<std::int32_t, 2> first = {-1, -1};
      Vector3d                    begun = ball;
      while (true)
        {
          const Vector3d arm  = ball - roller.place(from);
          const Stop     next = roller.roll_over(from, ball, {-arm[1], arm[0], 0});
          if (next.particle < 0)
            return {};
          if (first[0] == from && first[1] == next.particle && (next.ball - begun).norm() < 1e-6 * arm.norm())
            return hull;
          if (first[0] < 0)
            {
              first = {from, next.particle};
              begun = next.ball;
            }
          hull.facet.push_back({from, next.particle, 0});
          if (hull.facet.size() > most_facets(particles))
            lost();
          from = next.particle;
          ball = next.ball;
        }
    }

    /** A triangle with the ball that rests on it, its corners counter-clockwise as the ball sees them. */
    struct Seat
    {
      std::array<std::int32_t, 3> corner;
      Vector3d                    ball;

      /** The same whichever corner is named first. */
      std::array<std::int32_t, 3> name() const
      {
        std::array<std::int32_t, 3> turned = corner;
        std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
        return turned;
      }
    };

    Hull triangles(const Roller &roller, const std::size_t particles)
    {
      Hull hull;
      hull.corners            = 3;
      const std::int32_t a    = roller.outermost();
      const Stop         edge = roller.roll_over(a, roller.beside(a), Vector3d::UnitY());
      if (edge.particle < 0)
        return hull;
      const Stop seat = roller.roll_over(a, edge.particle, edge.ball);
      if (seat.particle < 0)
        return hull;
      std::set<std::array<std::int32_t, 3>> known;
      std::deque<Seat>                      open;
      const auto                            take = [&](const Seat &found) {
        if (!known.insert(found.name()).second)
          return;
        hull.facet.push_back(found.corner);
        open.push_back(found);
        if (hull.facet.size() > most_facets(particles))
          lost();
      };
      take({{edge.particle, a, seat.particle}, seat.ball});
      while (!open.empty())
        {
          const Seat now = open.front();
          open.pop_front();
          for (std::size_t c = 0; c < 3; ++c)
            {
              const std::int32_t i = now.corner[c], j = now.corner[(c + 1) % 3];
              const Stop         next = roller.roll_over(i, j, now.ball);
              if (next.particle < 0)
                lost();
              take({{j, i, next.particle}, next.ball});
            }
        }
      return hull;
    }
  } // namespace

  Vector3d Hull::area_vector(const std::size_t number, const std::vector<Vector3d> &centre) const
  {
    const auto corner = [&](const std::size_t c) -> const Vector3d & {
      return centre[static_cast<std::size_t>(facet[number][c])];
    };
    const Vector3d edge = corner(1) - corner(0);
    if (corners == 2)
      return {edge[1], -edge[0], 0};
    return 0.5 * edge.cross(Vector3d(corner(2) - corner(0)));
  }

  Hull find_hull(const std::vector<Vector3d> &centre,
                 const std::vector<double>   &radius,
                 const int                    dimension,
                 const double                 ball)
  {
    if (centre.empty())
      return {};
    const Roller roller(centre, radius, dimension, ball);
    return dimension == 2 ? chain(roller, centre.size()) : triangles(roller, centre.size());
  }
} // namespace dem
