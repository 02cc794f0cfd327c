// What another model may do to a specimen (doc/theory/volume-coupling.md, 2).

#include "dem/specimen/partners.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/core/memory_pages.h"
#include "dem/measures/link_measures.h"
#include "dem/specimen/core.h"
#include "dem/specimen/grips.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <string>

namespace dem
{
  namespace
  {
    double checked(const double weight, const Eigen::Vector3d &place)
    {
      if (weight > 0 && weight <= 1)
        return weight;
      throw base::InputError("Weight " + base::number_text(weight) + " at (" + base::number_text(place.x()) + ", " +
                             base::number_text(place.y()) + ", " + base::number_text(place.z()) +
                             "): must be above 0 and at most 1.");
    }

    /** Where a link acts. */
    Eigen::Vector3d contact_point(const Particles &p, const LinkSet &links, const std::size_t l)
    {
      const std::int32_t    J = links.first[l], K = links.second[l];
      const Eigen::Vector3d branch = branch_of(p, links, l);
      const double          length = branch.norm(), arm = 0.5 * (length + p.radius_of(J) - p.radius_of(K));
      return p.position_of(J) + arm / length * branch;
    }

    void scale_mass(Particles &p, const std::size_t i, const double weight)
    {
      p.mass[i] *= weight;
      p.inertia[i] *= weight;
      for (std::size_t c = 0; c < 6; ++c)
        p.inverse_mass[record_size * i + c] /= weight;
    }
  } // namespace

  void Partners::share(const std::function<double(const Eigen::Vector3d &)> &of_bonds,
                       const std::vector<double>                            &of_masses)
  {
    core->refuse_late("Weights");
    Particles &p     = core->particles;
    LinkSet   &bonds = core->bonds;
    for (std::size_t l = 0; l < bonds.count; ++l)
      {
        if (!bonds.is_alive(l))
          continue;
        const Eigen::Vector3d place = contact_point(p, bonds, l);
        bonds.area[l] *= checked(of_bonds(place), place);
      }
    for (std::size_t number = 0; number < p.count; ++number)
      {
        const auto i = static_cast<std::size_t>(core->slot[number]);
        scale_mass(p, i, checked(of_masses.at(number), p.position_of(i)));
      }
    core->longest_step = core->time_step = core->parameters.step_factor * core->stable();
  }

  void Partners::leave(const std::vector<std::size_t> &given, const bool keep_bonds_between)
  {
    core->refuse_late("Particles of a partner");
    Particles        &p = core->particles;
    std::vector<bool> left(p.count, false);
    for (const std::size_t number : given)
      {
        const auto i = static_cast<std::size_t>(core->slot.at(number));
        left[i]      = true;
        if (p.clump_of(i) >= 0)
          throw base::InputError("Particle " + std::to_string(number + 1) +
                                 " is a pebble of a clump, and cannot be left to a partner.");
      }
    if (!keep_bonds_between)
      {
        core->remove_bonds(left);
        p.body.resize(p.count, Particles::alone);
        for (std::size_t i = 0; i < p.count; ++i)
          if (left[i])
            p.body[i] = Particles::left;
        core->remove_contacts_within_bodies();
      }
    Grip grip;
    grip.particles  = given;
    grip.prescribed = {true, true, true, true, true, true};
    Grips                              grips(*core);
    const std::size_t                  added = grips.add(grip);
    const std::vector<Eigen::Vector3d> rest(given.size(), Eigen::Vector3d::Zero());
    grips.set_velocities(added, rest, rest);
    for (const std::size_t number : given)
      {
        const auto i = static_cast<std::size_t>(core->slot[number]);
        p.mass[i] = p.inertia[i] = 0;
      }
    core->held.leave_to_partner(added, p.count);
    core->longest_step = core->time_step = core->parameters.step_factor * core->stable();
  }

  void Partners::advance(const std::vector<std::size_t>              &particles,
                         const std::function<void(StepCorrection &)> &correct)
  {
    if (core->parameters.physics.periodic)
      throw base::InputError("Corrections: a periodic cell has no place for a partner's body.");
    if (core->step_count == 0)
      core->begin();
    core->step({&particles, &correct});
  }

  void Partners::add_force(const std::size_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &couple)
  {
    if (core->parameters.physics.periodic)
      throw base::InputError("Forces: a periodic cell has nothing that could hold against them.");
    Particles &p = core->particles;
    if (p.pushed.empty())
      assign_zeros(p.pushed, record_size * p.count);
    double *push = &p.pushed[record_size * static_cast<std::size_t>(core->slot.at(particle))];
    for (int c = 0; c < 3; ++c)
      {
        push[c] += force[c];
        push[3 + c] += couple[c];
      }
  }

  void Partners::clear_forces() { core->particles.pushed.clear(); }

  void Partners::apply_impulse(const std::size_t number, const Eigen::Vector3d &change, const Eigen::Vector3d &spin)
  {
    Particles &p    = core->particles;
    const auto slot = core->slot.at(number);
    core->gather_particle(slot);
    const auto            at = record_size * static_cast<std::size_t>(slot);
    std::array<double, 6> kick{};
    for (int c = 0; c < 6; ++c)
      if (p.inverse_mass[at + c] > 0) // what is prescribed stays so
        {
          double      &v    = p.velocity[at + c];
          const double mass = c < 3 ? p.mass[slot] : p.inertia[slot];
          kick[c]           = c < 3 ? change[c] : spin[c - 3];
          if (core->step_count > 0)
            core->book.work.before += mass * kick[c] * (v + 0.5 * kick[c]);
          v += kick[c];
        }
    if (core->step_count > 0)
      core->kicks.add(slot, kick);
  }

  void Partners::place_vertices(const std::size_t number, const std::vector<Eigen::Vector3d> &place)
  {
    Surface &surface = core->surfaces.surface(number);
    if (place.size() != surface.place.size())
      throw base::InputError("wall " + surface.name + " of " + std::to_string(surface.place.size()) +
                             " vertices: places of " + std::to_string(place.size()) + " were given.");
    double                       furthest = 0;
    std::vector<Eigen::Vector3d> by(place.size());
    for (std::size_t v = 0; v < place.size(); ++v)
      {
        by[v]    = place[v] - surface.place[v];
        furthest = std::max(furthest, by[v].norm());
      }
    core->book.work.after += core->surfaces.put_on(number, by, core->surfaces_with_others());
    surface.place = place; // to the last bit
    core->surfaces.moved(0, furthest);
  }

  void Partners::clear_vertex_impulses(const std::size_t number) { core->surfaces.surface(number).clear_impulses(); }

  void Partners::find_surface_forces() { core->find_forces_of_surfaces(); }

  void Partners::begin_glide() { core->begin_glide(); }
  void Partners::glide(const double step, const double kick) { core->glide(step, kick); }
  void Partners::finish_glide() { core->finish_glide(); }
} // namespace dem
