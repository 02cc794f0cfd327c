#include "dem/observation/group_motion.h"

#include "dem/specimen/observation.h"

namespace dem
{
  namespace
  {
    /** Which clumps lie wholly in a group. */
    std::vector<bool> whole_clumps(const ObservedSpecimen &specimen, const std::vector<std::size_t> &group)
    {
      std::vector<std::size_t> pebbles(specimen.clumps().size(), 0);
      for (const std::size_t i : group)
        if (const auto clump = specimen.clumps().of(i))
          ++pebbles[*clump];
      std::vector<bool> whole(pebbles.size());
      for (std::size_t clump = 0; clump < pebbles.size(); ++clump)
        whole[clump] = pebbles[clump] == specimen.clumps().state(clump).pebbles;
      return whole;
    }

    /** Sums of what has a mass. */
    struct Sums
    {
      GroupMotion of;

      void add(const double           mass,
               const Eigen::Vector3d &position,
               const Eigen::Vector3d &travelled,
               const Eigen::Vector3d &velocity,
               const Eigen::Vector3d &spin)
      {
        of.mass += mass;
        of.position += mass * position;
        of.travelled += mass * travelled;
        of.velocity += mass * velocity;
        of.spin += mass * spin;
      }

      GroupMotion mean() const
      {
        GroupMotion found = of;
        for (Eigen::Vector3d *sum : {&found.position, &found.travelled, &found.velocity, &found.spin})
          *sum /= of.mass;
        return found;
      }
    };
  } // namespace

  GroupMotion
  motion_of(const ObservedSpecimen &specimen, const ParticleKinematics &p, const std::vector<std::size_t> &group)
  {
    const std::vector<bool> whole  = whole_clumps(specimen, group);
    const double            gyrate = specimen.parameters().physics.dimension == 3 ? 2.0 / 5 : 1.0 / 2;
    Sums                    sums;
    for (const std::size_t i : group)
      {
        if (const auto clump = specimen.clumps().of(i); clump && whole[*clump])
          continue;
        sums.add(p.mass[i], p.position[i], p.displacement[i], p.velocity[i], p.angular_velocity[i]);
        sums.of.kinetic_energy +=
          0.5 * p.mass[i] *
          (p.velocity[i].squaredNorm() + gyrate * p.radius[i] * p.radius[i] * p.angular_velocity[i].squaredNorm());
      }
    for (std::size_t clump = 0; clump < whole.size(); ++clump)
      if (whole[clump])
        {
          const ClumpState body = specimen.clumps().state(clump);
          sums.add(body.mass, body.position, body.travelled, body.velocity, body.spin);
          sums.of.kinetic_energy += body.kinetic_energy();
        }
    return sums.mean();
  }
} // namespace dem
