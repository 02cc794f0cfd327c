#pragma once

#include "base/state.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace apps
{
  /** Of amounts at places: how much in all, with the first and second moments of where. */
  struct SpreadAmount
  {
    double          amount = 0;
    Eigen::Vector3d first  = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

    void add(double more, const Eigen::Vector3d &place);
    /** Mean square distances from the middle, products in the others [m^2]; of a positive amount. */
    Eigen::Matrix3d covariance() const;

    void visit_state(base::StateVisitor &visitor, const std::string &name);
  };

  SpreadAmount operator-(const SpreadAmount &all, const SpreadAmount &part);

  /**
   * The zone in which a body fails: where it dissipates energy once its load has fallen to 0.8 of the peak, when all but that zone unloads.
   * Its width is what a continuum without size of its own cannot have; compared with that of particles it gives the length of a nonlocal
   * one (P. Grassl, D. Xenos, M. Jirasek, M. Horak, Int. J. Solids Struct. 51 (2014) 3239; doc/theory/late-transfers.md, 9).
   */
  class FractureZone
  {
  public:
    /** The next state. @param load that the body bears, in magnitude @param dissipated by it so far [J], at undeformed places */
    void note(double load, const SpreadAmount &dissipated);

    /**
     * Of an even zone with the same standard deviation along the axis in which that is least, across the crack [m]. Nothing where nothing
     * has been dissipated since the load fell.
     */
    std::optional<double> width(int dimension) const;

    void visit_state(base::StateVisitor &visitor);

  private:
    static constexpr double has_fallen = 0.8; ///< part of the peak; nearer to it losses are still spread over the body

    double       peak = 0;
    SpreadAmount before, last; ///< when the load last was not below that; now
  };
} // namespace apps
