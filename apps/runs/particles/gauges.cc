#include "apps/runs/particles/gauges.h"

#include "apps/text/nearest_name.h"
#include "apps/text/same_name.h"
#include "dem/observation/group_motion.h"

#include <algorithm>
#include <cctype>
#include <limits>

namespace apps
{
  void GaugeSection::check(const base::EntryPath         &section,
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

  const char *GaugeSection::unit() const
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
    void refuse_name(const base::EntryPath &gauge, const std::string &name)
    {
      const auto fits = [](const unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; };
      if (!std::all_of(name.begin(), name.end(), fits))
        gauge.refuse("the name of a probe is that of a column: letters, digits and . _ - only.");
      if (name == "time" || name == "links" || name == "broken_links" || name == "contacts" ||
          name.rfind("energy_", 0) == 0)
        gauge.refuse("series.csv has a column of this name already. Choose another.");
    }
  } // namespace

  void GaugesSection::check(const base::EntryPath         &root,
                            const GroupNames              &names,
                            const PrescribedMotionSection &motion,
                            const WallsSection            &walls) const
  {
    for (const GaugeSection &gauge : gauges)
      refuse_name(root.at("Probes").at(gauge.name), gauge.name);
    for (const GaugeSection &gauge : gauges)
      gauge.check(root.at("Probes").at(gauge.name), names, motion, walls);
  }

  namespace
  {
    using Quantity = GaugeSection::Quantity;

    dem::GroupMotion motion_of(const std::string &group, const GaugedBody &seen)
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

    Eigen::Vector3d vector_of(const GaugeSection &gauge, const GaugedBody &seen)
    {
      switch (gauge.quantity)
        {
        case Quantity::displacement:
          return motion_of(gauge.group, seen).travelled;
        case Quantity::velocity:
          return motion_of(gauge.group, seen).velocity;
        case Quantity::spin:
          return motion_of(gauge.group, seen).spin;
        case Quantity::distance:
          return motion_of(gauge.other, seen).position - motion_of(gauge.group, seen).position;
        case Quantity::reaction:
          return seen.motion.reaction(gauge.group);
        case Quantity::reaction_moment:
          return seen.motion.reaction_moment(gauge.group);
        case Quantity::reaction_torque:
          return seen.motion.reaction_torque(gauge.group, gauge.about());
        case Quantity::wall_force:
          return seen.walls.surface(gauge.wall).total_force;
        case Quantity::wall_moment:
          return seen.walls.surface(gauge.wall).total_moment -
                 gauge.about().cross(seen.walls.surface(gauge.wall).total_force);
        case Quantity::wall_travel:
          return seen.walls.surface(gauge.wall).travel;
        case Quantity::force:
          return seen.specimen.force_on(seen.groups.at(gauge.group));
        case Quantity::wall_impulse:
          return seen.walls.surface(gauge.wall).momentum;
        default:
          return motion_of(gauge.group, seen).position;
        }
    }
  } // namespace

  double value_of(const GaugeSection &gauge, const GaugedBody &seen)
  {
    if (gauge.quantity == Quantity::kinetic_energy)
      return motion_of(gauge.group, seen).kinetic_energy;
    if (gauge.quantity == Quantity::unbalanced_ratio)
      return unbalanced_ratio(seen.specimen);
    if (gauge.quantity == Quantity::broken_links)
      return static_cast<double>(seen.specimen.broken_links_of(seen.groups.at(gauge.group)));
    const Eigen::Vector3d vector = vector_of(gauge, seen);
    return gauge.component == GaugeSection::Component::size ? vector.norm() : vector[static_cast<int>(gauge.component)];
  }
} // namespace apps
