#include "apps/runs/particles/motion.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace apps
{
  namespace
  {
    const char *const component_names[6] = {"Velocity x", "Velocity y", "Velocity z", "Spin x", "Spin y", "Spin z"};
    const char *const turn_names[3]      = {"Turn x", "Turn y", "Turn z"};

    /** Whether particles have this velocity at all. */
    bool exists(const int c, const dem::Physics &physics)
    {
      if (c >= 3 && !physics.rotations)
        return false;
      return physics.dimension == 3 || c < 2 || c == 5;
    }
  } // namespace

  void MotionFormulas::check(const base::EntryPath &section, const dem::Physics &physics) const
  {
    for (int c = 0; c < 6; ++c)
      if (component(c).given() && !exists(c, physics))
        section.refuse(component_names[c], physics.rotations ?
                                             "in two dimensions particles move along x and y, and spin about z." :
                                             "particles do not spin (Physics/Rotations = false). Leave it out.");
  }

  bool PrescribedFormulas::prescribes(const int c) const
  {
    const auto about      = [this](const int axis) { return turn[static_cast<std::size_t>(axis)].given(); };
    const int  axes       = about(0) + about(1) + about(2);
    const bool is_of_turn = axes >= 2 || (axes == 1 && (c < 3 ? !about(c) : about(c - 3)));
    return component(c).given() || is_of_turn;
  }

  bool PrescribedFormulas::by_place() const
  {
    for (int c = 0; c < 6; ++c)
      if (component(c).varies_in_space())
        return true;
    return false;
  }

  void PrescribedFormulas::check(const base::EntryPath &section, const dem::Physics &physics) const
  {
    MotionFormulas::check(section, physics);
    if (!turns() && centre_given)
      section.refuse("Centre", "the group does not turn. Give Turn x, y or z, or leave it out.");
    if (!turns())
      return;
    PrescribedFormulas turn_alone;
    turn_alone.turn = turn;
    for (int axis = 0; axis < 3; ++axis)
      {
        if (physics.dimension == 2 && axis < 2 && turn[static_cast<std::size_t>(axis)].given())
          section.refuse(turn_names[axis], "in two dimensions a group turns about z.");
        if (turn[static_cast<std::size_t>(axis)].varies_in_space())
          section.refuse(turn_names[axis], "a group turns as a rigid body: a formula of t alone.");
        if (velocity[static_cast<std::size_t>(axis)].varies_in_space())
          section.refuse(component_names[axis], "a group that turns moves as a rigid body: a formula of t alone.");
        if (spin[static_cast<std::size_t>(axis)].given() && turn_alone.prescribes(3 + axis))
          section.refuse(component_names[3 + axis], "the turn prescribes it already. Leave it out.");
      }
  }

  void PrescribedMotionSection::check(const base::EntryPath &root,
                                      const dem::Physics    &physics,
                                      const GroupNames      &names) const
  {
    const base::EntryPath all = root.at("Motion");
    for (const PrescribedFormulas &motion : motions)
      names.require_section(all, motion.group);
    for (const PrescribedFormulas &motion : motions)
      motion.check(all.at(motion.group), physics);
  }

  namespace
  {
    void refuse_shared(const std::vector<PrescribedFormulas> &motions, const ParticleGroups &groups)
    {
      std::map<std::pair<std::size_t, int>, std::string> taken; // (particle, component) -> group
      for (const PrescribedFormulas &motion : motions)
        for (int c = 0; c < 6; ++c)
          if (motion.prescribes(c))
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

    void refuse_pebbles(const dem::ObservedSpecimen    &body,
                        const std::string              &group,
                        const std::vector<std::size_t> &particles)
    {
      for (const std::size_t i : particles)
        if (body.clumps().of(i))
          throw base::InputError(
            fmt::format("Motion/{}: particle {} is a pebble of a clump, which moves as a whole and "
                        "cannot be held. Leave it free, or hold particles that are none.",
                        group, i + 1));
    }
  } // namespace

  PrescribedMotion::PrescribedMotion(dem::Specimen                 &body,
                                     const PrescribedMotionSection &section,
                                     const ParticleGroups          &groups)
    : specimen(&body)
    , motions(section.motions.begin(), section.motions.end())
    , turning(motions.size())
  {
    refuse_shared(motions, groups);
    for (std::size_t g = 0; g < motions.size(); ++g)
      {
        const PrescribedFormulas &motion = motions[g];
        dem::Grip                 grip;
        grip.particles = groups.at(motion.group);
        refuse_pebbles(body, motion.group, grip.particles);
        for (int c = 0; c < 6; ++c)
          {
            grip.prescribed[static_cast<std::size_t>(c)] =
              motion.prescribes(c) && exists(c, specimen->parameters().physics);
            varying = varying || motion.component(c).varies_in_time();
          }
        varying               = varying || motion.by_place() || motion.turns();
        turning[g].centre     = Eigen::Vector3d(motion.centre[0], motion.centre[1], motion.centre[2]);
        grip_of[motion.group] = body.grips().add(grip);
        members.push_back(grip.particles);
      }
    drive_next_step();
  }

  void PrescribedMotion::drive_next_step()
  {
    for (std::size_t g = 0; g < motions.size(); ++g)
      motions[g].turns() ? drive_turning(g) : motions[g].by_place() ? drive_by_place(g) : drive_alike(g);
  }

  void PrescribedMotion::drive_alike(const std::size_t g)
  {
    const double          middle = specimen->time() + 0.5 * specimen->time_step();
    const Eigen::Vector3d nowhere(0, 0, 0);
    specimen->grips().set_velocity(g, value_of(motions[g].velocity, nowhere, middle),
                                   value_of(motions[g].spin, nowhere, middle));
  }

  namespace
  {
    /**
     * Velocity by the implicit midpoint rule: that of the place where the particle is in the middle of a step at this velocity. It leaves
     * particles on their circles, which that of the place where the step begins does not. What is not prescribed goes on as it did.
     */
    Eigen::Vector3d velocity_at_middle(const MotionFormulas     &motion,
                                       const dem::ParticleState &now,
                                       const double              time,
                                       const double              step)
    {
      constexpr int    rounds = 8; // each gains the angle of half a step, some thousandths
      constexpr double enough = 1e-12;
      Eigen::Vector3d  found  = now.velocity;
      for (int round = 0; round < rounds; ++round)
        {
          const Eigen::Vector3d before = found, place = now.position + 0.5 * step * before;
          const Eigen::Vector3d requested = value_of(motion.velocity, place, time + 0.5 * step);
          for (int c = 0; c < 3; ++c)
            if (motion.component(c).given())
              found[c] = requested[c];
          if ((found - before).norm() <= enough * found.norm())
            break;
        }
      return found;
    }
  } // namespace

  void PrescribedMotion::drive_by_place(const std::size_t g)
  {
    const double                 now = specimen->time(), step = specimen->time_step();
    std::vector<Eigen::Vector3d> velocity, spin;
    for (const std::size_t i : members[g])
      {
        const dem::ParticleState state = specimen->particle(i);
        velocity.push_back(velocity_at_middle(motions[g], state, now, step));
        spin.push_back(value_of(motions[g].spin, state.position + 0.5 * step * velocity.back(), now + 0.5 * step));
      }
    specimen->grips().set_velocities(g, velocity, spin);
  }

  void PrescribedMotion::drive_turning(const std::size_t g)
  {
    const double          now = specimen->time(), step = specimen->time_step(), middle = now + 0.5 * step;
    const Eigen::Vector3d nowhere(0, 0, 0), turn = value_of(motions[g].turn, nowhere, middle);
    Turning              &about = turning[g];
    about.centre += (now - about.time) * about.velocity;
    about.time                           = now;
    about.velocity                       = value_of(motions[g].velocity, nowhere, middle);
    const double                 rate    = turn.norm();
    const Eigen::Vector3d        axis    = rate > 0 ? Eigen::Vector3d(turn / rate) : Eigen::Vector3d::UnitZ();
    const Eigen::Matrix3d        rotated = Eigen::AngleAxisd(step * rate, axis).toRotationMatrix();
    const Eigen::Vector3d        own     = value_of(motions[g].spin, nowhere, middle);
    std::vector<Eigen::Vector3d> velocity, spin;
    for (const std::size_t i : members[g])
      {
        const Eigen::Vector3d arm = specimen->particle(i).position - about.centre;
        velocity.push_back(about.velocity + (rotated * arm - arm) / step); // along the chord: to where it then is
        spin.push_back(turn + own);
      }
    specimen->grips().set_velocities(g, velocity, spin);
  }

  Eigen::Vector3d PrescribedMotion::reaction(const std::string &group) const
  {
    const std::size_t g     = grip_of.at(group);
    Eigen::Vector3d   force = specimen->grips().reaction(g);
    for (int c = 0; c < 3; ++c)
      if (!motions[g].prescribes(c))
        force[c] = 0; // what is free is accelerated by the rest
    return force;
  }

  Eigen::Vector3d PrescribedMotion::reaction_moment(const std::string &group) const
  {
    const std::size_t g      = grip_of.at(group);
    Eigen::Vector3d   moment = specimen->grips().reaction_moment(g);
    for (int c = 0; c < 3; ++c)
      if (!motions[g].prescribes(3 + c))
        moment[c] = 0;
    return moment;
  }

  void PrescribedMotion::visit_state(base::StateVisitor &visitor)
  {
    for (std::size_t g = 0; g < motions.size(); ++g)
      if (motions[g].turns())
        {
          const std::string name = "turn/" + std::to_string(g);
          for (int c = 0; c < 3; ++c)
            {
              visitor.scalar(name + "/centre_" + std::to_string(c), turning[g].centre[c]);
              visitor.scalar(name + "/velocity_" + std::to_string(c), turning[g].velocity[c]);
            }
          visitor.scalar(name + "/time", turning[g].time);
        }
  }
} // namespace apps
