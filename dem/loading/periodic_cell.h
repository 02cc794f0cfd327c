#pragma once

#include "dem/loading/localisation_watch.h"
#include "dem/specimen/specimen.h"

#include <array>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * One leg of the path that a periodic cell is led along. Each component moves linearly in time from where it is to its target.
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
    /** Largest |strain| that the servo may use to reach a stress; beyond, the cell cannot carry it and the run stops. */
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
   * reached by a servo on the strains of their components, E += K^-1 (stress asked next - stress now) dt/T with K the affine stiffness
   * (the stiffest answer the cell can give, hence never too large a step), and what K foretells of the imposed strains and stresses.
   */
  class CellTest
  {
  public:
    /** @throws base::InputError for parameters out of range, or a specimen without a periodic cell */
    CellTest(Specimen &specimen, const CellTestParameters &parameters);

    /**
     * Take up to the given number of steps along the path, and add one sample.
     * @throws base::NumericalError if the servo leaves the strain limit
     */
    CellSample advance(std::int64_t steps);
    bool       finished() const { return leg >= static_cast<std::int64_t>(parameters.path.size()); }

    const std::vector<CellSample>     &curve() const { return samples; }
    const std::optional<Localisation> &localisation() const { return found; }

    void visit_state(base::StateVisitor &visitor);

  private:
    void          step();
    void          begin_leg();
    base::Vector6 asked(std::int64_t step_of_leg) const;
    base::Vector6 servo(const base::Vector6 &now, const base::Vector6 &next) const;
    base::Vector6 stress() const;
    CellSample    sample() const;
    void          watch_for_localisation(CellSample &now);

    Specimen          *specimen;
    CellTestParameters parameters;
    base::Matrix6      stiffness;      ///< affine, of the undamaged cell [Pa]
    double             servo_constant; ///< T [s]

    std::int64_t        leg = 0, step_of_leg = 0, steps_of_leg = 0;
    base::Vector6       strain        = base::Vector6::Zero(); ///< imposed so far
    base::Vector6       start         = base::Vector6::Zero(); ///< of the leg: strain or stress as given
    base::Vector6       aim           = base::Vector6::Zero(); ///< of the forces as they are
    std::array<bool, 6> aim_is_stress = {};

    std::vector<CellSample>     samples;
    LocalisationWatch           watch;
    std::optional<Localisation> found;
  };
} // namespace dem
