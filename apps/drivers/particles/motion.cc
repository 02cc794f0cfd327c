#include "apps/drivers/particles/motion.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    const char *const component_names[6] = {"Velocity x", "Velocity y", "Velocity z", "Spin x", "Spin y", "Spin z"};

    /** Whether particles have this velocity at all. */
    bool exists(const int c, const dem::Physics &physics)
    {
      if (c >= 3 && !physics.rotations)
        return false;
      return physics.dimension == 3 || c < 2 || c == 5;
    }
  } // namespace

  void MotionFormulas::declare(Section &section, const std::string &when)
  {
    declare_components(section, "Velocity", velocity, "m/s", when);
    declare_components(section, "Spin", spin, "rad/s", when + ". Of each particle about its own centre");
  }

  void MotionFormulas::validate(const Section &section, const dem::Physics &physics) const
  {
    for (int c = 0; c < 6; ++c)
      if (component(c).given() && !exists(c, physics))
        section.refuse(component_names[c], physics.rotations ?
                                             "in two dimensions particles move along x and y, and spin about z." :
                                             "particles do not spin (Physics/Rotations = false). Leave it out.");
  }

  void PrescribedMotionSection::declare(Section &root)
  {
    root.section("Motion", "One sub-section per group whose motion is prescribed, named after the group")
      .named_sections("GROUP", [this](Section &opened) {
        MotionFormulas &added = motions.emplace_back();
        added.group           = opened.name();
        added.declare(opened, "Prescribed, by the present place x, y, z of each particle and time t; empty: free");
      });
  }

  void
  PrescribedMotionSection::validate(const Section &root, const dem::Physics &physics, const GroupNames &names) const
  {
    const Section &all = *root.find_section("Motion");
    names.require_sections(all);
    for (const MotionFormulas &motion : motions)
      {
        const Section &section = *all.find_section(motion.group);
        motion.validate(section, physics);
      }
  }

  namespace
  {
    void refuse_shared(const std::vector<MotionFormulas> &motions, const ParticleGroups &groups)
    {
      std::map<std::pair<std::size_t, int>, std::string> taken; // (particle, component) -> group
      for (const MotionFormulas &motion : motions)
        for (int c = 0; c < 6; ++c)
          if (motion.component(c).given())
            for (const std::size_t i : groups.at(motion.group))
              {
                const auto [first, fresh] = taken.emplace(std::make_pair(i, c), motion.group);
                if (!fresh)
                  throw base::InputError(
                    fmt::format("Motion/{}/{}: particle {} is in group {} as well, which prescribes "
                                "the same. Make the groups apart, or leave it to one of them.",
                                motion.group, component_names[c], i + 1, first->second));
              }
    }
  } // namespace

  PrescribedMotion::PrescribedMotion(dem::Specimen                 &body,
                                     const PrescribedMotionSection &section,
                                     const ParticleGroups          &groups)
    : specimen(&body)
    , motions(section.motions.begin(), section.motions.end())
  {
    refuse_shared(motions, groups);
    for (const MotionFormulas &motion : motions)
      {
        dem::Grip grip;
        grip.particles = groups.at(motion.group);
        for (int c = 0; c < 6; ++c)
          {
            grip.prescribed[static_cast<std::size_t>(c)] = motion.component(c).given();
            varying = varying || motion.component(c).varies_in_time() || motion.component(c).varies_in_space();
          }
        grip_of[motion.group] = body.add_grip(grip);
        members.push_back(grip.particles);
      }
    lead_next_step();
  }

  void PrescribedMotion::lead_next_step()
  {
    const double          middle = specimen->time() + 0.5 * specimen->time_step();
    const Eigen::Vector3d nowhere(0, 0, 0);
    for (std::size_t g = 0; g < motions.size(); ++g)
      {
        bool by_place = false;
        for (int c = 0; c < 6; ++c)
          by_place = by_place || motions[g].component(c).varies_in_space();
        if (!by_place)
          {
            specimen->set_grip_velocity(g, value_of(motions[g].velocity, nowhere, middle),
                                        value_of(motions[g].spin, nowhere, middle));
            continue;
          }
        std::vector<Eigen::Vector3d> velocity, spin;
        for (const std::size_t i : members[g])
          {
            const Eigen::Vector3d place = specimen->particle(i).position;
            velocity.push_back(value_of(motions[g].velocity, place, middle));
            spin.push_back(value_of(motions[g].spin, place, middle));
          }
        specimen->set_grip_velocities(g, velocity, spin);
      }
  }
} // namespace apps
