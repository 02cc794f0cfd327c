#pragma once

#include "dem/linear/minimal_residuals.h"
#include "dem/network/loaded_network.h"

#include <array>
#include <vector>

namespace dem
{
  /**
   * The linearised equilibrium of a loaded network without body and ties, links of any stiffness, by iteration: GMRES with an
   * incomplete factor of the same matrix. In space it needs a thirtieth of the time of a factor (doc/theory/periodic-cell.md, 5).
   *
   * A tiny part of the undamaged diagonal is added to the factor, so that particles that nothing holds do not stop it; the solution
   * knows nothing of it.
   */
  class TangentIteration
  {
  public:
    /** @param loaded must outlive this object */
    explicit TangentIteration(const LoadedNetwork &loaded);

    /**
     * @param stiffness of each link, force and moment per slip and relative rotation [N/m], [N m]
     * @return false if it cannot be factorised
     */
    bool set(const std::vector<base::Matrix6> &stiffness);

    /**
     * @param force and moment on each particle [N], [N m], zero where held
     * @param accuracy largest residual over the forces
     * @param motion out [m], [-] @return false if it was not reached
     */
    bool solve(const CarrierMotions &force, double accuracy, CarrierMotions &motion);

    using Six = std::array<CarrierMotions, 6>;
    /** The same of six forces at once. @param motion in: where to start, or empty @param left_over force that they leave over [N], [N m] */
    bool solve(const Six &force, double accuracy, Six &motion, Six &left_over);

  private:
    void number_rows();
    void assemble(const std::vector<base::Matrix6> &stiffness);
    void add_forces(std::size_t link, const Eigen::Matrix3d &stiffness);
    void add_moments(std::size_t link, const base::Matrix6 &stiffness);
    void take_diagonal();

    void           put(const CarrierMotions &force, Eigen::Ref<Eigen::VectorXd> column) const;
    CarrierMotions motion_in(const Eigen::Ref<const Eigen::VectorXd> &column) const;

    /** Where the four blocks of a link stand. */
    struct BlockPlaces
    {
      int JJ, JK, KJ, KK; ///< row, column
    };

    const LoadedNetwork     &loaded;
    double                   scale;  ///< that makes lengths of rotations [m]
    std::vector<int>         row_of; ///< of each particle
    std::vector<BlockPlaces> places; ///< of each link
    std::vector<BlockMatrix> matrix; ///< one
    bool                     has_moments = false;
    Eigen::VectorXd          diagonal; ///< of the undamaged links; where a motion meets none, the mean
    IncompleteFactor<float>  factor;
    MinimalResiduals<1>      iteration;
    MinimalResiduals<6>      iteration_of_six;
  };
} // namespace dem
