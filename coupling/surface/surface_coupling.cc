#include "coupling/surface/surface_coupling.h"

#include "dem/core/state_vectors.h"
#include "dem/facets/surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    double smallest_size(const dem::FacetMesh &mesh)
    {
      double least = std::numeric_limits<double>::infinity();
      for (const auto &facet : mesh.facet)
        {
          const auto     corner = [&](const std::size_t c) { return mesh.vertex[static_cast<std::size_t>(facet[c])]; };
          const Vector3d edge   = corner(1) - corner(0);
          least = std::min(least, mesh.corners == 3 ? std::sqrt(edge.cross(Vector3d(corner(2) - corner(0))).norm()) :
                                                      edge.norm());
        }
      return least;
    }

    double skin_of(const SurfaceCouplingParameters &parameters, const dem::FacetMesh &mesh)
    {
      if (!parameters.pressure)
        return 0;
      return parameters.skin > 0 ? parameters.skin : 0.05 * smallest_size(mesh);
    }
  } // namespace

  template <int dim>
  SurfaceCoupling<dim>::SurfaceCoupling(dem::Specimen                   &specimen_,
                                        const fem::Solid<dim>           &solid,
                                        SolidParticipant<dim>           &participant_,
                                        const SurfaceCouplingParameters &parameters)
    : specimen(specimen_)
    , participant(participant_)
    , own_name(parameters.name)
    , facets(boundary_facets(solid, participant, parameters.boundaries))
    , number(specimen.add_surface({parameters.name, facets.mesh, parameters.contact, skin_of(parameters, facets.mesh),
                                   parameters.particles, parameters.glue}))
    , force(facets.carrier.size(), Vector3d::Zero())
    , place(facets.mesh.vertex)
    , last_motion(facets.carrier.size(), Vector3d::Zero())
  {
    specimen.set_vertex_velocities(number, last_motion);
  }

  template <int dim>
  double SurfaceCoupling<dim>::added_eigenvalue() const
  {
    const dem::Surface &surface = specimen.surface(number);
    double              most    = 0;
    for (std::size_t v = 0; v < facets.carrier.size(); ++v)
      most = std::max(most, surface.stiffness[v] / participant.mass(facets.carrier[v]));
    return most;
  }

  template <int dim>
  void SurfaceCoupling<dim>::kinematics_to_dem()
  {
    for (std::size_t v = 0; v < place.size(); ++v)
      place[v] = participant.position(facets.carrier[v]);
    specimen.place_vertices(number, place);
  }

  template <int dim>
  void SurfaceCoupling<dim>::forces_to_fem(const double kick, const double share)
  {
    const dem::Surface &surface = specimen.surface(number);
    for (std::size_t v = 0; v < force.size(); ++v)
      {
        force[v] = share * surface.force[v] + surface.impulse[v] / kick;
        if (force[v].isZero(0))
          continue;
        participant.add_force(facets.carrier[v], force[v]);
        exchanged.to_solid += kick * force[v];
        exchanged.turn_to_solid += kick * place[v].cross(force[v]);
      }
    settle();
  }

  template <int dim>
  void SurfaceCoupling<dim>::solid_has_moved()
  {
    for (std::size_t v = 0; v < place.size(); ++v)
      {
        const Vector3d now = participant.position(facets.carrier[v]), moved = now - place[v];
        // The force works over the half steps before and after.
        exchanged.work_on_solid += 0.5 * force[v].dot(last_motion[v] + moved);
        last_motion[v] = moved;
        place[v]       = now;
      }
  }

  template <int dim>
  void SurfaceCoupling<dim>::motion_to_dem(const double window)
  {
    const std::vector<Vector3d> &before = specimen.surface(number).place;
    std::vector<Vector3d>        velocity(place.size());
    for (std::size_t v = 0; v < place.size(); ++v)
      velocity[v] = (place[v] - before[v]) / window;
    specimen.set_vertex_velocities(number, velocity);
  }

  template <int dim>
  void SurfaceCoupling<dim>::motion_to_dem_as_before(const double step)
  {
    std::vector<Vector3d> velocity(place.size());
    for (std::size_t v = 0; v < place.size(); ++v)
      velocity[v] = step > 0 ? Vector3d(last_motion[v] / step) : participant.velocity(facets.carrier[v]);
    specimen.set_vertex_velocities(number, velocity);
  }

  template <int dim>
  SurfaceBalance SurfaceCoupling<dim>::balance() const
  {
    const dem::Surface &surface = specimen.surface(number);
    SurfaceBalance      found   = exchanged;
    found.to_particles          = -surface.momentum;
    found.turn_to_particles     = -surface.angular_momentum;
    found.work_on_particles     = surface.work;
    return found;
  }

  template <int dim>
  void SurfaceCoupling<dim>::visit_state(dem::StateVisitor &visitor)
  {
    const std::string group  = "coupling_" + own_name + "_";
    const char        axis[] = "xyz";
    for (int d = 0; d < 3; ++d)
      {
        visitor.scalar(group + "to_solid_" + axis[d], exchanged.to_solid[d]);
        visitor.scalar(group + "turn_to_solid_" + axis[d], exchanged.turn_to_solid[d]);
      }
    visitor.scalar(group + "work_on_solid", exchanged.work_on_solid);
    dem::visit_vectors(visitor, group + "last_motion", last_motion);
  }

  template class SurfaceCoupling<2>;
  template class SurfaceCoupling<3>;
} // namespace coupling
