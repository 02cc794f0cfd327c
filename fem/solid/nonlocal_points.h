#pragma once

#include "fem/solid/material_points.h"
#include "fem/solid/nonlocal_weights.h"

namespace fem
{
  /**
   * Points of damage-plastic concrete whose damage is driven by an average of kappa_D over a length: m times the mean over the
   * neighbourhood plus 1 - m times the point's own (Grassl and Jirasek, 2006b, IJNAMG 30, 71; m > 1: over-nonlocal, Vermeer and Brinkgreve, 1994).
   * Plasticity is the point's own, in effective stress, so that an answer takes two passes and no iteration: flow() for all points,
   * average(), then evaluate().
   */
  class NonlocalPoints : public MaterialPoints
  {
  public:
    explicit NonlocalPoints(const DamagePlasticConcrete &law);

    const char      *material_name() const override { return DamagePlasticConcrete::name; }
    const Stiffness &elastic_stiffness() const override { return law.elastic_stiffness(); }
    bool             linear() const override { return false; }

    /// Over which damage is averaged [m].
    double length() const { return law.parameters().nonlocal_length; }

    void allocate(std::size_t n_points) override;

    /// Who averages over whom; after allocate(). @param places [m] @param volumes [m^3]
    void place(const std::vector<Eigen::Vector3d> &places, const std::vector<double> &volumes);

    /// First pass. @throws MaterialFailure
    void flow(std::size_t point, const Voigt &strain, bool with_tangent);

    /// Between the passes, when all points have flown.
    void average();

    /// Second pass, for the strain of the first. The tangent is that at fixed average; influence() and response() are the rest.
    void evaluate(std::size_t          point,
                  const Voigt         &strain,
                  const ElementExtent &element,
                  bool                 with_tangent,
                  PointAnswer         &answer) override;

    /// d kappa_D / d strain of a point, of the last pass with tangent.
    Voigt influence(const std::size_t point) const { return flown[point].d_kappa_d.transpose(); }

    /// d stress / d averaged kappa_D of a point [Pa]; zero where the damage does not grow.
    const Voigt &response(const std::size_t point) const { return responses[point]; }

    /// d averaged kappa_D of a point / d kappa_D of the points of the row, itself among them.
    const std::vector<std::pair<std::size_t, double>> &couplings(const std::size_t point) const
    {
      return coupled[point];
    }

    void commit() override { committed = trial; }
    void set_initial(std::size_t point, const InitialPointState &given, const ElementExtent &element) override;
    void visit(std::size_t point, const StateColumn &column) override;

  private:
    DamagePlasticConcrete                                    law;
    NonlocalWeights                                          weights;
    std::vector<std::vector<std::pair<std::size_t, double>>> coupled;
    std::vector<DamagePlasticState>                          committed, trial;
    std::vector<DamagePlasticConcrete::March>                flown;
    std::vector<double>                                      driving;
    std::vector<Voigt>                                       responses;
  };
}
