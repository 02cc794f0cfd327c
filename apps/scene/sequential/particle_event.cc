#include "apps/scene/sequential/particle_event.h"

#include "apps/scene/entries/gravity.h"
#include "apps/scene/entries/grips.h"
#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/physics.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/entries/time.h"
#include "apps/scene/number_list.h"
#include "apps/scene/section.h"
#include "apps/scene/usual_sizes.h"
#include "apps/text/value_text.h"

#include <optional>
#include <utility>
#include <vector>

namespace apps
{
  namespace
  {
    /** "a" or "a > b"; nothing if it is neither. */
    std::optional<ParticleEventSection::Instant> instant_in(const std::string &text)
    {
      const auto arrow   = text.find('>');
      const auto forward = number_in(trimmed(text.substr(0, arrow)));
      if (!forward)
        return {};
      if (arrow == std::string::npos)
        return ParticleEventSection::Instant{*forward, {}};
      const auto back = number_in(trimmed(text.substr(arrow + 1)));
      if (!back)
        return {};
      return ParticleEventSection::Instant{*forward, *back};
    }

    Entry &declare_instants(Section &section, std::vector<ParticleEventSection::Instant> &instants)
    {
      const std::string entry = "Instants";
      std::string       none;
      Entry            &added = section.text(entry, none, Need::required); // its store does not outlive this
      added.store             = [&instants, entry](const std::string &written, const Place &) -> std::string {
        std::vector<ParticleEventSection::Instant> all;
        for (const std::string &part : comma_separated(list_without_units(written, "-")))
          {
            const auto instant = instant_in(part);
            if (!instant)
              return "expected strains, or \"strain > strain after unloading\", separated by commas, e.g. -1e-3, -2e-3 "
                                 "> -1e-3";
            all.push_back(*instant);
          }
        const std::string question = question_about_list(entry, "-", written);
        if (question.empty())
          instants = std::move(all);
        return question;
      };
      return added;
    }

    void declare_uniaxial(Section &particles, ParticleEventSection &particle_event)
    {
      using Source        = ParticleEventSection::Source;
      const auto strained = [&particle_event] { return particle_event.source == Source::uniaxial; };
      Section   &u        = particles.section("Uniaxial", "Between two gripped layers");
      u.only_if([&particle_event,
                 strained] { return strained() || (particle_event.strained_too && particle_event.strained_too()); },
                "Particles/Source = uniaxial, or Transfer/Mapping law/Law = identify");
      u.choice("Axis", particle_event.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
        .means("Direction of loading");
      u.number("Strain rate", particle_event.strain_rate, "1/s", Range::positive(), Need::required)
        .means("Magnitude, on the way forward");
      u.number("Back rate", particle_event.back_rate, "1/s", Range::at_least(0), Need::optional)
        .means("On the way back; 0: half of it");
      declare(u, particle_event.grips);
      u.flag("Grip lateral motion blocked", particle_event.lateral_blocked)
        .means("Grips hold their particles sideways too");
      u.flag("Grip rotation blocked", particle_event.spin_blocked).means("Grips keep their particles from spinning");
      declare_instants(u, particle_event.instants)
        .means("Strains at which the state is handed over, separated by commas, all of one sign; \"a > b\": strained "
               "to a and "
               "then driven back to b")
        .only_if(strained, "Particles/Source = uniaxial");
      u.number("End strain", particle_event.end_strain, "-", Range(), Need::optional)
        .means("To which an all-particle run goes on, to compare with; 0: none")
        .only_if(strained, "Particles/Source = uniaxial");
    }

    void declare_impact(Section &particles, ParticleEventSection &particle_event)
    {
      using Source = ParticleEventSection::Source;
      Section &i   = particles.section(
          "Impact", "A beam along x on two supports, hit at mid-span from above by a sphere of its own (first) material");
      i.only_if([&particle_event] { return particle_event.source == Source::impact; }, "Particles/Source = impact");
      i.number("Span", particle_event.impact.span, "m", Range::positive(), Need::required)
        .means("Distance of the supports");
      i.number("Support width", particle_event.impact.support_width, "m", Range::positive(), Need::required)
        .means("Bottom particles within half of it of a support cannot move up or down");
      i.number("Impactor radius", particle_event.impact.impactor_radius, "m", Range::positive(), Need::required)
        .means("Of the sphere");
      declare_numbers(i, "Impactor velocities", particle_event.velocities, "m/s", "numbers above 0", Need::required)
        .means("One run each, numbers above 0 [m/s], separated by commas");
      i.number("Rest damping", particle_event.impact.rest_damping, "-", Range::between(1e-3, 0.99), Need::optional)
        .means("Local damping once the impactor has left");
      i.number("Rest ratio", particle_event.impact.rest_ratio, "-", Range::between(1e-12, 1), Need::optional)
        .means("At rest when the kinetic energy is below this part of the impactor's");
      i.number("Longest time", particle_event.impact.longest, "s", Range::positive(), Need::required)
        .means("After which the run ends in any case");
    }
  } // namespace

  void declare(Section &root, ParticleEventSection &particle_event)
  {
    using Source        = ParticleEventSection::Source;
    const auto computed = [&particle_event] { return particle_event.source != Source::file; };
    Section   &s = root.section("Particles", "The event that is simulated with particles, and when it is handed over");
    s.choice("Source", particle_event.source,
             {{"file", Source::file}, {"uniaxial", Source::uniaxial}, {"impact", Source::impact}}, Need::required)
      .means("file: discrete states saved before; uniaxial: a specimen between grips; impact: a beam hit by a sphere");
    declare_names(s, "Files", particle_event.files, Need::required)
      .means("Saved discrete states (HDF5), separated by commas")
      .only_if([&particle_event] { return particle_event.source == Source::file; }, "Particles/Source = file")
      .type = "list of files";
    SpecimenSection::Use use;
    use.laboratory = true;
    declare(s, particle_event.specimen, particle_event.physics.dimension, use);
    declare(*s.find_section("Specimen"), particle_event.mix);
    declare(s, particle_event.material);
    declare_physics(s, particle_event.physics);
    declare(s, particle_event.time);
    declare(s, particle_event.gravity);
    for (const char *name : {"Specimen", "Physics", "Time", "Gravity"})
      s.find_section(name)->only_if(computed, "Particles/Source is not file");
    s.find_section("Material")
      ->only_if(
        [&particle_event] { return particle_event.source != Source::file && particle_event.material.named.empty(); },
        "Particles/Source is not file, and there is no section Particles/Materials");

    declare_uniaxial(s, particle_event);
    declare_impact(s, particle_event);
  }
} // namespace apps
