#pragma once

#include "coupling/surface/boundary_facets.h"
#include "dem/laws/linear_contact.h"
#include "dem/specimen/specimen.h"

#include <string>
#include <vector>

namespace coupling
{
  /** A boundary of a solid that particles touch. */
  struct SurfaceCouplingParameters
  {
    std::string                  name;       ///< for messages
    std::vector<std::string>     boundaries; ///< of the mesh; empty: all of it
    dem::LinearContactParameters contact;    ///< with any particle
  };

  /** What went through a surface since the start. */
  struct SurfaceBalance
  {
    Eigen::Vector3d to_particles      = Eigen::Vector3d::Zero(); ///< momentum [N s]
    Eigen::Vector3d to_solid          = Eigen::Vector3d::Zero(); ///< momentum [N s]
    double          work_on_particles = 0;                       ///< by the moving surface [J]
    double          work_on_solid     = 0;                       ///< by the forces of the particles [J]

    /** Made by the transfer itself, zero but for rounding (or sub-cycling) [J]. */
    double made() const { return work_on_particles + work_on_solid; }
  };

  /**
   * Particles and an elastic or damaging solid that touch (doc/theory/surface-coupling.md): the faces of the solid's boundary are facets
   * of the specimen, whose vertices move as the nodes do, and forces go back to the nodes by the same weights.
   *
   * Synchronous by default: both sides feel the force of where both are at t_n, and move with it; momentum is kept and the power of both
   * sides is equal to rounding. With k > 1 steps of the particles in one of the solid, nodes move evenly through the window, and the solid
   * feels the mean force of the window before: momentum is kept (what is on its way included), energy to first order in the window.
   */
  template <int dim>
  class SurfaceCoupling
  {
  public:
    /** All must outlive the coupling. @throws std::invalid_argument as boundary_facets(), dem::InputError as Specimen::add_surface() */
    SurfaceCoupling(dem::Specimen                   &specimen,
                    const fem::Solid<dim>           &solid,
                    fem::ExplicitSolver<dim>        &motion,
                    SolidParticipant<dim>           &participant,
                    const SurfaceCouplingParameters &parameters);

    /**
     * Longest step that both sides take together now [s]. The solid's: 2 s / sqrt(omega^2 + max_i sum_c k_c N_i / m_i), omega its
     * own largest frequency, s its safety; the second term bounds the eigenvalues of the contacts by their row sums.
     */
    double stable_step() const;

    /** One step of the solid. @param particle_steps of the same length in it, > 0 */
    void advance(double step, int particle_steps = 1);

    const SurfaceBalance &balance() const { return exchanged; }
    std::size_t           surface() const { return number; } ///< of the specimen

  private:
    std::vector<Eigen::Vector3d> places() const;
    void                         kinematics_to_dem();
    void                         forces_to_fem(const std::vector<Eigen::Vector3d> &force, double window);

    dem::Specimen               &specimen;
    fem::ExplicitSolver<dim>    &motion;
    SolidParticipant<dim>       &participant;
    BoundaryFacets               facets;
    std::size_t                  number;
    SurfaceBalance               exchanged;
    std::vector<Eigen::Vector3d> last_motion; ///< of the vertices in the step that led here [m]
  };
} // namespace coupling
