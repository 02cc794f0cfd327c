#pragma once

#include "base/column.h"
#include "base/state.h"

namespace dem
{
  /** What a stress-strain curve says so far. Stresses and strains as magnitudes. */
  struct UniaxialFigures
  {
    /** Least-squares slope through the origin up to a third of the largest stress [Pa]; 0: not determined. */
    double young_modulus  = 0;
    double strength       = 0; ///< largest stress in the direction of the load [Pa]; 0: there was none
    double strain_at_peak = 0; ///< [-]
    double work           = 0; ///< area under the curve, from rest along straight lines [J/m^3]
    double last_stress    = 0; ///< at its end [Pa]
    /** See is_past_peak(): then the largest stress is the strength. Otherwise it may still grow. */
    bool peak_passed = false;

    bool modulus_found() const { return young_modulus > 0; }
  };

  /** Of its largest: a stress that low has fallen for good. A cascade of cracks may take a tenth, after which the stress grows again. */
  constexpr double fallen_part = 0.8;
  /** Of the strain at the largest stress: a test that has gone as far without a larger one is past its peak. */
  constexpr double past_peak_strain = 1.5;

  /**
   * Whether the largest stress of a curve of equilibria that ends here is its peak, and not the begin of a local drop: the stress has
   * fallen to fallen_part of it, or to the part at which the user ends the test if that is more, or the strain has gone far beyond.
   * @param strain, stress at the end, magnitudes @param stop_fraction part of the peak at which the test ends; 0: none
   */
  bool is_past_peak(const UniaxialFigures &figures, double strain, double stress, double stop_fraction);

  /**
   * Takes every point of a curve and keeps what its figures need. The modulus needs a third of a peak that is not known yet: sums are
   * noted whenever the stress has grown by a hundredth, so that its last point may lie that much beyond the third.
   */
  class CurveFigures
  {
  public:
    /** The next point, positive in the direction of the load. @return whether no stress was as large before */
    bool            add(double strain, double stress);
    UniaxialFigures figures() const;
    double          largest_stress() const { return strength; }
    void            visit_state(base::StateVisitor &visitor);

  private:
    double       strength = 0, strain_at_peak = 0;
    double       product = 0, square = 0; ///< sums of stress times strain and of strain squared, up to now
    double       area = 0, last_strain = 0, last_stress = 0;
    base::Column notes; ///< records: stress, sums of all points before it was first reached
  };
} // namespace dem
