#pragma once

#include "apps/results/run_result.h"
#include "apps/runs/sequential/model.h"
#include "apps/runs/sequential/particle_case.h"

#include <filesystem>

namespace apps
{
  /** The continuation of one case as a curve: strain and stress, or displacement and force, as the study reads them. */
  struct ContinuationCurve
  {
    std::string         name;
    double              severity = 0; ///< see ParticleOutcome
    double              absorbed = 0; ///< [J]
    double              offset   = 0; ///< strain at which the continuum's zero lies on the particles' axis
    std::vector<double> horizontal, vertical, dissipated;
    double              seconds = 0; ///< wall clock
    std::string         ended_by;    ///< see ContinuumReport

    // Of a continuation without any state nothing is known: NaN.
    double peak() const; ///< largest magnitude of the vertical values
    double horizontal_at_peak() const;
    double furthest() const;  ///< last of the horizontal values
    double energy() const;    ///< dissipated from the transfer on [J]
    bool   broke_off() const; ///< there was no equilibrium any more before its end
  };

  /** A finished continuation, a run of kind "continuum", as the study reads it. */
  ContinuationCurve curve_of(const SequentialModel::Study &study, const RunResult &continuation);

  /**
   * Mean |stress of the continuation - stress of the all-particle run| over the mean |stress| of the latter, over the strains past
   * the transfer that both have. NaN if they have none in common.
   */
  double error_against(const ContinuationCurve &curve, const ParticleOutcome &all_particles);

  /** The continuation as far as half the strain of the transfer again. */
  ContinuationCurve near_the_transfer(ContinuationCurve curve);

  /** Largest stress of the particles from the strain of a hand-over on, in magnitude; 0 where they have none. */
  double largest_from(const ParticleOutcome &all_particles, double strain);

  /** How far the continuation came within that, in strains of the transfer: 1.5 where it came all the way, 1 where it never began. */
  double near_reaches(const ContinuationCurve &curve);

  /** Units of what a study compares: "-" and "Pa", or those of the columns. */
  struct StudyUnits
  {
    std::string horizontal, vertical;
  };

  /** Table, pictures and figures of a whole study. */
  struct StudyReport
  {
    const SequentialModel                &model;
    StudyUnits                            units;
    const std::vector<ParticleOutcome>   &particles;
    const ParticleOutcome                *all_particles; ///< nullptr: none
    const std::vector<ContinuationCurve> &curves;

    std::string csv() const;
    /** Particle curves grey, continuations black; and what is left over how hard the event was. @return what went wrong, "" if nothing. */
    std::string    draw(const std::filesystem::path &file) const;
    nlohmann::json json() const;
    std::string    text() const;
    /** Continuations that leave all particles by far, or bear much more than these, each in a sentence. */
    std::vector<std::string> warnings() const;

  private:
    std::string severity_unit() const;
    std::string how_it_ended(const ContinuationCurve &curve) const;
  };
} // namespace apps
