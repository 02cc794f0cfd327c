#pragma once

#include "fem/points/material_points.h"

#include <utility>

namespace fem
{
  /**
   * Points whose damage is driven by an average over a length: m times the mean over the neighbourhood plus 1 - m times the point's own
   * (Grassl and Jirasek, 2006b, IJNAMG 30, 71; m > 1: over-nonlocal, Vermeer and Brinkgreve, 1994). All else is the point's own,
   * so that an answer takes two passes and no iteration: flow() for all points, average(), then evaluate().
   */
  class AveragedPoints : public MaterialPoints
  {
  public:
    /// Sets the neighbours of each average; after allocate(). @param places [m] @param volumes [m^3]
    virtual void place(const std::vector<Eigen::Vector3d> &places, const std::vector<double> &volumes) = 0;

    /// First pass. @throws MaterialFailure
    virtual void flow(std::size_t point, const base::Voigt &strain, bool with_tangent) = 0;

    /// Between the passes, when all points have flown. The second is evaluate(), for the strain of the first; its tangent is that at
    /// fixed average, and influence() and response() are the rest.
    virtual void average() = 0;

    /// d driving variable / d strain of a point, of the last pass with tangent.
    virtual base::Voigt influence(std::size_t point) const = 0;

    /// d stress / d averaged variable of a point [Pa]; zero where the damage does not grow.
    virtual const base::Voigt &response(std::size_t point) const = 0;

    /// d averaged variable of a point / d variable of the points of the row, itself among them.
    virtual const std::vector<std::pair<std::size_t, double>> &couplings(std::size_t point) const = 0;
  };
}
