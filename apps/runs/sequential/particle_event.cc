#include "apps/runs/sequential/particle_event.h"

#include "apps/models/specimen_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    bool is_possible(const ParticleEventSection::Instant &instant)
    {
      return instant.forward != 0 && !(instant.back && std::abs(*instant.back) > std::abs(instant.forward));
    }
  } // namespace

  dem::UniaxialParameters uniaxial_parameters(const ParticleEventSection &event, const double furthest)
  {
    dem::UniaxialParameters p;
    p.axis            = event.axis;
    p.strain_rate     = std::copysign(event.strain_rate, furthest);
    p.grips           = event.grips.parameters();
    p.lateral_blocked = event.lateral_blocked;
    p.spin_blocked    = event.spin_blocked;
    p.stop_strain     = std::numeric_limits<double>::infinity(); // the case counts its steps itself
    return p;
  }

  void ParticleEventSection::check(const base::EntryPath &root) const
  {
    const base::EntryPath s = root.at("Particles");
    if (source == Source::file)
      {
        if (files.empty())
          s.refuse("Files", "expected file names, separated by commas.");
        return;
      }
    specimen.check(s, physics.dimension);
    material.check(s, physics.dimension);
    mixed().check(s);
    gravity.check(s, physics.dimension);
    if (source == Source::impact)
      {
        if (velocities.empty() ||
            std::any_of(velocities.begin(), velocities.end(), [](const double v) { return !(v > 0); }))
          s.at("Impact").refuse("Impactor velocities", "expected numbers above 0, separated by commas.");
        return;
      }
    check_uniaxial(s.at("Uniaxial"));
  }

  void ParticleEventSection::check_uniaxial(const base::EntryPath &section) const
  {
    const std::vector<Instant> &when = instants;
    if (when.empty() || !std::all_of(when.begin(), when.end(), is_possible))
      section.refuse("Instants", "expected strains, or \"strain > strain after unloading\", separated by commas, e.g. "
                                 "-1e-3, -2e-3 > -1e-3.");
    for (const Instant &i : when)
      if (std::signbit(i.forward) != std::signbit(when.front().forward))
        section.refuse("Instants", "the strains must have one sign: all tension or all compression.");
    if (end_strain != 0 && std::signbit(end_strain) != std::signbit(when.front().forward))
      section.refuse("End strain", "must have the sign of the instants.");
    grips.check(section);
    if (physics.dimension == 2 && axis == 2)
      section.refuse("Axis", "in two dimensions the specimen lies in the plane z = 0. Load it along x or y.");
  }

  dem::SpecimenParameters ParticleEventSection::specimen_parameters() const
  {
    dem::SpecimenParameters p = apps::specimen_parameters(specimen, physics, time);
    p.gravity                 = gravity.vector();
    p.loose                   = source == Source::impact ? 1 : 0;
    return p;
  }

  std::size_t ParticleEventSection::cases() const
  {
    switch (source)
      {
      case Source::file:
        return files.size();
      case Source::impact:
        return velocities.size();
      default:
        return instants.size();
      }
  }

  dem::Packing event_packing(const ParticleEventSection &event)
  {
    return event.source == ParticleEventSection::Source::file ? dem::Packing() : event.mixed().packing();
  }
} // namespace apps
