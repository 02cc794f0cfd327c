// What contacts with surfaces hand on, work, hold and stiffen, summed up in their order.

#include "dem/facets/surface_contacts.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    /** Whether a vertex moved in the last step. */
    bool moved_last(const Surface &surface)
    {
      return std::any_of(surface.motion.begin(), surface.motion.end(),
                         [](const Eigen::Vector3d &by) { return !by.isZero(0); });
    }
  } // namespace

  void SurfaceContacts::collect_impulses(const double kick, const SharedSurfaces &with_others)
  {
    for (Surface &surface : all)
      if (surface.touching > 0 || surface.glued > 0)
        {
          surface.momentum += kick * surface.total_force;
          surface.angular_momentum += kick * surface.total_moment;
        }
    std::vector<RunningSum> sums;
    if (lacking)
      for (Surface &surface : all)
        for (std::vector<Eigen::Vector3d> *of : {&surface.impulse, &surface.turn_impulse})
          sums.push_back({of->data(), 3 * of->size()});
    add_in_turn(sums, with_others, [&] {
      for (const SurfaceContact &contact : contacts)
        for_parts(contact, [&](Surface &surface, const std::size_t vertex, const VertexPart &part) {
          surface.take_impulse(vertex, kick * part.force);
        });
    });
    for (const SurfaceBonds &glue : glues)
      for (const VertexPart &part : glue.parts())
        all[static_cast<std::size_t>(glue.surface())].take_impulse(static_cast<std::size_t>(part.vertex),
                                                                   kick * part.force);
  }

  double SurfaceContacts::add_work_of_last_motion(const SharedSurfaces &with_others)
  {
    double                  work = 0;
    std::vector<RunningSum> sums;
    if (lacking)
      {
        sums.push_back({&work, 1});
        for (Surface &surface : all)
          sums.push_back({&surface.work, 1});
      }
    const auto add = [&] {
      for (const SurfaceContact &contact : contacts)
        {
          Surface &surface = all[static_cast<std::size_t>(contact.surface)];
          double   of_this = 0;
          for_parts(contact, [&](const Surface &of, const std::size_t vertex, const VertexPart &part) {
            of_this -= 0.5 * part.force.dot(of.motion[vertex]);
          });
          surface.work += of_this;
          work += of_this;
        }
    };
    if (!lacking || std::any_of(all.begin(), all.end(), moved_last)) // otherwise all work is zero
      add_in_turn(sums, with_others, add);
    for (const SurfaceBonds &glue : glues)
      {
        Surface &surface = all[static_cast<std::size_t>(glue.surface())];
        double   of_this = 0;
        for (const VertexPart &part : glue.parts())
          of_this -= 0.5 * part.force.dot(surface.motion[static_cast<std::size_t>(part.vertex)]);
        surface.work += of_this;
        work += of_this;
      }
    return work;
  }

  double SurfaceContacts::put_on(const std::size_t                   number,
                                 const std::vector<Eigen::Vector3d> &by,
                                 const SharedSurfaces               &with_others)
  {
    Surface &surface = all[number];
    double   work    = 0;
    add_in_turn({{&work, 1}}, with_others, [&] {
      for (const SurfaceContact &contact : contacts)
        for_parts(contact, [&](const Surface &of, const std::size_t vertex, const VertexPart &part) {
          if (&of == &surface)
            work -= 0.5 * part.force.dot(by[vertex]);
        });
    });
    for (const SurfaceBonds &glue : glues)
      if (static_cast<std::size_t>(glue.surface()) == number)
        for (const VertexPart &part : glue.parts())
          work -= 0.5 * part.force.dot(by[static_cast<std::size_t>(part.vertex)]);
    surface.work += work;
    for (std::size_t v = 0; v < by.size(); ++v)
      {
        surface.place[v] += by[v];
        surface.motion[v] += by[v];
      }
    return work;
  }

  double
  SurfaceContacts::stored(const SurfaceContact &contact, const ParticleShape &shape, const Particles &particles) const
  {
    const double radius = particles.radius_of(static_cast<std::size_t>(contact.particle));
    const auto  &law    = all[static_cast<std::size_t>(contact.surface)].law;
    if (!law.linear())
      return contact.spring + law.stored_in_shear(contact.of_law(shape, radius), contact.shear, contact.memory);
    LinearContact::State<double, 3> state;
    state.shear[0] = {{contact.shear[0], contact.shear[1], contact.shear[2]}};
    return contact.spring +
           LinearContact::stored(*law.linear(), {0, contact.distance, radius, contact.area(shape, radius)}, state);
  }

  double SurfaceContacts::stored(const ParticleShape &shape, const Particles &particles) const
  {
    double sum = 0;
    for (const SurfaceContact &contact : contacts)
      sum += stored(contact, shape, particles);
    for (const SurfaceBonds &glue : glues)
      sum += glue.stored();
    return sum;
  }

  double SurfaceContacts::kappa(const SurfaceContact &contact,
                                const Particles      &particles,
                                const ParticleShape  &shape,
                                const bool            rotations) const
  {
    const auto   i      = static_cast<std::size_t>(contact.particle);
    const double radius = particles.radius_of(i);
    const auto  &law    = all[static_cast<std::size_t>(contact.surface)].law;
    const double lever  = rotations ? particles.mass[i] * radius * radius / particles.inertia[i] : 0.0;
    if (!law.linear())
      return law.stiffness_of_step(contact.of_law(shape, radius), lever, contact.memory);
    const double at_a_point = shape.link_area(radius, radius) / radius, shear = law.linear()->shear * (1 + lever);
    if (all[static_cast<std::size_t>(contact.surface)].skin > 0)
      return std::max(contact.stiffness, contact.share * at_a_point * shear);
    return at_a_point * std::max(law.linear()->normal, shear);
  }

  std::vector<double>
  SurfaceContacts::stiffness_seen(const Particles &particles, const ParticleShape &shape, const bool rotations) const
  {
    std::vector<double> sum(touching() ? particles.count : 0, 0.0);
    for (const SurfaceContact &contact : contacts)
      sum[static_cast<std::size_t>(contact.particle)] += kappa(contact, particles, shape, rotations);
    for (const SurfaceBonds &glue : glues)
      for (std::size_t b = 0; b < glue.count(); ++b)
        if (glue.is_alive(b))
          sum[static_cast<std::size_t>(glue.particle_of(b))] += glue.stiffness_seen(b);
    return sum;
  }

  double SurfaceContacts::stiffness_seen(const Particles     &particles,
                                         const ParticleShape &shape,
                                         const bool           rotations,
                                         const std::int32_t   particle) const
  {
    double sum = 0;
    for (auto c = std::lower_bound(contacts.begin(), contacts.end(), particle,
                                   [](const SurfaceContact &a, const std::int32_t p) { return a.particle < p; });
         c != contacts.end() && c->particle == particle; ++c)
      sum += kappa(*c, particles, shape, rotations);
    for (const SurfaceBonds &glue : glues)
      for (std::size_t b = 0; b < glue.count(); ++b)
        if (glue.particle_of(b) == particle && glue.is_alive(b))
          sum += glue.stiffness_seen(b);
    return sum;
  }

  SurfaceEnergies SurfaceContacts::energies(const ParticleShape &shape, const Particles &particles) const
  {
    return {stored(shape, particles), friction(), damage(), damped, released()};
  }

  double SurfaceContacts::last_of_dashpot(const SurfaceContact &gone, const Particles &particles) const
  {
    const Surface  &surface = all[static_cast<std::size_t>(gone.surface)];
    Eigen::Vector3d under   = Eigen::Vector3d::Zero();
    if (surface.mesh.is_plane())
      under = surface.motion.front();
    else
      for (int c = 0; c < surface.mesh.corners; ++c)
        under += surface.motion[static_cast<std::size_t>(
                   surface.mesh.facet[static_cast<std::size_t>(gone.facet)][static_cast<std::size_t>(c)])] /
                 surface.mesh.corners;
    const Eigen::Vector3d moved(&particles.motion[record_size * static_cast<std::size_t>(gone.particle)]);
    return 0.5 * gone.dashpot * gone.direction.dot(moved - under);
  }

  double SurfaceContacts::friction() const
  {
    double sum = slid;
    for (const SurfaceBonds &glue : glues)
      sum += glue.friction();
    return sum;
  }

  double SurfaceContacts::released() const
  {
    double sum = let_go;
    for (const SurfaceBonds &glue : glues)
      sum += glue.released();
    return sum;
  }

  double SurfaceContacts::damage() const
  {
    double sum = 0;
    for (const SurfaceBonds &glue : glues)
      sum += glue.damage();
    return sum;
  }
} // namespace dem
