#pragma once

#include "apps/models/gravity.h"
#include "apps/models/grips.h"
#include "apps/models/material.h"
#include "apps/models/time.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/entry_path.h"
#include "dem/loading/impact.h"
#include "dem/loading/uniaxial.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** Section "Particles" of a sequential scene: the event that is simulated with particles, and when it is handed over. */
  struct ParticleEventSection
  {
    enum class Source
    {
      file,     ///< states that were saved before
      uniaxial, ///< a specimen between grips, handed over at given strains
      impact    ///< a beam hit by a sphere, once per velocity
    };

    /** When a uniaxial specimen is handed over: at a strain, or after going back from it to another. */
    struct Instant
    {
      double                forward;
      std::optional<double> back;
    };

    Source                   source = Source::uniaxial;
    std::vector<std::string> files; ///< of saved states
    SpecimenSection          specimen;
    MixSection               mix; ///< of the specimen
    MaterialSection          material;
    dem::Physics             physics;
    TimeSection              time;
    GravitySection           gravity;

    int                  axis        = 2;
    double               strain_rate = 0; ///< [1/s], magnitude; the sign is that of the strains
    double               back_rate   = 0; ///< [1/s]; 0: half of strain_rate
    GripEntries          grips;
    bool                 lateral_blocked = false, spin_blocked = false;
    double               end_strain = 0; ///< of the all-particle run that continuations are compared with; 0: none
    std::vector<Instant> instants;

    dem::ImpactParameters impact;
    std::vector<double>   velocities; ///< of the impactor, a run each [m/s]

    std::function<bool()> strained_too; ///< its specimen is also strained between grips, whatever the source

    void check(const base::EntryPath &root) const;

    MixedSpecimen mixed() const { return {specimen, mix, material, physics.dimension}; } ///< its particles and links

    dem::SpecimenParameters specimen_parameters() const;
    std::size_t             cases() const;
    bool                    compresses() const { return source == Source::uniaxial && instants.front().forward < 0; }

  private:
    void check_uniaxial(const base::EntryPath &section) const;
  };

  /** The packing that the cases of an event share; empty for saved states. */
  dem::Packing event_packing(const ParticleEventSection &event);

  /** The test that strains the event's specimen to that strain. */
  dem::UniaxialParameters uniaxial_parameters(const ParticleEventSection &event, double furthest);
} // namespace apps
