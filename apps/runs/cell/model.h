#pragma once

#include "apps/models/material.h"
#include "apps/models/output.h"
#include "apps/models/specimen.h"
#include "apps/models/time.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/entry_path.h"
#include "dem/loading/periodic_cell.h"
#include "dem/specimen/specimen.h"

#include <array>
#include <cstdint>
#include <string>

namespace apps
{
  /** Everything that a run of a periodic cell computes from. */
  struct CellModel
  {
    static constexpr int most_legs = 9;

    struct Leg
    {
      double duration = 0; ///< [s]
      /** "strain VALUE" or "stress VALUE", in the order of base::voigt_names. */
      std::array<std::string, 6> target = {"stress 0", "stress 0", "stress 0", "stress 0", "stress 0", "stress 0"};
    };

    SpecimenSection            source;
    MixSection                 mix; ///< of the cell
    MaterialSection            material;
    dem::Physics               physics;
    TimeSection                time;
    std::int64_t               legs = 1;
    std::array<Leg, most_legs> path;
    double                     servo_time = 1, strain_limit = 0.1, localised_above = 0.5;
    OutputSection              output;

    CellModel() { physics.periodic = true; }

    /** Rules between entries. @throws base::InputError */
    void                    check(const base::EntryPath &root) const;
    dem::SpecimenParameters specimen() const;
    MixedSpecimen mixed() const { return {source, mix, material, physics.dimension}; } ///< its particles and links
    dem::CellTestParameters loading() const;                                           ///< @pre checked
  };
} // namespace apps
