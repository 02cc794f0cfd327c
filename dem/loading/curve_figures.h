#pragma once

#include "dem/core/column.h"
#include "dem/core/state.h"

namespace dem
{
  /** What a stress-strain curve says so far. Stresses and strains as magnitudes. */
  struct UniaxialFigures
  {
    /** Least-squares slope through the origin up to a third of the largest stress [Pa]; 0: not determined. */
    double young_modulus  = 0;
    double strength       = 0; ///< largest stress in the direction of the load [Pa]; 0: there was none
    double strain_at_peak = 0; ///< [-]
    /** Loaded well beyond that stress: then it is the strength. Otherwise the stress may still grow. */
    bool peak_passed = false;

    bool modulus_found() const { return young_modulus > 0; }
  };

  /**
   * Takes every point of a curve and keeps what its figures need. The modulus wants a third of a peak that nobody knows yet: sums are
   * noted whenever the stress has grown by a hundredth, so that its last point may lie that much beyond the third.
   */
  class CurveFigures
  {
  public:
    /** The next point, positive in the direction of the load. @return whether no stress was as large before */
    bool            add(double strain, double stress);
    UniaxialFigures figures() const;
    double          largest_stress() const { return strength; }
    void            visit_state(StateVisitor &visitor);

  private:
    double strength = 0, strain_at_peak = 0;
    double product = 0, square = 0; ///< sums of stress times strain and of strain squared, up to now
    Column notes;                   ///< records: stress, sums of all points before it was first reached
  };
} // namespace dem
