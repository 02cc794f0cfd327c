#pragma once

#include "base/column.h"
#include "base/state.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /** A periodic image, in whole cells along the base vectors. */
  using CellShift = std::array<std::int8_t, 3>;

  /**
   * A periodic cell that deforms with a given velocity gradient (doc/theory/periodic-cell.md), and the images that links reach to.
   *
   * Particles keep absolute positions, wherever they drift; a link to an image at shift k has the branch x_K + H k - x_J for all its
   * life. The default-made object is no cell at all: a free specimen.
   */
  class Cell
  {
  public:
    Cell() = default;
    /** @param base H at the start, columns are the base vectors [m]; in the plane the third is the thickness along z */
    Cell(const Eigen::Matrix3d &base, int dimension);

    bool repeats() const { return !offset.empty(); }
    int  dimension() const { return dimensions; }

    const Eigen::Matrix3d &base() const { return H; }        ///< now [m]
    const Eigen::Matrix3d &deformation() const { return F; } ///< since the start [-]
    const Eigen::Matrix3d &gradient() const { return G; }    ///< of the step to come [1/s]
    /** Of the last step, L dt with L = dF F^-1 of its end: what undoes the step, F_before = (1 - this) F. */
    const Eigen::Matrix3d &last_increment() const { return increment; }
    double                 volume() const; ///< det H [m^3]

    /** @throws base::InputError if it is not finite, or leaves the plane of a plane specimen. */
    void set_gradient(const Eigen::Matrix3d &gradient);
    /** One step: H += dt G H, F += dt G F. @throws base::NumericalError if the cell turns inside out. */
    void advance(double time_step);

    /** Number of an image in the table, entered if it is new; 0 is the particle itself. */
    std::int32_t     enter(const CellShift &shift);
    const CellShift &shift_of(const std::int32_t image) const { return shifts[image]; }
    Eigen::Vector3d  offset_of(std::int32_t image) const; ///< H k [m]
    Eigen::Vector3d  motion_of(std::int32_t image) const; ///< its change over the last step [m]

    std::size_t bytes() const;
    void        visit_state(base::StateVisitor &visitor);

    // What the kernels read: records (record_size doubles each).
    base::Column offset; ///< H k (3) [m] | 0 .. of each image
    base::Column motion; ///< its change over the last step (3) [m] | 0 ..
    base::Column rate;   ///< the three columns of G (3) [1/s] | 0 ..

  private:
    void write_record(base::Column &column, std::size_t record, const Eigen::Vector3d &value);

    int                    dimensions = 3;
    Eigen::Matrix3d        H = Eigen::Matrix3d::Zero(), F = Eigen::Matrix3d::Identity(), G = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d        increment = Eigen::Matrix3d::Zero();
    std::vector<CellShift> shifts;
  };
} // namespace dem
