#include "coupling/surface/surface_coupling.h"

#include "base/errors.h"
#include "base/state_vectors.h"
#include "coupling/surface/interior.h"
#include "dem/facets/facet_spin.h"
#include "dem/facets/surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

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

    std::vector<std::size_t> members(const dem::ObservedSpecimen &specimen, const SurfaceCouplingParameters &parameters)
    {
      if (!parameters.particles.empty())
        return parameters.particles;
      std::vector<std::size_t> all(specimen.counts().particles);
      std::iota(all.begin(), all.end(), std::size_t{0});
      return all;
    }

    double largest_size(const dem::ObservedSpecimen &specimen, const SurfaceCouplingParameters &parameters)
    {
      double most = 0;
      for (const std::size_t i : members(specimen, parameters))
        most = std::max(most, 2 * specimen.particle(i).radius);
      return most;
    }

    /** A particle that begins behind the facets would be pushed further in, or never be seen. */
    template <int dim>
    void refuse_inside(const dem::ObservedSpecimen     &specimen,
                       const fem::Solid<dim>           &solid,
                       const SolidParticipant<dim>     &participant,
                       const SurfaceCouplingParameters &parameters)
    {
      const Interior interior(boundary_facets(solid, participant, {}).mesh);
      for (const std::size_t i : members(specimen, parameters))
        if (const Vector3d x = specimen.particle(i).position; interior.holds(x))
          {
            std::ostringstream message;
            message << "Couplings/" << parameters.name << ": the centre of particle " << i + 1 << " at ("
                    << x.transpose()
                    << ") m lies in the solid that it shall touch. Move it out, or leave it out of the "
                       "groups of this coupling.";
            throw base::InputError(message.str());
          }
    }

    template <int dim>
    bool spreads(const dem::ObservedSpecimen     &specimen,
                 const fem::Solid<dim>           &solid,
                 const SolidParticipant<dim>     &participant,
                 const SurfaceCouplingParameters &parameters)
    {
      if (parameters.pressure || parameters.spreading == Spreading::none)
        return false;
      return parameters.spreading == Spreading::footprint ||
             largest_size(specimen, parameters) >
               smallest_size(boundary_facets(solid, participant, parameters.boundaries).mesh);
    }
  } // namespace

  template <int dim>
  SurfaceCoupling<dim>::SurfaceCoupling(dem::Specimen                   &specimen_,
                                        const fem::Solid<dim>           &solid,
                                        SolidParticipant<dim>           &participant_,
                                        const SurfaceCouplingParameters &parameters)
    : SurfaceCoupling(specimen_,
                      boundary_facets(solid,
                                      participant_,
                                      parameters.boundaries,
                                      spreads(specimen_, solid, participant_, parameters) ?
                                        QuadrilateralSplit::middle :
                                        QuadrilateralSplit::diagonal),
                      participant_,
                      parameters,
                      spreads(specimen_, solid, participant_, parameters))
  {
    refuse_inside(specimen, solid, participant, parameters);
  }

  template <int dim>
  SurfaceCoupling<dim>::SurfaceCoupling(dem::Specimen                   &specimen_,
                                        BoundaryFacets                 &&facets_,
                                        SolidParticipant<dim>           &participant_,
                                        const SurfaceCouplingParameters &parameters,
                                        const bool                       spread)
    : specimen(specimen_)
    , participant(participant_)
    , own_name(parameters.name)
    , facets(std::move(facets_))
    , number(specimen.surfaces().add({parameters.name, facets.mesh, parameters.contact,
                                      skin_of(parameters, facets.mesh), parameters.particles, parameters.glue, spread}))
    , facet_of(facets.mesh.vertex.size(), -1)
    , force(facets.carrier.size(), Vector3d::Zero())
    , place(facets.mesh.vertex.begin(), facets.mesh.vertex.begin() + static_cast<std::ptrdiff_t>(facets.carrier.size()))
    , last_motion(facets.carrier.size(), Vector3d::Zero())
  {
    for (std::size_t f = 0; f < facets.mesh.size(); ++f)
      for (std::size_t c = 0; c < static_cast<std::size_t>(facets.mesh.corners); ++c)
        if (std::int32_t &of = facet_of[static_cast<std::size_t>(facets.mesh.facet[f][c])]; of < 0)
          of = static_cast<std::int32_t>(f);
    specimen.surfaces().set_vertex_velocities(number, of_vertices(last_motion));
  }

  template <int dim>
  std::vector<Vector3d> SurfaceCoupling<dim>::of_vertices(std::vector<Vector3d> values) const
  {
    for (const auto &nodes : facets.middle)
      values.push_back(0.25 * (values[nodes[0]] + values[nodes[1]] + values[nodes[2]] + values[nodes[3]]));
    return values;
  }

  template <int dim>
  template <typename Value>
  std::vector<Value> SurfaceCoupling<dim>::to_nodes(const std::vector<Value> &on_vertices) const
  {
    const std::size_t  nodes = facets.carrier.size();
    std::vector<Value> sum(on_vertices.begin(), on_vertices.begin() + static_cast<std::ptrdiff_t>(nodes));
    for (std::size_t m = 0; m < facets.middle.size(); ++m)
      for (const std::size_t node : facets.middle[m])
        sum[node] += 0.25 * on_vertices[nodes + m];
    return sum;
  }

  template <int dim>
  double SurfaceCoupling<dim>::added_eigenvalue() const
  {
    const std::vector<double> stiffness = to_nodes(specimen.surfaces().at(number).stiffness);
    double                    most      = 0;
    for (std::size_t v = 0; v < stiffness.size(); ++v)
      most = std::max(most, stiffness[v] / participant.mass(facets.carrier[v]));
    return most;
  }

  template <int dim>
  void SurfaceCoupling<dim>::kinematics_to_dem()
  {
    for (std::size_t v = 0; v < place.size(); ++v)
      place[v] = participant.position(facets.carrier[v]);
    specimen.partners().place_vertices(number, of_vertices(place));
  }

  template <int dim>
  std::vector<Vector3d> SurfaceCoupling<dim>::impulses_here() const
  {
    const dem::Surface   &surface = specimen.surfaces().at(number);
    std::vector<Vector3d> impulse = surface.impulse;
    const auto            here    = of_vertices(place);
    for (std::size_t v = 0; v < here.size(); ++v)
      {
        if (surface.turn_impulse[v].isZero(0))
          continue;
        const Vector3d couple = surface.turn_impulse[v] - here[v].cross(surface.impulse[v]);
        const auto     facet  = static_cast<std::size_t>(facet_of[v]);
        const auto     pushes = dem::FacetSpin(facets.mesh, here, facet).forces(couple);
        for (std::size_t c = 0; c < static_cast<std::size_t>(facets.mesh.corners); ++c)
          impulse[static_cast<std::size_t>(facets.mesh.facet[facet][c])] += pushes[c];
      }
    return impulse;
  }

  template <int dim>
  void SurfaceCoupling<dim>::forces_to_fem(const double kick, const double share)
  {
    const dem::Surface &surface = specimen.surfaces().at(number);
    force                       = to_nodes(surface.force);
    const auto impulse          = to_nodes(impulses_here());
    for (std::size_t v = 0; v < force.size(); ++v)
      {
        force[v] = share * force[v] + impulse[v] / kick;
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
    const std::vector<Vector3d> &before   = specimen.surfaces().at(number).place;
    std::vector<Vector3d>        velocity = of_vertices(place);
    for (std::size_t v = 0; v < velocity.size(); ++v)
      velocity[v] = (velocity[v] - before[v]) / window;
    specimen.surfaces().set_vertex_velocities(number, velocity);
  }

  template <int dim>
  void SurfaceCoupling<dim>::motion_to_dem_as_before(const double step)
  {
    std::vector<Vector3d> velocity(place.size());
    for (std::size_t v = 0; v < place.size(); ++v)
      velocity[v] = step > 0 ? Vector3d(last_motion[v] / step) : participant.velocity(facets.carrier[v]);
    specimen.surfaces().set_vertex_velocities(number, of_vertices(std::move(velocity)));
  }

  template <int dim>
  SurfaceBalance SurfaceCoupling<dim>::balance() const
  {
    const dem::Surface &surface = specimen.surfaces().at(number);
    SurfaceBalance      found   = exchanged;
    found.to_particles          = -surface.momentum;
    found.turn_to_particles     = -surface.angular_momentum;
    found.work_on_particles     = surface.work;
    found.contacts              = surface.made;
    return found;
  }

  template <int dim>
  void SurfaceCoupling<dim>::visit_state(base::StateVisitor &visitor)
  {
    const std::string group  = "coupling_" + own_name + "_";
    const char        axis[] = "xyz";
    for (int d = 0; d < 3; ++d)
      {
        visitor.scalar(group + "to_solid_" + axis[d], exchanged.to_solid[d]);
        visitor.scalar(group + "turn_to_solid_" + axis[d], exchanged.turn_to_solid[d]);
      }
    visitor.scalar(group + "work_on_solid", exchanged.work_on_solid);
    base::visit_vectors(visitor, group + "last_motion", last_motion);
  }

  template class SurfaceCoupling<2>;
  template class SurfaceCoupling<3>;
} // namespace coupling
