#pragma once

#include "dem/loading/localisation_watch.h"
#include "dem/loading/servo_stiffness.h"
#include "dem/specimen/specimen.h"

#include <array>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * One leg of the path that a periodic cell is driven along. Each component moves linearly in time from where it is to its target.
   * Order 11 22 33 23 31 12, engineering shears; in the plane only 11 22 12 count.
   */
  struct CellLeg
  {
    double              duration     = 0;                     ///< [s], > 0
    std::array<bool, 6> stress_given = {};                    ///< target is a stress [Pa]; otherwise a strain [-]
    base::Vector6       target       = base::Vector6::Zero(); ///< at the end of the leg
  };

  /** How a cell test is run. */
  struct CellTestParameters
  {
    std::vector<CellLeg> path;
    /**
     * Time constant of the stress servo over the time a pressure wave needs across the cell. Longer: smoother and slower; far
     * below 1 the servo fights the cell's own waves.
     */
    double servo_time = 1;
    /** Largest |strain| that the servo may use to reach a stress; beyond, the cell cannot carry it and the path ends. */
    double strain_limit = 0.1;
    /** Concentration (see Band) of the strength lost since softening began at which it is called localised; 0.5: a band of 60 % of the cell. */
    double localised_above = 0.5;
  };

  /** One row of the cell's record, all at one instant t_n. Tension positive. */
  struct CellSample
  {
    double        time;        ///< [s]
    base::Vector6 strain;      ///< F - 1, symmetric part, engineering shears
    base::Vector6 stress;      ///< symmetric part [Pa]
    double        skew_stress; ///< largest component of the unsymmetric part [Pa]
    double        servo_error; ///< largest |stress - target| of the components with given stress [Pa]
    double        unbalanced;  ///< see Specimen::unbalanced_ratio()
    double        dissipated;  ///< by damage so far [J]
    bool          localised;
  };

  /** The prescribed stress of a leg that is furthest from its target, where the leg ends. */
  struct StressAtEnd
  {
    std::int64_t leg       = 0;         ///< from 0
    std::int64_t component = 0;         ///< in the order of the legs
    double       requested = 0, is = 0; ///< [Pa]
    double       strain   = 0;          ///< of this component
    double       largest  = 0;          ///< |stress| prescribed of any component [Pa]
    bool         at_limit = false;      ///< the strain limit has ended the leg

    /** The cell bears less than half of it, by more than waves in the other components would make of nothing. */
    bool missed() const;
    /** By more than a tenth of the largest. */
    bool inaccurate() const;
  };

  /** That, and where, the cell has ceased to stand for a homogeneous material: its average is no longer a material property. */
  struct Localisation
  {
    CellSample onset; ///< last sample before the second-order work turned negative: stress falls while strain goes on
    CellSample detected; ///< first sample at which damage since the onset is gathered in a band
    Band       band;     ///< as detected
  };

  /**
   * Leads a periodic cell along a path of strains, stresses or any mix of them (doc/theory/periodic-cell.md), and watches for
   * localisation. The specimen must outlive the test.
   *
   * The deformation is F = 1 + E with E symmetric. Strains are imposed exactly: G = ((1 + E) F^-1 - 1)/dt each step. Stresses are
   * reached by a servo on the strains of their components, E += K^-1 (stress prescribed next - stress now) dt/T with K the affine stiffness
   * (the stiffest answer the cell can give, hence never too large a step), and what K foretells of the imposed strains and stresses.
   * A cell that does not hold together is closed so slowly that its particles do not meet with more than the prescribed stress.
   *
   * The path ends before its last leg does where a leg ends and a stress is missed, or where a strain leaves the limit.
   */
  class CellTest
  {
  public:
    /** @throws base::InputError for parameters out of range, or a specimen without a periodic cell */
    CellTest(Specimen &specimen, const CellTestParameters &parameters);

    /**
     * Take up to the given number of steps along the path, and add one sample. Where the path ends one step more, in which the cell stands
     * still, finds the forces of its end.
     */
    CellSample advance(std::int64_t steps);
    bool       finished() const { return leg >= static_cast<std::int64_t>(parameters.path.size()) || not_reached(); }

    const std::vector<CellSample>     &curve() const { return samples; }
    const std::optional<Localisation> &localisation() const { return found; }
    /** Whether the cell resisted every strain at the start. */
    bool holds_together() const { return stiffness.holds_together(); }
    /** Of the legs so far that prescribe a stress. */
    const std::vector<StressAtEnd> &stresses_at_ends() const { return ends; }
    /** Whether the path has ended early, for the stress that stresses_at_ends() has last. */
    bool not_reached() const { return !ends.empty() && (ends.back().at_limit || ends.back().missed()); }

    void visit_state(base::StateVisitor &visitor);

  private:
    void        step();
    void        begin_leg();
    void        end_leg();
    void        end_at_limit(std::int64_t component);
    void        stand_still();
    StressAtEnd stress_at_end(std::int64_t component) const;
    /** The prescribed stress that is missed, or furthest from its target; none if none is prescribed. */
    std::optional<StressAtEnd> worst_at_end() const;
    base::Vector6              requested(std::int64_t step_of_leg) const;
    base::Vector6              servo(const base::Vector6 &now, const base::Vector6 &next) const;
    base::Vector6              stress() const;
    CellSample                 sample() const;
    void                       watch_for_localisation(CellSample &now);

    Specimen          *specimen;
    CellTestParameters parameters;
    ServoStiffness     stiffness;
    double             servo_constant; ///< T [s]

    std::int64_t        leg = 0, step_of_leg = 0, steps_of_leg = 0;
    base::Vector6       strain        = base::Vector6::Zero(); ///< imposed so far
    base::Vector6       start         = base::Vector6::Zero(); ///< of the leg: strain or stress as given
    base::Vector6       aim           = base::Vector6::Zero(); ///< of the forces as they are
    std::array<bool, 6> aim_is_stress = {};

    std::vector<CellSample>     samples;
    std::vector<StressAtEnd>    ends;
    LocalisationWatch           watch;
    std::optional<Localisation> found;
  };
} // namespace dem
