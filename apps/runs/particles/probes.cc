#include "apps/runs/particles/probes.h"

#include "apps/text/nearest_name.h"
#include "apps/text/same_name.h"
#include "dem/observation/group_motion.h"

#include <algorithm>
#include <cctype>
#include <limits>

namespace apps
{
  void ProbeSection::check(const base::EntryPath         &section,
                           const GroupNames              &names,
                           const PrescribedMotionSection &motion,
                           const WallsSection            &walls) const
  {
    names.require(section, "Group", group);
    if (quantity == Quantity::distance)
      names.require(section, "Other group", other);
    if (of_wall() && !walls.knows(wall))
      section.refuse("Wall", "there is no such wall. " + did_you_mean(wall, walls.names()));
    const bool held = std::any_of(motion.motions.begin(), motion.motions.end(),
                                  [&](const PrescribedFormulas &m) { return same_name(m.group, group); });
    if (of_grip() && !held)
      section.refuse("Group", "only a group of section Motion has a reaction.");
  }

  const char *ProbeSection::unit() const
  {
    switch (quantity)
      {
      case Quantity::velocity:
        return "m/s";
      case Quantity::spin:
        return "rad/s";
      case Quantity::reaction:
      case Quantity::wall_force:
      case Quantity::force:
        return "N";
      case Quantity::reaction_moment:
      case Quantity::reaction_torque:
      case Quantity::wall_moment:
        return "N m";
      case Quantity::wall_impulse:
        return "N s";
      case Quantity::kinetic_energy:
        return "J";
      case Quantity::broken_links:
        return "";
      case Quantity::unbalanced_ratio:
        return "-";
      default:
        return "m";
      }
  }

  namespace
  {
    /** The name of a probe is that of a column. */
    void refuse_name(const base::EntryPath &probe, const std::string &name)
    {
      const auto fits = [](const unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; };
      if (!std::all_of(name.begin(), name.end(), fits))
        probe.refuse("the name of a probe is that of a column: letters, digits and . _ - only.");
      if (name == "time" || name == "links" || name == "broken_links" || name == "contacts" ||
          name.rfind("energy_", 0) == 0)
        probe.refuse("series.csv has a column of this name already. Choose another.");
    }
  } // namespace

  void ProbesSection::check(const base::EntryPath         &root,
                            const GroupNames              &names,
                            const PrescribedMotionSection &motion,
                            const WallsSection            &walls) const
  {
    for (const ProbeSection &probe : probes)
      refuse_name(root.at("Probes").at(probe.name), probe.name);
    for (const ProbeSection &probe : probes)
      probe.check(root.at("Probes").at(probe.name), names, motion, walls);
  }

  namespace
  {
    using Quantity = ProbeSection::Quantity;

    dem::GroupMotion motion_of(const std::string &group, const ProbedBody &seen)
    {
      return dem::motion_of(seen.specimen, seen.particles, seen.groups.at(group));
    }

    /** Not a number where particles are joined by nothing. */
    double unbalanced_ratio(const dem::ObservedSpecimen &specimen)
    {
      const dem::Counts counts = specimen.counts();
      return counts.links + counts.contacts + counts.wall_contacts > 0 ? specimen.unbalanced_ratio() :
                                                                         std::numeric_limits<double>::quiet_NaN();
    }

    Eigen::Vector3d vector_of(const ProbeSection &probe, const ProbedBody &seen)
    {
      switch (probe.quantity)
        {
        case Quantity::displacement:
          return motion_of(probe.group, seen).travelled;
        case Quantity::velocity:
          return motion_of(probe.group, seen).velocity;
        case Quantity::spin:
          return motion_of(probe.group, seen).spin;
        case Quantity::distance:
          return motion_of(probe.other, seen).position - motion_of(probe.group, seen).position;
        case Quantity::reaction:
          return seen.motion.reaction(probe.group);
        case Quantity::reaction_moment:
          return seen.motion.reaction_moment(probe.group);
        case Quantity::reaction_torque:
          return seen.motion.reaction_torque(probe.group, probe.about());
        case Quantity::wall_force:
          return seen.walls.surface(probe.wall).total_force;
        case Quantity::wall_moment:
          return seen.walls.surface(probe.wall).total_moment -
                 probe.about().cross(seen.walls.surface(probe.wall).total_force);
        case Quantity::wall_travel:
          return seen.walls.surface(probe.wall).travel;
        case Quantity::force:
          return seen.specimen.force_on(seen.groups.at(probe.group));
        case Quantity::wall_impulse:
          return seen.walls.surface(probe.wall).momentum;
        default:
          return motion_of(probe.group, seen).position;
        }
    }
  } // namespace

  double value_of(const ProbeSection &probe, const ProbedBody &seen)
  {
    if (probe.quantity == Quantity::kinetic_energy)
      return motion_of(probe.group, seen).kinetic_energy;
    if (probe.quantity == Quantity::unbalanced_ratio)
      return unbalanced_ratio(seen.specimen);
    if (probe.quantity == Quantity::broken_links)
      return static_cast<double>(seen.specimen.broken_links_of(seen.groups.at(probe.group)));
    const Eigen::Vector3d vector = vector_of(probe, seen);
    return probe.component == ProbeSection::Component::size ? vector.norm() : vector[static_cast<int>(probe.component)];
  }
} // namespace apps
