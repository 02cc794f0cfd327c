#pragma once

#include "apps/drivers/particles/groups.h"
#include "apps/scene/vector_formula.h"
#include "dem/specimen/specimen.h"

#include <list>
#include <map>
#include <string>
#include <vector>

namespace apps
{
  /** Velocities that formulas give to the particles of a group; a component without a formula is free. */
  struct MotionFormulas
  {
    std::string group;
    Expressions velocity, spin; ///< [m/s], [rad/s]

    void declare(Section &section, const std::string &when);
    /** Of a component: x, y, z, rotation about x, y, z. */
    const Expression &component(const int c) const
    {
      return c < 3 ? velocity[static_cast<std::size_t>(c)] : spin[static_cast<std::size_t>(c - 3)];
    }
    /** A component that particles of this physics do not have is refused. @throws base::InputError. */
    void validate(const Section &section, const dem::Physics &physics) const;
  };

  /** Section "Motion": velocities prescribed to groups. */
  struct PrescribedMotionSection
  {
    std::list<MotionFormulas> motions;

    void declare(Section &root);
    /** @throws base::InputError. */
    void validate(const Section &root, const dem::Physics &physics, const GroupNames &names) const;
  };

  /** Holds and moves the groups of a specimen as a scene prescribes. The specimen must outlive it. */
  class PrescribedMotion
  {
  public:
    /** @throws base::InputError where two groups prescribe the same component of one particle. */
    PrescribedMotion(dem::Specimen &specimen, const PrescribedMotionSection &section, const ParticleGroups &groups);

    /** Velocities of the next step: those at its middle. */
    void lead_next_step();
    bool varies() const { return varying; } ///< in time: they must be led before every step

    bool holds(const std::string &group) const { return grip_of.count(group) > 0; }
    /** Force that holds the group [N]. @pre it is held */
    Eigen::Vector3d reaction(const std::string &group) const { return specimen->reaction(grip_of.at(group)); }
    /** Sum of the moments that hold its particles about their own centres [N m]. */
    Eigen::Vector3d reaction_moment(const std::string &group) const
    {
      return specimen->reaction_moment(grip_of.at(group));
    }

  private:
    dem::Specimen                                   *specimen;
    std::vector<MotionFormulas>                      motions; ///< numbered as the grips
    std::vector<std::vector<std::size_t>>            members; ///< of each
    std::map<std::string, std::size_t, OrderOfNames> grip_of; ///< by group
    bool                                             varying = false;
  };
} // namespace apps
