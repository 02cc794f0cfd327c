#include "dem/facets/surface_contacts.h"

#include "base/errors.h"
#include "dem/core/memory_pages.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <sstream>

namespace dem
{
  Eigen::Vector3d SurfaceContact::moment() const
  {
    const Eigen::Vector3d branch = distance * direction, sheared = force - push;
    return branch.cross(sheared);
  }

  std::size_t SurfaceContacts::add(const SurfaceParameters &parameters, const Physics &physics, std::vector<bool> meets)
  {
    check_facets(parameters.mesh, parameters.name, physics.dimension);
    all.emplace_back(parameters, physics, std::move(meets));
    forget_places();
    return all.size() - 1;
  }

  const std::vector<std::int32_t> &SurfaceContacts::find_forces(const Particles      &particles,
                                                                const ParticleShape  &shape,
                                                                const double          per_second,
                                                                const SharedSurfaces &with_others)
  {
    born.clear();
    if (found)
      return born;
    rate               = per_second;
    const bool touched = count() > 0;
    clear_forces();
    if (touched || near.can_touch())
      {
        if (near.can_touch())
          near.update(particles, all, with_others);
        if (spread())
          beside.update(near, particles);
        find_contacts(particles, shape, with_others);
      }
    find_bonds(particles);
    found = true;
    return born;
  }

  void SurfaceContacts::clear_forces()
  {
    for (Surface &surface : all)
      {
        surface.clear_totals();
        if (!lacking)
          continue;
        std::fill(surface.force.begin(), surface.force.end(), Eigen::Vector3d::Zero());
        std::fill(surface.stiffness.begin(), surface.stiffness.end(), 0.0);
      }
    for (const SurfaceContact &contact : contacts)
      {
        std::fill_n(&records[record_size * static_cast<std::size_t>(contact.particle)], record_size, 0.0);
        for_parts(contact, [&](Surface &surface, const std::size_t vertex, const VertexPart &) {
          surface.force[vertex].setZero();
          surface.stiffness[vertex] = 0;
        });
      }
    for (const SurfaceBonds &glue : glues)
      {
        Surface &surface = all[static_cast<std::size_t>(glue.surface())];
        for (std::size_t b = 0; b < glue.count() && !records.empty(); ++b)
          std::fill_n(&records[record_size * static_cast<std::size_t>(glue.particle_of(b))], record_size, 0.0);
        for (const VertexPart &part : glue.parts())
          {
            surface.force[static_cast<std::size_t>(part.vertex)].setZero();
            surface.stiffness[static_cast<std::size_t>(part.vertex)] = 0;
          }
      }
  }

  bool SurfaceContacts::spread() const
  {
    return std::any_of(all.begin(), all.end(), [](const Surface &surface) { return surface.footprint.given(); });
  }

  bool SurfaceContacts::remembers() const
  {
    return std::any_of(all.begin(), all.end(), [](const Surface &surface) { return !surface.law.linear(); });
  }

  bool SurfaceContacts::viscous() const
  {
    return std::any_of(all.begin(), all.end(), [](const Surface &surface) { return surface.law.viscous(); });
  }

  bool SurfaceContacts::holding() const
  {
    return std::any_of(glues.begin(), glues.end(), [](const SurfaceBonds &glue) { return glue.holds(); });
  }

  void SurfaceContacts::cut_off_at(const std::size_t number, const Particles &particles, const ParticleShape &shape)
  {
    Surface &surface = all.at(number);
    if (surface.skin > 0 || surface.footprint.given())
      throw base::InputError("wall " + surface.name + ": particles are cut off only where contacts act at a point.");
    base::Column deepest(particles.count, 0.0);
    for (const SurfaceContact &contact : contacts)
      if (contact.surface == static_cast<std::int32_t>(number))
        {
          double &cut = deepest[static_cast<std::size_t>(contact.particle)];
          cut         = std::max(cut, contact.overlap + surface.cut_of(contact.particle));
        }
    surface.cut = deepest;
    found       = false;
    find_forces(particles, shape);
  }

  std::vector<std::int32_t> SurfaceContacts::glue(const std::size_t              surface,
                                                  const double                   within,
                                                  std::shared_ptr<const LinkLaw> law,
                                                  const Particles               &particles,
                                                  const ParticleShape           &shape,
                                                  const bool                     rotations)
  {
    const Surface &to = all.at(surface);
    if (to.mesh.is_plane())
      throw base::InputError("wall " + to.name + ": nothing is glued to an unbounded plane. Take a plate of facets.");
    glues.emplace_back(static_cast<std::int32_t>(surface), all, particles, shape, within, std::move(law), rotations);
    std::vector<std::int32_t> glued;
    for (std::size_t b = 0; b < glues.back().count(); ++b)
      {
        glued.push_back(glues.back().particle_of(b));
        let_meet(surface, glued.back(), false, particles.count);
      }
    all[surface].glued += static_cast<std::int64_t>(glued.size());
    return glued;
  }

  void SurfaceContacts::let_meet(const std::size_t  surface,
                                 const std::int32_t particle,
                                 const bool         meets,
                                 const std::size_t  particles)
  {
    std::vector<bool> &those = all[surface].meets;
    if (those.empty())
      those.assign(particles, true);
    those[static_cast<std::size_t>(particle)] = meets;
    near.forget();
  }

  void SurfaceContacts::find_bonds(const Particles &particles)
  {
    if (holding() && records.empty())
      assign_zeros(records, record_size * particles.count);
    for (SurfaceBonds &glue : glues)
      {
        const auto s = static_cast<std::size_t>(glue.surface());
        for (const std::int32_t i : glue.find_forces(particles, all[s]))
          let_meet(s, i, true, particles.count);
        if (!records.empty())
          glue.hand_out(records, all[s]);
      }
  }

  void SurfaceContacts::check_start(const Particles &particles)
  {
    near.update(particles, all);
    for (std::size_t k = 0; k < near.particles().size(); ++k)
      for (const NearFacet *pair = near.begin(k); pair != near.end(k); ++pair)
        {
          const auto     i       = static_cast<std::size_t>(near.particles()[k]);
          const Surface &surface = all[static_cast<std::size_t>(pair->surface)];
          const double   radius  = particles.radius_of(i),
                       inside =
                         radius - surface.distance(static_cast<std::size_t>(pair->facet), particles.position_of(i));
          if (inside <= 0.5 * radius)
            continue;
          std::ostringstream message;
          message << "surface " << surface.name << ": particle " << particles.number[i] + 1 << " at ("
                  << particles.position_of(i).transpose() << ") m lies in it";
          if (surface.mesh.is_plane() && inside > radius)
            message << " or behind it, by " << inside;
          else
            message << " by " << inside;
          message << " m; up to half its radius (" << radius << " m) is taken. Move one of the two.";
          throw base::InputError(message.str());
        }
  }

  void SurfaceContacts::settle(std::vector<SurfaceContact> &&now,
                               Known                         old,
                               const Known                   old_end,
                               const Particles              &particles,
                               const ParticleShape          &shape)
  {
    // Both lists are sorted alike: by particle and surface. What is there fewer times now has let go. What dashpots have taken is added up in
    // this order, of contacts that are there and that were: ranks, which add one after the other, have the order of one.
    const auto same = [](const SurfaceContact &a, const SurfaceContact &b) {
      return a.particle == b.particle && a.surface == b.surface;
    };
    const auto before = [](const SurfaceContact &a, const SurfaceContact &b) {
      return a.particle != b.particle ? a.particle < b.particle : a.surface < b.surface;
    };
    for (auto next = now.begin(); next != now.end() || old != old_end;)
      {
        if (next == now.end() || (old != old_end && before(*old, *next)))
          {
            SurfaceContact gone = *old++;
            gone.spring         = 0; // only shear is left
            let_go += stored(gone, shape, particles);
            if (gone.dashpot != 0)
              damped += last_of_dashpot(gone, particles);
          }
        else if (old == old_end || !same(*old, *next))
          {
            if (born.empty() || born.back() != next->particle)
              born.push_back(next->particle);
            damped += next->viscous;
            ++next;
          }
        else
          {
            const Surface &surface = all[static_cast<std::size_t>(next->surface)];
            if (next->stiffness > old->stiffness && (surface.skin > 0 || surface.law.stiffens()) &&
                (born.empty() || born.back() != next->particle))
              born.push_back(next->particle);
            damped += next->viscous;
            ++old, ++next;
          }
      }
    contacts = std::move(now);
    for (const SurfaceContact &contact : contacts)
      {
        slid += contact.dissipated;
        all[static_cast<std::size_t>(contact.surface)].made += contact.made;
      }
  }

  void SurfaceContacts::hand_out(const Particles &particles, const ParticleShape &shape)
  {
    for (const SurfaceContact &contact : contacts)
      {
        Surface     &surface         = all[static_cast<std::size_t>(contact.surface)];
        const double radius          = particles.radius_of(static_cast<std::size_t>(contact.particle));
        const auto  &linear          = surface.law.linear();
        const double normal          = contact.stiffness,
                     shear           = linear ? contact.area(shape, radius) * linear->shear / radius :
                                                surface.law.shear_stiffness(contact.of_law(shape, radius), contact.memory);
        double               *sum    = &records[record_size * static_cast<std::size_t>(contact.particle)];
        const Eigen::Vector3d branch = contact.distance * contact.direction, sheared = contact.force - contact.push;
        const Eigen::Vector3d moment = contact.moment();
        for (int c = 0; c < 3; ++c)
          {
            sum[c] += contact.force[c];
            sum[3 + c] += moment[c];
          }
        for_parts(contact, [&](Surface &of, const std::size_t vertex, const VertexPart &part) {
          of.force[vertex] += part.force;
          of.stiffness[vertex] += std::max(part.stiffness, part.weight * shear);
        });
        surface.total_force -= contact.force;
        surface.total_moment -= contact.place.cross(sheared) + (contact.place - branch).cross(contact.push);
        const double along = contact.direction.dot(surface.servo.direction), squared = along * along;
        surface.along += squared * normal + (surface.servo.direction.squaredNorm() - squared) * shear;
        ++surface.touching;
      }
  }

  void SurfaceContacts::rest()
  {
    for (Surface &surface : all)
      {
        std::fill(surface.motion.begin(), surface.motion.end(), Eigen::Vector3d::Zero());
        surface.turn.setZero();
      }
  }

  double SurfaceContacts::advance(const double step)
  {
    double largest = 0;
    for (Surface &surface : all)
      {
        surface.serve(step);
        largest = std::max(largest, surface.advance(step));
      }
    found = false;
    return largest;
  }
} // namespace dem
