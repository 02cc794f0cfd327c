#include "apps/drivers/sequential/particle_event.h"

#include "apps/scene/number_list.h"
#include "apps/scene/physics_section.h"
#include "apps/scene/value_text.h"
#include "apps/specimens/specimen_packing.h"

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

  void ParticleEventSection::declare(Section &root)
  {
    const auto computed = [this] { return source != Source::file; };
    Section   &s = root.section("Particles", "The event that is simulated with particles, and when it is handed over");
    s.choice("Source", source, {{"file", Source::file}, {"uniaxial", Source::uniaxial}, {"impact", Source::impact}},
             Need::required)
      .means("file: discrete states saved before; uniaxial: a specimen between grips; impact: a beam hit by a sphere");
    s.text("Files", files, Need::required)
      .means("Saved discrete states (HDF5), separated by commas")
      .only_if([this] { return source == Source::file; }, "Particles/Source = file")
      .type = "list of files";
    specimen.declare(s, physics.dimension);
    material.declare(s);
    declare_physics(s, physics);
    time.declare(s);
    gravity.declare(s);
    for (const char *name : {"Specimen", "Physics", "Time", "Gravity"})
      s.find_section(name)->only_if(computed, "Particles/Source is not file");
    s.find_section("Material")
      ->only_if([this] { return source != Source::file && material.named.empty(); },
                "Particles/Source is not file, and there is no section Particles/Materials");

    declare_uniaxial(s);
    declare_impact(s);
  }

  void ParticleEventSection::declare_uniaxial(Section &particles)
  {
    const auto strained = [this] { return source == Source::uniaxial; };
    Section   &u        = particles.section("Uniaxial", "Between two gripped layers");
    u.only_if([this, strained] { return strained() || (strained_too && strained_too()); },
              "Particles/Source = uniaxial, or Transfer/Mapping law/Law = identify");
    u.choice("Axis", axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional).means("Direction of loading");
    u.number("Strain rate", strain_rate, "1/s", Range::positive(), Need::required)
      .means("Magnitude, on the way forward");
    u.number("Back rate", back_rate, "1/s", Range::at_least(0), Need::optional).means("On the way back; 0: half of it");
    grips.declare(u);
    u.flag("Grip lateral motion blocked", lateral_blocked).means("Grips hold their particles sideways too");
    u.flag("Grip rotation blocked", spin_blocked).means("Grips keep their particles from spinning");
    declare_list(u, "Instants", instants, "-", Need::required)
      .means(
        "Strains at which the state is handed over, separated by commas, all of one sign; \"a > b\": strained to a and "
        "then led back to b")
      .only_if(strained, "Particles/Source = uniaxial");
    u.number("End strain", end_strain, "-", Range(), Need::optional)
      .means("To which an all-particle run goes on, to compare with; 0: none")
      .only_if(strained, "Particles/Source = uniaxial");
  }

  void ParticleEventSection::declare_impact(Section &particles)
  {
    Section &i = particles.section(
      "Impact", "A beam along x on two supports, hit at mid-span from above by a sphere of its own (first) material");
    i.only_if([this] { return source == Source::impact; }, "Particles/Source = impact");
    i.number("Span", impact.span, "m", Range::positive(), Need::required).means("Distance of the supports");
    i.number("Support width", impact.support_width, "m", Range::positive(), Need::required)
      .means("Bottom particles within half of it of a support cannot move up or down");
    i.number("Impactor radius", impact.impactor_radius, "m", Range::positive(), Need::required).means("Of the sphere");
    declare_list(i, "Impactor velocities", velocities, "m/s", Need::required)
      .means("One run each, numbers above 0 [m/s], separated by commas");
    i.number("Rest damping", impact.rest_damping, "-", Range::between(1e-3, 0.99), Need::optional)
      .means("Local damping once the impactor has left");
    i.number("Rest ratio", impact.rest_ratio, "-", Range::between(1e-12, 1), Need::optional)
      .means("At rest when the kinetic energy is below this part of the impactor's");
    i.number("Longest time", impact.longest, "s", Range::positive(), Need::required)
      .means("After which the run ends in any case");
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
    dem::SpecimenParameters p;
    p.physics           = physics;
    p.density           = specimen.density;
    p.interaction_ratio = specimen.interaction_ratio;
    p.thickness         = specimen.thickness;
    p.step_factor       = time.step_factor;
    p.damping           = time.damping;
    p.gravity           = gravity.vector();
    p.loose             = source == Source::impact ? 1 : 0;
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
