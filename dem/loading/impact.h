#pragma once

#include "dem/specimen/specimen.h"

#include <cstdint>

namespace dem
{
  /**
   * A beam on two supports is hit at mid-span by a sphere. The beam lies along x between its extreme centres, the sphere comes
   * from above along -z, in two dimensions along -y.
   */
  struct ImpactParameters
  {
    double span = 0; ///< distance of the supports [m]
    double support_width =
      0; ///< [m], along the beam: bottom particles within half of it of a support cannot move up or down
    double impactor_radius   = 0;   ///< [m]
    double impactor_velocity = 0;   ///< [m/s], > 0: towards the beam
    double rest_damping      = 0.5; ///< local damping once the impactor has left, in (0, 1)
    double rest_ratio =
      1e-3;             ///< the beam is at rest when its kinetic energy is below this part of the impactor's first one
    double longest = 0; ///< [s], after which the test ends in any case, > 0
  };

  /**
   * The beam with the impactor as its last particle, just above mid-span; the specimen must leave it loose. Of a beam of several
   * materials the impactor has the first.
   * @throws base::InputError for parameters out of range
   */
  Packing with_impactor(const Packing &beam, const ImpactParameters &parameters, int dimension);

  /** One row of the record. */
  struct ImpactSample
  {
    double time;              ///< [s]
    double impactor_velocity; ///< [m/s], > 0: towards the beam
    double kinetic;           ///< of the beam [J]
    double mean_damage;       ///< of its links [-]
    double dissipated;        ///< by damage, friction and damping [J]
  };

  /** Supports and impactor of a specimen made by with_impactor(). The specimen must outlive the test. */
  class ImpactTest
  {
  public:
    enum class Episode : std::int64_t
    {
      flight, ///< the impactor has not touched the beam
      contact,
      rest, ///< it has left, and the beam comes to rest
      done
    };

    /** @throws base::InputError when a support would hold no particle */
    ImpactTest(Specimen &specimen, const ImpactParameters &parameters);

    /** Take up to the given number of steps; fewer where the test ends. */
    ImpactSample advance(std::int64_t steps);
    bool         finished() const { return episode == Episode::done; }

    double impactor_energy() const; ///< at the start [J]
    double absorbed() const;        ///< taken from the impactor so far [J]
    void   visit_state(base::StateVisitor &visitor);

  private:
    /** What decides on the episode. */
    void update();

    Specimen        *specimen;
    ImpactParameters parameters;
    std::size_t      impactor;
    int              up; ///< axis of the blow
    double           impactor_mass;
    Episode          episode = Episode::flight;
  };
} // namespace dem
