#pragma once

#include "apps/models/emission.h"
#include "apps/models/gravity.h"
#include "apps/models/joints.h"
#include "apps/models/loading.h"
#include "apps/models/material.h"
#include "apps/models/mix.h"
#include "apps/models/output.h"
#include "apps/models/specimen.h"
#include "apps/models/time.h"
#include "apps/specimens/jointed_packing.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/entry_path.h"
#include "dem/specimen/specimen.h"

#include <string>
#include <vector>

namespace apps
{
  /** Everything that a uniaxial run computes from. */
  struct UniaxialModel
  {
    SpecimenSection        source;
    MixSection             mix;    ///< of the specimen
    JointSection           joints; ///< likewise
    MaterialSection        material;
    dem::Physics           physics;
    TimeSection            time;
    GravitySection         gravity;
    UniaxialLoadingSection loading;
    OutputSection          output;
    EmissionSection        emission;
    bool                   fracture_zone = false; ///< its width is a figure

    /** Rules between entries. @throws base::InputError */
    void                             check(const base::EntryPath &root) const;
    dem::SpecimenParameters          specimen() const;
    const std::vector<UniaxialLoad> &loads() const { return loading.tests; } ///< of the tests, in their order
    double                           longest_without_checkpoint() const { return output.checkpoint_interval; } ///< [s]
    dem::Packing                     packing() const { return mixed().packing(); } ///< of all tests
    MixedSpecimen                    mixed() const; ///< of which particles and links are made
    JointedPacking                   jointed(const dem::Packing &packing) const; ///< with the joints through it
    std::vector<std::string>         link_classes(const std::vector<std::string> &materials) const; ///< each once
  };
} // namespace apps
