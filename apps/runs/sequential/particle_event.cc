#include "apps/runs/sequential/particle_event.h"

#include "apps/models/specimen_parameters.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/text/value_text.h"

#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    /** "a" or "a > b"; nothing if it is neither. */
    std::optional<ParticleEventSection::Instant> instant_in(const std::string &text)
    {
      const auto arrow   = text.find('>');
      const auto forward = number_in(trimmed(text.substr(0, arrow)));
      if (!forward || *forward == 0)
        return {};
      if (arrow == std::string::npos)
        return ParticleEventSection::Instant{*forward, {}};
      const auto back = number_in(trimmed(text.substr(arrow + 1)));
      if (!back || std::abs(*back) > std::abs(*forward))
        return {};
      return ParticleEventSection::Instant{*forward, *back};
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
        if (files_asked().empty())
          s.refuse("Files", "expected file names, separated by commas.");
        return;
      }
    specimen.check(s, physics.dimension);
    material.check(s, physics.dimension);
    gravity.check(s, physics.dimension);
    if (source == Source::impact)
      {
        if (velocities_asked().empty())
          s.at("Impact").refuse("Impactor velocities", "expected numbers above 0, separated by commas.");
        return;
      }
    check_uniaxial(s.at("Uniaxial"));
  }

  void ParticleEventSection::check_uniaxial(const base::EntryPath &section) const
  {
    const auto when = instants_asked();
    if (when.empty())
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

  std::vector<ParticleEventSection::Instant> ParticleEventSection::instants_asked() const
  {
    std::vector<Instant> all;
    for (const std::string &part : comma_separated(instants))
      {
        const auto instant = instant_in(part);
        if (!instant)
          return {};
        all.push_back(*instant);
      }
    return all;
  }

  std::vector<double> ParticleEventSection::velocities_asked() const
  {
    std::vector<double> all;
    for (const std::string &part : comma_separated(velocities))
      {
        const auto number = number_in(part);
        if (!number || *number <= 0)
          return {};
        all.push_back(*number);
      }
    return all;
  }

  std::vector<std::string> ParticleEventSection::files_asked() const { return comma_separated(files); }

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
        return files_asked().size();
      case Source::impact:
        return velocities_asked().size();
      default:
        return instants_asked().size();
      }
  }

  dem::Packing event_packing(const ParticleEventSection &event)
  {
    return event.source == ParticleEventSection::Source::file ?
             dem::Packing() :
             make_packing(event.specimen, event.material, event.physics.dimension);
  }
} // namespace apps
