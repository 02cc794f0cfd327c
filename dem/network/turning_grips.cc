#include "dem/network/turning_grips.h"

#include "base/errors.h"
#include "dem/grips/grip_face.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dem
{
  namespace
  {
    using Eigen::Vector2d;

    /**
     * Particles of one grip, by their arms from its middle along the two axes across the load. The motion along the axis of one of them
     * (in space of two), its leader, says how far the plane has turned, and all others follow.
     */
    class TurningGrip
    {
    public:
      TurningGrip(const LoadedNetwork &network, const GripPair &grips, const std::vector<std::size_t> &particles)
        : loaded(network)
        , axis(grips.axis)
        , members(particles)
      {
        std::vector<Eigen::Vector3d> places;
        for (const std::size_t i : members)
          places.push_back(loaded.network.centre[i]);
        arm = arms_in_face(places, axis, loaded.network.dimension);
        choose_leaders();
      }

      /** Ties of all motions along the axis. @param blocked spins turn with the grip */
      void add_ties(std::vector<Tie> &ties, const bool blocked) const
      {
        for (std::size_t k = 0; k < members.size(); ++k)
          {
            if (std::find(leaders.begin(), leaders.end(), k) == leaders.end())
              ties.push_back(follow(members[k], axis, 1, arm[k]));
            // A turn w moves what is at r by w x r: along the axis by w_b r_c - w_c r_b, of which the gradient across is (-w_c, w_b).
            for (int c = 0; blocked && c < 2; ++c)
              if (const int spin = 3 + across(axis, c); loaded.network.moves(spin))
                ties.push_back(follow(members[k], spin, c == 0 ? 1 : -1, c == 0 ? Vector2d(0, 1) : Vector2d(1, 0)));
          }
      }

    private:
      /** The farthest; and of the others that whose arm spans the largest area with it. */
      void choose_leaders()
      {
        std::size_t first = 0, second = 0;
        for (std::size_t k = 0; k < arm.size(); ++k)
          first = arm[k].norm() > arm[first].norm() ? k : first;
        const auto spanned = [&](const std::size_t k) {
          return std::abs(arm[first].x() * arm[k].y() - arm[first].y() * arm[k].x());
        };
        for (std::size_t k = 0; k < arm.size(); ++k)
          second = spanned(k) > spanned(second) ? k : second;
        const bool plane = loaded.network.dimension == 2;
        leaders          = plane ? std::vector<std::size_t>{first} : std::vector<std::size_t>{first, second};
      }

      /** The condition that a motion is the gradient of the plane's motion along the axis, times `by`. */
      Tie follow(const std::size_t particle, const int motion, const double sign, const Vector2d &by) const
      {
        Tie tie = {{particle, motion, 1.0}};
        if (leaders.size() == 1)
          {
            const Vector2d &led = arm[leaders[0]];
            tie.push_back({members[leaders[0]], axis, -sign * by.dot(led) / led.squaredNorm()});
            return tie;
          }
        Eigen::Matrix2d led;
        led << arm[leaders[0]], arm[leaders[1]];
        const Vector2d weight = led.inverse() * by; // by = sum of weights times arms of the leaders
        for (std::size_t n = 0; n < 2; ++n)
          tie.push_back({members[leaders[n]], axis, -sign * weight[static_cast<Eigen::Index>(n)]});
        return tie;
      }

      const LoadedNetwork            &loaded;
      int                             axis;
      const std::vector<std::size_t> &members;
      std::vector<Vector2d>           arm; ///< of each member [m]
      std::vector<std::size_t>        leaders;
    };
  } // namespace

  void let_grips_turn(LoadedNetwork &loaded, const GripPair &grips)
  {
    if (!grips.lateral_blocked)
      throw base::InputError("grips that turn must hold their particles sideways, or the specimen falls over.");
    std::vector<Tie> ties;
    for (const std::vector<std::size_t> *members : {&grips.layers.low, &grips.layers.high})
      {
        TurningGrip(loaded, grips, *members).add_ties(ties, grips.spin_blocked);
        for (const std::size_t i : *members)
          for (int c = 0; c < motions; ++c)
            if (c == grips.axis || (c >= 3 && c != 3 + grips.axis && grips.spin_blocked && loaded.network.moves(c)))
              loaded.held[i] &= static_cast<HeldMotions>(~(1u << c));
      }
    loaded.ties = std::make_shared<Ties>(ties, loaded.held, mean_arm(loaded.network));
  }
} // namespace dem
