#pragma once

#include "base/state.h"
#include "base/voigt.h"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace coupling
{
  /**
   * An element in which a localised cell is only a layer: a band as wide as the cell, with normal n, between parts that unload. Both have
   * the same traction on the plane, and their strains differ by a jump a n^T (doc/theory/multiscale.md, 5; crack band: Bazant and Oh,
   * 1983, Materials and Structures 16, 155). The element dissipates per area what the cell does, whatever its size.
   */
  class CrackBand
  {
  public:
    struct Answer
    {
      base::Voigt     stress;
      base::Stiffness tangent;
    };
    /** Functions of the cell that the band calls. */
    struct Cell
    {
      std::function<base::Voigt(const base::Voigt &strain)> stress;
      std::function<base::Stiffness()>                      tangent; ///< at the last strain; dear
    };

    CrackBand() = default;
    /**
     * From now on. @param share of the band in the element, width of the cell over that of the element along n, in (0, 1]
     * @param strain,stress,unloading of the cell now: elsewhere stress + unloading (strain' - strain)
     * @param stored in the cell now [J/m^3]
     */
    CrackBand(const Eigen::Vector3d &normal,
              double                 share,
              const base::Voigt     &strain,
              const base::Voigt     &stress,
              const base::Stiffness &unloading,
              double                 stored);

    /**
     * Answer of the whole. The last strain requested of the cell is that of the band. Its iterations begin where the last answer since
     * begin_step() says that the jump is; the tangent may be that of the last iteration but one, where the last has moved little.
     * @throws fem::MaterialFailure where the layers find no common traction: the element is too wide, and snaps back
     */
    Answer respond(const base::Voigt &strain, const Cell &cell);
    /** The last answer becomes the state. */
    void commit()
    {
      jump = trial_jump;
      begin_step();
    }
    /** Another step from the committed state is sought. */
    void begin_step() { last.reset(); }

    double                 share_of_cell() const { return share; }
    const Eigen::Vector3d &normal() const { return direction; }
    /** Opening of the band in the last answer, over the width of the element [-]. */
    const Eigen::Vector3d &last_jump() const { return trial_jump; }
    /** What the parts outside have stored in the last answer, per volume of the element [J/m^3]. */
    double stored_outside(const base::Voigt &strain) const;

    void visit_state(base::StateVisitor &visitor);

  private:
    /** A jump of this step, and how it moves with the strain. */
    struct Found
    {
      base::Voigt                 strain;
      Eigen::Vector3d             jump;
      Eigen::Matrix<double, 3, 6> rate;
    };

    base::Voigt outside(const base::Voigt &strain) const; ///< their strain
    /** Of the whole, with all layers in equilibrium. @throws fem::MaterialFailure where it snaps back */
    base::Stiffness tangent_of_whole(const base::Voigt &strain, const base::Stiffness &of_cell);
    /** Of the jump's traction by the jump. */
    Eigen::Matrix3d of_jump(const base::Stiffness &of_cell) const;

    Eigen::Vector3d direction = {1, 0, 0}, jump = {0, 0, 0}, trial_jump = {0, 0, 0};
    double          share = 1, stored_then = 0;
    base::Voigt     strain_then = base::Voigt::Zero(), stress_then = base::Voigt::Zero();
    base::Stiffness unloading = base::Stiffness::Zero();

    std::optional<Found> last;
  };
} // namespace coupling
