#pragma once

#include "base/state.h"
#include "coupling/surface/boundary_facets.h"
#include "dem/facets/surface.h"
#include "dem/laws/linear_contact.h"
#include "dem/specimen/specimen.h"

#include <string>
#include <vector>

namespace coupling
{
  /** Whether contacts act on as much of the surface as lies under the particle (dem/facets/footprint.h). */
  enum class Spreading
  {
    none,
    automatic, ///< where a particle is larger than a face
    footprint
  };

  /** A boundary of a solid that particles touch. */
  struct SurfaceCouplingParameters
  {
    std::string              name;                                      ///< for messages
    std::vector<std::string> boundaries;                                ///< of the mesh; empty: all of it
    dem::LinkMaterials       contact  = dem::LinearContactParameters(); ///< law of contacts with any particle
    bool                     pressure = false; ///< particles press on areas, not at points (dem/facets/pressure.h)
    double                   skin = 0; ///< in which pressure builds up [m]; 0: a twentieth of the smallest facet's size
    std::vector<std::size_t> particles = {};              ///< that touch it, by their number in the packing; empty: all
    dem::SurfaceGlue         glue      = {};              ///< of those that touch it
    Spreading                spreading = Spreading::none; ///< of contacts at points
  };

  /** What went through a surface since the start. */
  struct SurfaceBalance
  {
    Eigen::Vector3d to_particles      = Eigen::Vector3d::Zero(); ///< momentum [N s]
    Eigen::Vector3d to_solid          = Eigen::Vector3d::Zero(); ///< momentum [N s]
    Eigen::Vector3d turn_to_particles = Eigen::Vector3d::Zero(); ///< angular momentum about the origin [N m s]
    Eigen::Vector3d turn_to_solid     = Eigen::Vector3d::Zero(); ///< the same
    double          work_on_particles = 0;                       ///< by the moving surface [J]
    double          work_on_solid     = 0;                       ///< by the forces of the particles [J]

    double contacts =
      0; ///< made by contacts whose push is not the slope of their energy (doc/theory/facets.md, 2 and 7) [J]

    /** Made by the transfer itself, zero but for rounding (or sub-cycling) [J]. */
    double spurious() const { return work_on_particles + work_on_solid; }
    /** By transfer and contacts [J]. */
    double spurious_in_all() const { return spurious() + contacts; }
  };

  /**
   * Particles on the boundary of a solid (doc/theory/surface-coupling.md): the faces of the boundary are facets of the specimen, whose
   * vertices move as the nodes do, and forces go back to the nodes by the same weights. ConcurrentMotion says when.
   */
  template <int dim>
  class SurfaceCoupling
  {
  public:
    /** All must outlive the coupling. @throws base::InputError as boundary_facets(), base::InputError as Specimen::add_surface(), and for a particle whose centre lies in the solid */
    SurfaceCoupling(dem::Specimen                   &specimen,
                    const fem::Solid<dim>           &solid,
                    SolidParticipant<dim>           &participant,
                    const SurfaceCouplingParameters &parameters);

    /** Bound of what its contacts add now to the squares of the solid's frequencies: max_i sum_c k_c N_i / m_i [1/s^2]. */
    double added_eigenvalue() const;

    /** The vertices are where the nodes are. */
    void kinematics_to_dem();

    /**
     * Push the nodes in the solid's next step.
     * @param kick time that forces push for in it [s] @param share of the forces of t_n; whatever else particles have given since the
     * last call and settle() comes on top, as its mean
     */
    void forces_to_fem(double kick, double share);
    /** The solid has taken that step: account of its work. */
    void solid_has_moved();
    /** The vertices move, in the particles' steps to come, evenly to where the nodes are now. @param window of those steps [s] */
    void motion_to_dem(double window);
    /** The same, with the velocities of the solid's step that led here. @param step its length [s]; 0: none yet */
    void motion_to_dem_as_before(double step);

    /** What the particles have given in their last steps has reached the solid already. */
    void settle() { specimen.partners().clear_vertex_impulses(number); }

    SurfaceBalance     balance() const;
    const std::string &name() const { return own_name; }
    std::size_t        surface() const { return number; } ///< of the specimen

    /** What is neither the specimen's nor the solid's. */
    void visit_state(base::StateVisitor &visitor);

  private:
    SurfaceCoupling(dem::Specimen                   &specimen,
                    BoundaryFacets                 &&facets,
                    SolidParticipant<dim>           &participant,
                    const SurfaceCouplingParameters &parameters,
                    bool                             spread);

    /** Of all vertices, from the values of the nodes: middles of faces have their mean. */
    std::vector<Eigen::Vector3d> of_vertices(std::vector<Eigen::Vector3d> of_nodes) const;
    /** The transpose: what acts on middles acts on their nodes. */
    template <typename Value>
    std::vector<Value> to_nodes(const std::vector<Value> &on_vertices) const;

    /**
     * What vertices have taken, each where it was at the time, as impulses where they are for the solid: what its moment lacks is added
     * as the smallest forces on a facet that are a couple.
     */
    std::vector<Eigen::Vector3d> impulses_here() const;

    dem::Specimen               &specimen;
    SolidParticipant<dim>       &participant;
    std::string                  own_name;
    BoundaryFacets               facets;
    std::size_t                  number;
    std::vector<std::int32_t>    facet_of;    ///< a facet of each vertex
    std::vector<Eigen::Vector3d> force;       ///< of the particles on the nodes [N]
    std::vector<Eigen::Vector3d> place;       ///< of the nodes, at the last update [m]
    std::vector<Eigen::Vector3d> last_motion; ///< of the nodes in the solid's step that led here [m]
    SurfaceBalance               exchanged;   ///< its part that the specimen does not know
  };
} // namespace coupling
