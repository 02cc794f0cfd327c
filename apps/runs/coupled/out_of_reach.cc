#include "apps/runs/coupled/out_of_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace apps
{
  namespace
  {
    bool varies(const Expressions &formulas)
    {
      return std::any_of(formulas.begin(), formulas.end(), [](const Expression &e) { return e.varies_in_time(); });
    }

    /** By something that is not checked here. */
    bool is_driven(const CoupledModel &model)
    {
      const ParticlesModel &particles = model.particles;
      const auto           &held      = model.continuum.loads.boundaries;
      return !particles.motion.motions.empty() || !particles.forces.forces.empty() || model.laboratory.given() ||
             any_given(model.continuum.motion.initial_velocity) ||
             std::any_of(particles.walls.walls.begin(), particles.walls.walls.end(),
                         [](const WallSection &wall) {
                           return any_given(wall.velocity) || any_given(wall.spin) ||
                                  wall.control == WallSection::Control::force;
                         }) ||
             std::any_of(held.begin(), held.end(), [](const auto &boundary) { return varies(boundary->displacement); });
    }

    /** Outward normal of a face, and a point of it. */
    struct FacePlane
    {
      Eigen::Vector3d point, normal;
    };

    FacePlane plane_of(const dem::Surface &surface, const std::size_t facet)
    {
      std::array<Eigen::Vector3d, 3> corner;
      for (int c = 0; c < surface.mesh.corners; ++c)
        corner[static_cast<std::size_t>(c)] =
          surface.place[static_cast<std::size_t>(surface.mesh.facet[facet][static_cast<std::size_t>(c)])];
      const double out = surface.mesh.outward.empty() ? 1.0 : surface.mesh.outward[facet];
      return {corner[0], out * dem::facet_normal(corner, surface.mesh.corners == 2)};
    }

    /** Whether one of the particles is in front of a face and moves, or falls, towards it. */
    bool in_reach(const dem::ObservedSpecimen    &specimen,
                  const std::vector<std::size_t> &particles,
                  const dem::Surface             &surface,
                  const Eigen::Vector3d          &weight)
    {
      constexpr std::size_t most = 100'000'000; // pairs that are visited; a forecast must not last
      if (surface.mesh.size() * particles.size() > most)
        return true;
      for (std::size_t f = 0; f < surface.mesh.size(); ++f)
        {
          const FacePlane face  = plane_of(surface, f);
          const bool      falls = face.normal.dot(weight) < -1e-9 * weight.norm();
          for (const std::size_t i : particles)
            {
              const dem::ParticleState p       = specimen.particle(i);
              const bool               towards = falls || face.normal.dot(p.velocity) < -1e-9 * p.velocity.norm();
              if (towards && face.normal.dot(p.position - face.point) > -p.radius)
                return true;
            }
        }
      return false;
    }

    std::vector<std::size_t>
    members_of(const CouplingSection &coupling, const ParticleGroups &groups, const std::size_t all)
    {
      if (!coupling.groups.empty())
        return coupling.particles(groups);
      std::vector<std::size_t> everyone(all);
      std::iota(everyone.begin(), everyone.end(), std::size_t{0});
      return everyone;
    }

    const dem::Surface *surface_named(const dem::ObservedSpecimen &specimen, const std::string &name)
    {
      for (std::size_t s = 0; s < specimen.surfaces().size(); ++s)
        if (specimen.surfaces().at(s).name == name)
          return &specimen.surfaces().at(s);
      return nullptr;
    }
  } // namespace

  std::string
  couplings_out_of_reach(const CoupledModel &model, const dem::ObservedSpecimen &specimen, const ParticleGroups &groups)
  {
    std::string text;
    if (is_driven(model) || specimen.counts().wall_contacts > 0)
      return text;
    for (const CouplingSection &coupling : model.couplings.couplings)
      {
        const dem::Surface *surface   = surface_named(specimen, coupling.name);
        const auto          particles = members_of(coupling, groups, specimen.counts().particles);
        if (surface == nullptr || particles.empty() ||
            in_reach(specimen, particles, *surface, model.particles.gravity.vector()))
          continue;
        text +=
          fmt::format("  warning      coupling {}: neither the weight nor a velocity leads its particles to {}: it may "
                      "never be touched. Check Boundary, Gravity and Initial velocity\n",
                      coupling.name,
                      coupling.boundaries.empty() ? "the boundary" :
                                                    fmt::format("Boundary = {}", fmt::join(coupling.boundaries, ", ")));
      }
    return text;
  }
} // namespace apps
