#include "apps/runs/particles/initial_velocity.h"

#include "apps/models/start_velocity.h"

#include <map>

namespace apps
{
  void
  InitialVelocitySection::check(const base::EntryPath &root, const dem::Physics &physics, const GroupNames &names) const
  {
    const base::EntryPath all = root.at("Initial velocity");
    for (const MotionFormulas &given : velocities)
      names.require_section(all, given.group);
    for (const MotionFormulas &given : velocities)
      {
        given.check(all.at(given.group), physics);
        refuse_time(all.at(given.group), "Velocity", given.velocity);
        refuse_time(all.at(given.group), "Spin", given.spin);
      }
  }

  void
  InitialVelocitySection::give(dem::Specimen &specimen, const dem::Packing &packing, const ParticleGroups &groups) const
  {
    std::map<std::size_t, dem::PrescribedVelocity> requested; // by particle: later ones win
    for (const MotionFormulas &given : velocities)
      for (const std::size_t i : groups.at(given.group))
        {
          dem::PrescribedVelocity &one = requested[i];
          one = {i, value_of(given.velocity, packing.centre[i], 0), value_of(given.spin, packing.centre[i], 0)};
          for (int c = 0; c < 6; ++c)
            one.given[static_cast<std::size_t>(c)] = given.component(c).given();
        }
    std::vector<dem::PrescribedVelocity> prescribed;
    for (const auto &[particle, one] : requested)
      prescribed.push_back(one);
    specimen.set_velocities(prescribed);
  }

  std::vector<std::string> InitialVelocitySection::untouched_since(const dem::ObservedSpecimen &specimen,
                                                                   const dem::Packing          &packing,
                                                                   const ParticleGroups        &groups,
                                                                   const Eigen::Vector3d       &acceleration) const
  {
    std::vector<std::string> found;
    for (const MotionFormulas &given : velocities)
      {
        Eigen::Vector3d thrown = Eigen::Vector3d::Zero(), now = Eigen::Vector3d::Zero();
        double          mass = 0, scale = 0;
        bool            is_held = false;
        for (const std::size_t i : groups.at(given.group))
          {
            const dem::ParticleState p     = specimen.particle(i);
            const Eigen::Vector3d    start = value_of(given.velocity, packing.centre[i], 0);
            is_held                        = is_held || p.held[0] || p.held[1];
            thrown += p.mass * start;
            now += p.mass * p.velocity;
            scale += p.mass * start.norm();
            mass += p.mass;
          }
        const Eigen::Vector3d weight = mass * acceleration;
        const double          unknown =
          1e-9 * scale + specimen.time_step() * weight.norm(); // velocities are those of half a step back
        if (!is_held && scale > 0 && (now - thrown - specimen.time() * weight).norm() <= unknown)
          found.push_back(given.group);
      }
    return found;
  }
} // namespace apps
