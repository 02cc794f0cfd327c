#include "coupling/surface/surface_coupling.h"

#include "dem/facets/surface.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  using Eigen::Vector3d;

  template <int dim>
  SurfaceCoupling<dim>::SurfaceCoupling(dem::Specimen                   &specimen_,
                                        const fem::Solid<dim>           &solid,
                                        fem::ExplicitSolver<dim>        &motion_,
                                        SolidParticipant<dim>           &participant_,
                                        const SurfaceCouplingParameters &parameters)
    : specimen(specimen_)
    , motion(motion_)
    , participant(participant_)
    , facets(boundary_facets(solid, participant, parameters.boundaries))
    , number(specimen.add_surface({parameters.name, facets.mesh, parameters.contact}))
    , last_motion(facets.carrier.size(), Vector3d::Zero())
  {
    specimen.set_vertex_velocities(number, last_motion);
  }

  template <int dim>
  std::vector<Vector3d> SurfaceCoupling<dim>::places() const
  {
    std::vector<Vector3d> all;
    all.reserve(facets.carrier.size());
    for (const std::size_t carrier : facets.carrier)
      all.push_back(participant.position(carrier));
    return all;
  }

  template <int dim>
  double SurfaceCoupling<dim>::stable_step() const
  {
    const dem::Surface &surface = specimen.surface(number);
    double              contact = 0; // [1/s^2]
    for (std::size_t v = 0; v < facets.carrier.size(); ++v)
      contact = std::max(contact, surface.stiffness[v] / participant.mass(facets.carrier[v]));
    const double safety = motion.step() / motion.critical_step();
    const double own    = motion.largest_element_eigenvalue();
    return std::min(specimen.longest_step(), 2 * safety / std::sqrt(own + contact));
  }

  template <int dim>
  void SurfaceCoupling<dim>::kinematics_to_dem()
  {
    specimen.place_vertices(number, places());
  }

  template <int dim>
  void SurfaceCoupling<dim>::forces_to_fem(const std::vector<Vector3d> &force, const double window)
  {
    for (std::size_t v = 0; v < force.size(); ++v)
      {
        participant.add_force(facets.carrier[v], force[v]);
        exchanged.to_solid += window * force[v];
      }
  }

  template <int dim>
  void SurfaceCoupling<dim>::advance(const double step, const int particle_steps)
  {
    kinematics_to_dem();
    const dem::Surface   &surface = specimen.surface(number);
    std::vector<Vector3d> force;
    if (particle_steps == 1)
      {
        specimen.set_time_step(step);
        specimen.find_surface_forces();
        force = surface.force;
      }
    else
      for (const Vector3d &impulse : surface.impulse)
        force.push_back(impulse / step);
    specimen.clear_vertex_impulses(number);
    forces_to_fem(force, step);

    std::vector<Vector3d> velocity = places();
    for (Vector3d &v : velocity)
      v = -v;
    participant.advance(step, 1);
    for (std::size_t v = 0; v < velocity.size(); ++v)
      {
        const Vector3d moved = velocity[v] + participant.position(facets.carrier[v]);
        // The force of t_n works over the half steps before and after.
        exchanged.work_on_solid += 0.5 * force[v].dot(last_motion[v] + moved);
        last_motion[v] = moved;
        velocity[v]    = moved / step;
      }
    specimen.set_vertex_velocities(number, velocity);
    specimen.set_time_step(step / particle_steps);
    specimen.advance(particle_steps);
    exchanged.to_particles      = -surface.momentum;
    exchanged.work_on_particles = surface.work;
  }

  template class SurfaceCoupling<2>;
  template class SurfaceCoupling<3>;
} // namespace coupling
