#pragma once

#include "apps/drivers/parts/static_start.h"
#include "apps/scene/grip_entries.h"
#include "apps/scene/material_section.h"
#include "apps/scene/specimen_section.h"
#include "apps/scene/time_section.h"
#include "dem/loading/impact.h"
#include "dem/loading/uniaxial.h"
#include "dem/observation/discrete_state.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** Section "Particles" of a sequential scene: the event that is simulated with particles, and when it is handed over. */
  struct ParticleStageSection
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

    Source          source = Source::uniaxial;
    std::string     files; ///< between commas
    SpecimenSection specimen;
    MaterialSection material;
    dem::Physics    physics;
    TimeSection     time;
    GravitySection  gravity;

    int         axis        = 2;
    double      strain_rate = 0; ///< [1/s], magnitude; the sign is that of the strains
    double      back_rate   = 0; ///< [1/s]; 0: half of strain_rate
    GripEntries grips;
    bool        lateral_blocked = false, spin_blocked = false;
    double      end_strain = 0; ///< of the all-particle run that continuations are compared with; 0: none
    std::string instants;

    dem::ImpactParameters impact;
    std::string           velocities;

    std::function<bool()> strained_too; ///< its specimen is also strained between grips, whatever the source

    void declare(Section &root);
    void validate(const Section &root) const;

    std::vector<Instant>     instants_asked() const;
    std::vector<double>      velocities_asked() const;
    std::vector<std::string> files_asked() const;
    dem::SpecimenParameters  specimen_parameters() const;
    std::size_t              cases() const;
    bool compresses() const { return source == Source::uniaxial && instants_asked().front().forward < 0; }
  };

  /** The test that strains the stage's specimen to that strain. */
  dem::UniaxialParameters uniaxial_parameters(const ParticleStageSection &stage, double furthest);

  /** What a particle run hands over, and what it was like. */
  struct ParticleOutcome
  {
    std::string         name;              ///< "strain -1.7e-3", "2 m/s", the file
    double              severity      = 0; ///< strain [-], energy of the blow [J], or the number of the file
    double              absorbed      = 0; ///< by the beam from the striker [J]
    double              stress        = 0; ///< between the grips at the hand-over [Pa]
    double              seconds       = 0; ///< wall clock
    double              balance_error = 0;
    StaticStart         start;                      ///< if the scene asks for one
    std::vector<double> curve_strain, curve_stress; ///< uniaxial only
    dem::DiscreteState  state;
  };

  /** One particle run of a stage, a sample at a time. */
  class ParticleCase
  {
  public:
    virtual ~ParticleCase() = default;

    /** What moves; nullptr where a saved state is taken. */
    virtual const dem::Specimen *body() const = 0;

    /** Before the first step: what advance() would do by itself. @throws dem::InputError if there is no equilibrium. */
    virtual StaticStart     settle()                                = 0;
    virtual bool            finished() const                        = 0;
    virtual void            advance()                               = 0; ///< one sample further
    virtual double          done() const                            = 0; ///< in [0, 1]
    virtual ParticleOutcome outcome() const                         = 0;
    virtual void            visit_state(dem::StateVisitor &visitor) = 0;
  };

  /** The packing that the cases of a stage share; empty for saved states. */
  dem::Packing stage_packing(const ParticleStageSection &stage);

  /** @param number from 0, below stage.cases(). @throws dem::InputError. */
  std::unique_ptr<ParticleCase>
  make_particle_case(const ParticleStageSection &stage, const dem::Packing &packing, std::size_t number);

  /** Seconds that a case takes to its end, or to that part of it; its first samples are computed. */
  double expected_seconds(ParticleCase &particles, double part = 1);

  /** The all-particle run to the end strain; nullptr if none is asked for. */
  std::unique_ptr<ParticleCase> make_reference_case(const ParticleStageSection &stage, const dem::Packing &packing);
} // namespace apps
