#pragma once

#include "apps/runs/sequential/particle_event.h"
#include "apps/specimens/static_start.h"
#include "dem/observation/discrete_state.h"

#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** What a particle run hands over, and what it was like. */
  struct ParticleOutcome
  {
    std::string         name;              ///< "strain -1.7e-3", "2 m/s", the file
    double              severity      = 0; ///< strain [-], energy of the blow [J], or the number of the file
    double              absorbed      = 0; ///< by the beam from the impactor [J]
    double              stress        = 0; ///< between the grips at the hand-over [Pa]
    double              seconds       = 0; ///< wall clock
    double              balance_error = 0;
    StaticStart         start;                      ///< if the scene requests one
    std::vector<double> curve_strain, curve_stress; ///< uniaxial only
    dem::DiscreteState  state;
  };

  /** One particle run of an event, a sample at a time. */
  class ParticleCase
  {
  public:
    virtual ~ParticleCase() = default;

    /** What moves; nullptr where a saved state is taken. */
    virtual const dem::Specimen *body() const = 0;

    /** Before the first step: what advance() would do by itself. @throws base::InputError if there is no equilibrium. */
    virtual StaticStart     settle()                                 = 0;
    virtual bool            finished() const                         = 0;
    virtual void            advance()                                = 0; ///< one sample further
    virtual double          done() const                             = 0; ///< in [0, 1]
    virtual ParticleOutcome outcome() const                          = 0;
    virtual void            visit_state(base::StateVisitor &visitor) = 0;
  };

  /** @param number from 0, below event.cases(). @throws base::InputError. */
  std::unique_ptr<ParticleCase>
  make_particle_case(const ParticleEventSection &event, const dem::Packing &packing, std::size_t number);

  /** Seconds that a case takes to its end, or to that part of it; its first samples are computed. */
  double expected_seconds(ParticleCase &particles, double part = 1);

  /** The all-particle run to the end strain; nullptr if none is requested. */
  std::unique_ptr<ParticleCase> make_reference_case(const ParticleEventSection &event, const dem::Packing &packing);
} // namespace apps
