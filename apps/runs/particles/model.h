#pragma once

#include "apps/models/emission.h"
#include "apps/models/gravity.h"
#include "apps/models/joints.h"
#include "apps/models/output.h"
#include "apps/models/precice.h"
#include "apps/models/time.h"
#include "apps/runs/particles/clumps.h"
#include "apps/runs/particles/forces.h"
#include "apps/runs/particles/initial_velocity.h"
#include "apps/runs/particles/laboratory_section.h"
#include "apps/runs/particles/more_particles.h"
#include "apps/runs/particles/probes.h"
#include "apps/runs/particles/stops.h"
#include "apps/specimens/jointed_packing.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/entry_path.h"
#include "postprocess/files/series.h"

#include <limits>

namespace apps
{
  /** Everything that a scene of kind "particles" says. */
  struct ParticlesModel
  {
    SpecimenSection         source;
    MixSection              mix;    ///< of the specimen
    JointSection            joints; ///< through the specimen; none where it is part of a larger model
    MoreParticlesSection    more;
    MaterialSection         material;
    dem::Physics            physics;
    TimeSection             time;
    double                  end_time = 0; ///< [s]; 0: the test of the laboratory ends it
    GravitySection          gravity;
    GroupsSection           groups;
    ClumpsSection           clumps;
    PrescribedMotionSection motion;
    ForcesSection           forces;
    WallsSection            walls;
    InitialVelocitySection  initial_velocity;
    ProbesSection           probes;
    SpecimenTestSection     laboratory;
    StopsSection            stops;
    OutputSection           output;
    EmissionSection         emission;
    PreciceSection          precice;
    std::string             horizontal, vertical; ///< columns of the curve, as the scene names them

    /** @throws base::InputError. */
    void check(const base::EntryPath &root) const;
    /** The same but for the course. @return the names of its groups */
    GroupNames check_as_part(const base::EntryPath &root) const;

    /** Whether the law links particles from the start. @pre validated */
    bool bonded() const { return material.materials().bonds(physics)->bonds(); }
    /** Particles and where the groups of them are. @param keeps particles of the specimen at a place; empty: all @param cell as specimen_particles() has it @throws base::InputError, and as make_packing() */
    dem::Packing packing(const std::function<bool(const Eigen::Vector3d &)> &keeps = {},
                         std::optional<dem::Packing>                        *cell  = nullptr) const;
    /** @param packing as packing() makes it */
    ParticleGroups          groups_in(const dem::Packing &packing) const;
    dem::SpecimenParameters parameters() const;
    /** The specimen's particles and links; what is beside it is of the first material, with a mix of the mortar. */
    MixedSpecimen mixed() const { return {source, mix, material, physics.dimension}; }
    /** Of all particles. @param packing as packing() makes it */
    dem::LinkMaterials materials(const dem::Packing &packing) const
    {
      return mixed().materials(packing.material_names);
    }
    /** A packing with the joints through it. @throws base::InputError */
    JointedPacking jointed(const dem::Packing &packing) const;

    /** When the run ends in any case [s]. */
    double last_time() const { return end_time > 0 ? end_time : std::numeric_limits<double>::infinity(); }

    /** Of series.csv; the first is the time. */
    std::vector<postprocess::SeriesColumn> columns() const;
    std::vector<std::string>               column_names() const;
    std::vector<std::string>               names_before_test() const; ///< of probes
    /** Of curve.png: a test of the laboratory draws its own, better one, unless the scene names columns. */
    bool draws_curve() const { return !laboratory.given() || !horizontal.empty() || !vertical.empty(); }
    /** What is over what. @throws base::InputError. */
    std::string curve_horizontal() const;
    std::string curve_vertical() const;
  };
} // namespace apps
