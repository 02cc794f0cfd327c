#pragma once

#include "apps/runs/particles/groups.h"
#include "apps/text/vector_formula.h"
#include "base/entry_path.h"
#include "dem/specimen/specimen.h"

#include <array>
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

    /** Of a component: x, y, z, rotation about x, y, z. */
    const Expression &component(const int c) const
    {
      return c < 3 ? velocity[static_cast<std::size_t>(c)] : spin[static_cast<std::size_t>(c - 3)];
    }
    /** A component that particles of this physics do not have is refused. @throws base::InputError. */
    void check(const base::EntryPath &section, const dem::Physics &physics) const;
  };

  /** The same of a group of section "Motion", which may also turn as a whole about an axis, as walls do. */
  struct PrescribedFormulas : MotionFormulas
  {
    Expressions           turn;                     ///< [rad/s], by time
    std::array<double, 3> centre       = {0, 0, 0}; ///< that it turns about; moves with the velocity
    bool                  centre_given = false;

    /** @throws base::InputError. */
    void check(const base::EntryPath &section, const dem::Physics &physics) const;
    bool turns() const { return any_given(turn); }
    /** Whether a component of the particles' motion is prescribed: by a formula, or by the turn. */
    bool prescribes(int component) const;
    bool by_place() const; ///< velocities differ from particle to particle
  };

  /** Section "Motion": velocities prescribed to groups. */
  struct PrescribedMotionSection
  {
    std::list<PrescribedFormulas> motions;

    /** @throws base::InputError. */
    void check(const base::EntryPath &root, const dem::Physics &physics, const GroupNames &names) const;
  };

  /** Holds and moves the groups of a specimen as a scene prescribes (doc/theory/integration.md, 5). The specimen must outlive it. */
  class PrescribedMotion
  {
  public:
    /** @throws base::InputError where two groups prescribe the same component of one particle. */
    PrescribedMotion(dem::Specimen &specimen, const PrescribedMotionSection &section, const ParticleGroups &groups);

    /** Velocities of the next step: those at its middle, of each particle where it then is. */
    void drive_next_step();
    bool varies() const { return varying; } ///< they must be driven before every step

    bool holds(const std::string &group) const { return grip_of.count(group) > 0; }
    /** Force that holds the group, where its motion is prescribed [N]. @pre it is held */
    Eigen::Vector3d reaction(const std::string &group) const;
    /** Sum of the moments that hold its particles about their own centres, likewise [N m]. */
    Eigen::Vector3d reaction_moment(const std::string &group) const;
    /** Moment of all that holds it about a point [N m]. */
    Eigen::Vector3d reaction_torque(const std::string &group, const Eigen::Vector3d &about) const
    {
      return specimen->grips().reaction_moment(grip_of.at(group), about);
    }

    /** Where what turns turns about, besides what the specimen's state has. */
    void visit_state(base::StateVisitor &visitor);

  private:
    /** Centre of a group that turns, at a time, and how it moves on from there. */
    struct Turning
    {
      Eigen::Vector3d centre = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero(); ///< [m], [m/s]
      double          time = 0;                                                             ///< [s]
    };

    void drive_alike(std::size_t group);
    void drive_by_place(std::size_t group);
    void drive_turning(std::size_t group);

    dem::Specimen                                   *specimen;
    std::vector<PrescribedFormulas>                  motions; ///< numbered as the grips
    std::vector<std::vector<std::size_t>>            members; ///< of each
    std::vector<Turning>                             turning; ///< likewise; of those that turn
    std::map<std::string, std::size_t, OrderOfNames> grip_of; ///< by group
    bool                                             varying = false;
  };
} // namespace apps
