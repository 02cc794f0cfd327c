#pragma once

#include "base/mandel.h"
#include "base/state.h"

namespace dem
{
  class ObservedSpecimen;

  /**
   * The stiffness that a servo of stresses divides by (doc/theory/periodic-cell.md, 3): the affine one of the undamaged cell, the stiffest
   * answer that the cell can give. A cell that does not resist every strain has no inverse of it: there no direction counts as softer than
   * `modulus`, and what comes to touch is followed.
   */
  class ServoStiffness
  {
  public:
    /** @throws base::InputError for a specimen without a periodic cell */
    explicit ServoStiffness(const ObservedSpecimen &specimen);

    const base::Matrix6 &value() const { return stiffness; } ///< [Pa]
    bool holds_together() const { return resists; }          ///< the cell resisted every strain when this was made
    /** Of a pressure wave along the largest height of the cell, when this was made [s]. */
    double crossing_time() const { return crossing; }
    /** Account for new contacts in a cell that did not hold together. */
    void follow(const ObservedSpecimen &specimen);

    void visit_state(base::StateVisitor &visitor);

  private:
    base::Matrix6 stiffness;
    bool          resists;
    double        modulus; ///< of the cell, or of one whose particles touch all around, whichever is larger [Pa]
    double        crossing = 0;
  };
} // namespace dem
