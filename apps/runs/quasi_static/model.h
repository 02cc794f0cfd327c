#pragma once

#include "apps/models/joints.h"
#include "apps/models/loading.h"
#include "apps/models/material.h"
#include "apps/models/specimen.h"
#include "apps/specimens/jointed_packing.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/entry_path.h"
#include "dem/statics/quasi_static_path.h"

#include <cstdint>
#include <vector>

namespace apps
{
  /** Everything that a quasi-static run computes from. */
  struct QuasiStaticModel
  {
    struct Test
    {
      double strain_step = 0, stop_fraction = 0, stop_strain = 0;
    };

    SpecimenSection           source;
    MixSection                mix;    ///< of the specimen
    JointSection              joints; ///< likewise; of one with ends
    int                       dimension = 3;
    bool                      rotations = true;
    MaterialSection           material;
    std::vector<UniaxialLoad> tests = {UniaxialLoad::tension, UniaxialLoad::compression};
    int                       axis  = 2;
    GripEntries               grips; ///< of a specimen with ends
    bool                      lateral_blocked = false, spin_blocked = false, grips_turn = false;
    Test                      tension{1e-5, 0.2, 1e-3}, compression{5e-5, 0.7, 5e-3};
    double                    growth_step = 0.2, tolerance = 1e-7, damping = 0.7;
    dem::SolverMethod         linear_solver       = dem::SolverMethod::automatic;
    std::int64_t              snapshot_interval   = 20; ///< points; enough to see a crack grow
    double                    checkpoint_interval = 600;

    /** Rules between entries. @throws base::InputError */
    void check(const base::EntryPath &root) const;

    const std::vector<UniaxialLoad> &loads() const { return tests; } ///< of the tests, in their order
    double                           longest_without_checkpoint() const { return checkpoint_interval; } ///< [s]
    dem::Packing                     packing() const { return mixed().packing(); } ///< of all tests
    MixedSpecimen                    mixed() const { return {source, mix, material, dimension}; }
    bool                             is_cell() const { return source.body == SpecimenSection::Body::cell; }
    dem::QuasiStaticParameters       steps(UniaxialLoad load) const;
    /** @throws base::InputError when the packing cannot be gripped so */
    dem::GripLayers grip_layers(const dem::Packing &packing) const;
    /** A packing with the joints through it. @throws base::InputError */
    JointedPacking jointed(const dem::Packing &packing) const { return {joints, source, packing, dimension}; }
    /** Of the links of such a packing. */
    dem::LinkMaterials materials(const JointedPacking &packing) const
    {
      return packing.materials(mixed().materials(packing.packing().material_names));
    }
    /** @throws base::InputError when the packing cannot be gripped so, or has no links */
    dem::LoadedNetwork load(const JointedPacking &packing) const;
  };
} // namespace apps
