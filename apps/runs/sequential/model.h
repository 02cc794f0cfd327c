#pragma once

#include "apps/runs/continuum/model.h"
#include "apps/runs/sequential/law_identification.h"
#include "apps/runs/sequential/particle_event.h"
#include "apps/runs/sequential/transfer_section.h"
#include "base/entry_path.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace apps
{
  /** Everything that a sequential study computes from. */
  struct SequentialModel
  {
    /** Section "Study": how the continuations are read and compared. */
    struct Study
    {
      double      length = 1, area = 1; ///< strain = displacement/length [m], stress = force/area [m^2]
      std::string horizontal, vertical; ///< columns of the continuation's series
      double      sign        = 1;      ///< with which they are taken
      double      least_force = 0.05;   ///< see ContinuumRun::end_where_little_is_left()
    };

    ParticleEventSection  particles;
    TransferSection       transfer;
    IdentificationSection identification;
    ContinuumModel        continuum;
    Study                 study;

    /** Of what the constants of the mapping law belong to; empty where code has not set it. */
    struct Digests
    {
      std::string                        particles;
      std::map<std::string, std::string> materials; ///< by the group of elements
    };
    std::function<Digests()> digests;

    /** Rules between entries. @throws base::InputError */
    void check(const base::EntryPath &root) const;

    /** Groups of elements that states are transferred to. */
    std::vector<const MaterialOfGroup *> receivers() const;

    /** Of the weakest of them [Pa]. */
    double tensile_strength() const;
  };
} // namespace apps
