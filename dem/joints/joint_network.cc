#include "dem/joints/joint_network.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/core/uniform_random.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr double      two_pi       = 2 * 3.14159265358979323846;
    constexpr std::size_t most_joints  = 100000;
    constexpr double      as_if_single = 1e12; ///< a concentration beyond which directions differ by rounding

    void check_network(const JointNetwork &n)
    {
      const auto require = [](const bool holds, const char *what, const double value) {
        if (!holds)
          throw base::InputError(std::string("random joints: ") + what + " = " + base::number_text(value) +
                                 ": must be above 0, and finite.");
      };
      require(n.intensity > 0 && std::isfinite(n.intensity), "intensity", n.intensity);
      require(n.radius > 0 && std::isfinite(n.radius), "radius", n.radius);
      for (int c = 0; c < n.dimension; ++c)
        require(n.upper[c] > n.lower[c] && std::isfinite(n.upper[c] - n.lower[c]), "edge of the box",
                n.upper[c] - n.lower[c]);
      if (!(n.concentration >= 0))
        throw base::InputError("random joints: concentration = " + base::number_text(n.concentration) +
                               ": must be 0 or above.");
    }

    /** doc/theory/smooth-joint.md, eq. 6 */
    Vector3d direction_in_space(const JointNetwork &network, UniformRandom &random)
    {
      const double   kappa = network.concentration, u = random(), turn = two_pi * random();
      const double   cosine = kappa == 0 ? 2 * u - 1 : 1 + std::log(u + (1 - u) * std::exp(-2 * kappa)) / kappa;
      const double   c = std::max(-1.0, cosine), s = std::sqrt(std::max(0.0, 1 - c * c));
      const Vector3d first = network.normal.unitOrthogonal(), second = network.normal.cross(first);
      return (c * network.normal + s * (std::cos(turn) * first + std::sin(turn) * second)).normalized();
    }

    /** Angle from the mean direction. */
    double angle_in_plane(const double kappa, UniformRandom &random)
    {
      if (kappa < 1e-6)
        return two_pi * (random() - 0.5);
      const double tau = 1 + std::sqrt(1 + 4 * kappa * kappa), rho = (tau - std::sqrt(2 * tau)) / (2 * kappa);
      const double r = (1 + rho * rho) / (2 * rho);
      for (;;)
        {
          const double z = std::cos(0.5 * two_pi * random()), f = (1 + r * z) / (r + z), c = kappa * (r - f);
          const double u = random(), side = random() < 0.5 ? -1 : 1;
          if (c * (2 - c) > u || (u > 0 && std::log(c / u) + 1 >= c))
            return side * std::acos(std::min(1.0, std::max(-1.0, f)));
        }
    }

    Vector3d direction(const JointNetwork &network, UniformRandom &random)
    {
      if (!(network.concentration < as_if_single))
        return network.normal;
      if (network.dimension == 3)
        return direction_in_space(network, random);
      return Eigen::AngleAxisd(angle_in_plane(network.concentration, random), Vector3d::UnitZ()) * network.normal;
    }
  } // namespace

  std::vector<JointPlane> random_joints(const JointNetwork &network)
  {
    check_network(network);
    UniformRandom random(network.seed);
    double        volume = 1;
    for (int c = 0; c < network.dimension; ++c)
      volume *= network.upper[c] - network.lower[c];
    const double            asked = network.intensity * volume;
    double                  sum   = 0;
    std::vector<JointPlane> joints;
    for (std::size_t drawn = 0; drawn < 10 * most_joints; ++drawn)
      {
        JointPlane joint;
        joint.radius = network.radius;
        for (int c = 0; c < network.dimension; ++c)
          joint.centre[c] =
            network.lower[c] - network.radius + (network.upper[c] - network.lower[c] + 2 * network.radius) * random();
        joint.normal      = direction(network, random);
        const double size = extent_in_box(joint, network.lower, network.upper, network.dimension);
        if (size == 0)
          continue;
        if (sum + size - asked > asked - sum)
          return joints;
        sum += size;
        joints.push_back(joint);
        if (joints.size() > most_joints)
          break;
      }
    throw base::InputError("random joints: an intensity of " + base::number_text(network.intensity) +
                           " 1/m takes more than " + std::to_string(most_joints) +
                           " of them. Make them larger, or fewer.");
  }
} // namespace dem
