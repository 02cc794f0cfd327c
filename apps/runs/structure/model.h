#pragma once

#include "apps/models/gravity.h"
#include "apps/models/material.h"
#include "apps/models/region.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/coupled/handshakes.h"
#include "apps/runs/coupled/particle_medium.h"
#include "apps/runs/structure/bending_test.h"
#include "apps/runs/structure/probes.h"
#include "apps/runs/structure/supports.h"
#include "apps/runs/structure/wedge_splitting.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/entry_path.h"
#include "dem/model/particles.h"
#include "dem/statics/quasi_static_path.h"

#include <list>
#include <string>

namespace apps
{
  /** Sub-section of "Voids": a place without particles, as a notch is, and without links across it. */
  struct VoidSection
  {
    std::string name;
    Region      region;
  };

  /** Section "Path": how a structure is driven along its equilibria. */
  struct PathSection
  {
    double            end = 0, step = 0, stop_fraction = 0.2, growth_step = 0.2, tolerance = 1e-7, damping = 0.7;
    dem::SolverMethod solver = dem::SolverMethod::automatic;
    std::string       leading; ///< probe whose growth leads the path; empty: the load factor does
    double            opening_step = 0, end_opening = 0; ///< of that probe [m]

    /** @throws base::InputError @param probes that may lead */
    void check(const base::EntryPath &root, const DisplacementProbesSection &probes) const;
    /** Without what leads it. @param ranks that follow the path together; null: this process alone */
    dem::QuasiStaticParameters parameters(dem::Ranks *ranks) const;
  };

  /** Everything that a scene of kind "structure" says. */
  struct StructureModel
  {
    SpecimenSection           source;
    MixSection                mix; ///< of the specimen
    MaterialSection           material;
    int                       dimension = 3;
    bool                      rotations = true;
    std::list<VoidSection>    voids;
    GroupsSection             groups;
    ParticleSupportsSection   supports;
    DisplacementProbesSection probes;
    ContinuumModel            continuum = ContinuumModel::of_each_rank(); ///< where there are handshakes
    HandshakesSection         handshakes;
    GravitySection            gravity;
    PathSection               path;
    BendingTestSection        bending_test;
    WedgeSplittingSection     wedge_splitting;
    std::int64_t              snapshot_interval   = 20; ///< points of the path
    double                    checkpoint_interval = 600;
    std::string               horizontal, vertical; ///< columns of the curve, as the scene names them

    /** @throws base::InputError */
    void check(const base::EntryPath &root) const;

    bool has_solid() const { return !handshakes.empty(); }
    bool is_void(const Eigen::Vector3d &place) const;
    bool is_void_between(const Eigen::Vector3d &one, const Eigen::Vector3d &other) const;
    /** The particles and their links, of which some may be left out. */
    MixedSpecimen mixed() const { return {source, mix, material, dimension}; }
    /** @param packing as packing() makes it, or a part of it */
    dem::LinkMaterials materials(const dem::Packing &packing) const
    {
      return mixed().materials(packing.material_names);
    }
    /** Of the specimen what is in no void and, beside a solid, may come to be in a region or its overlap. @param cell as specimen_particles() has it @throws as make_packing() */
    dem::Packing packing(std::optional<dem::Packing> *cell = nullptr) const;
    /** Of the particles, where there is a solid and they are known. @param cell as packing() gives it */
    ParticleMedia  media(const std::optional<dem::Packing> &cell) const;
    ParticleGroups groups_in(const dem::Packing &packing) const;
    /** Links of all particles that are near enough. @throws as dem::make_network() */
    dem::ElasticNetwork linked(const dem::Packing &packing) const;
    /** The same but those that would cross a void. */
    dem::ElasticNetwork network(const dem::Packing &packing) const;
    /** Of each particle [N]. */
    std::vector<Eigen::Vector3d> weights(const dem::Packing &packing) const;
    /** The particles alone, held, driven and, where there is gravity, heavy. @throws base::InputError */
    dem::LoadedNetwork particles(const dem::Packing &packing, const ParticleGroups &groups) const;
    dem::ParticleShape shape() const { return {dimension, 0, source.thickness}; }
    dem::Physics       physics() const;
  };
} // namespace apps
