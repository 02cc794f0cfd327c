#pragma once

#include "fem/materials/mixed_target.h"
#include "fem/materials/point_quantity.h"

namespace fem
{
  struct ElementExtent;

  /// One point of a material, of whatever kind, driven from row to row of a path.
  class DrivenPoint
  {
  public:
    virtual ~DrivenPoint() = default;

    /// Goes to a target, see solve_mixed(). @param stress_unit [Pa] against which the residual is measured
    /// @throws MaterialFailure where it cannot be reached; the point is then where it was.
    virtual void
    go_to(const MixedTarget &target, const ElementExtent &element, double stress_unit, Increments increments) = 0;

    virtual const base::Voigt &strain() const = 0;
    virtual const base::Voigt &stress() const = 0; ///< [Pa]
    virtual int                parts() const  = 0; ///< into which the last step was divided

    virtual const base::Stiffness &elastic_stiffness() const = 0;

    /// How the material itself wants the rows of a path to be taken.
    virtual Increments increments() const = 0;

    virtual void visit(const StateColumn &column) = 0;
  };
}
