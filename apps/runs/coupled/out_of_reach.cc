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
    constexpr std::size_t most_pairs = 100'000'000; // that are visited; a forecast must not last

    bool varies(const Expressions &formulas)
    {
      return std::any_of(formulas.begin(), formulas.end(), [](const Expression &e) { return e.varies_in_time(); });
    }

    /** Not given, or the constant 0, which only holds. */
    bool is_zero(const Expression &e)
    {
      return !e.given() || (!e.varies_in_time() && !e.varies_in_space() && e(0, 0, 0, 0) == 0);
    }

    bool all_zero(const Expressions &formulas)
    {
      return std::all_of(formulas.begin(), formulas.end(), [](const Expression &e) { return is_zero(e); });
    }

    /** The solid, or any particle: by something that is not checked here. */
    bool is_driven(const CoupledModel &model)
    {
      const ParticlesModel &particles = model.particles;
      const auto           &held      = model.continuum.loads.boundaries;
      return model.laboratory.given() || any_given(model.continuum.motion.initial_velocity) ||
             std::any_of(particles.walls.walls.begin(), particles.walls.walls.end(),
                         [](const WallSection &wall) {
                           return !all_zero(wall.velocity) || !all_zero(wall.spin) ||
                                  wall.control == WallSection::Control::force;
                         }) ||
             std::any_of(held.begin(), held.end(), [](const auto &boundary) { return varies(boundary->displacement); });
    }

    /** Particles that a motion or a force leads somewhere; those that are held alone are not among them. Sorted. */
    std::vector<std::size_t> driven_particles(const ParticlesModel &model, const ParticleGroups &groups)
    {
      std::vector<std::size_t> driven;
      const auto               add = [&](const std::string &group) {
        const auto &members = groups.at(group);
        driven.insert(driven.end(), members.begin(), members.end());
      };
      for (const PrescribedFormulas &motion : model.motion.motions)
        if (!all_zero(motion.velocity) || !all_zero(motion.spin) || !all_zero(motion.turn))
          add(motion.group);
      for (const GroupForce &push : model.forces.forces)
        if (!all_zero(push.force))
          add(push.group);
      std::sort(driven.begin(), driven.end());
      return driven;
    }

    /** Whether driven particles (sorted) are linked to others, or begin at one that is not driven. */
    bool take_others_along(const dem::ObservedSpecimen &specimen, const std::vector<std::size_t> &driven)
    {
      const dem::Counts counts = specimen.counts();
      if (counts.links > 0 || counts.particles * driven.size() > most_pairs)
        return !driven.empty();
      for (const std::size_t i : driven)
        {
          const dem::ParticleState p = specimen.particle(i);
          for (std::size_t k = 0; k < counts.particles; ++k)
            {
              const dem::ParticleState other = specimen.particle(k);
              if ((other.position - p.position).norm() <= 1.01 * (other.radius + p.radius) &&
                  !std::binary_search(driven.begin(), driven.end(), k))
                return true;
            }
        }
      return false;
    }

    /** Both sorted. */
    bool have_common(const std::vector<std::size_t> &particles, const std::vector<std::size_t> &others)
    {
      return std::any_of(others.begin(), others.end(), [&](const std::size_t i) {
        return std::binary_search(particles.begin(), particles.end(), i);
      });
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
      if (surface.mesh.size() * particles.size() > most_pairs)
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
    const std::vector<std::size_t> driven = driven_particles(model.particles, groups);
    if (take_others_along(specimen, driven))
      return text;
    for (const CouplingSection &coupling : model.couplings.couplings)
      {
        const dem::Surface *surface   = surface_named(specimen, coupling.name);
        const auto          particles = members_of(coupling, groups, specimen.counts().particles);
        if (surface == nullptr || particles.empty() || have_common(particles, driven) ||
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
