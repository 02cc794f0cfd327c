// What of a specimen counts where something else fills the same space (doc/theory/volume-coupling.md, 2).

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/measures/link_measures.h"
#include "dem/specimen/implementation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>

namespace dem
{
  namespace
  {
    void refuse_late(const Specimen &specimen, const char *what)
    {
      if (specimen.steps() > 0)
        throw base::InputError(std::string(what) + ": only before the first step.");
      if (specimen.parameters().physics.periodic)
        throw base::InputError(std::string(what) + ": a periodic cell has no place for somebody else's body.");
    }

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

  void Specimen::share(const std::function<double(const Eigen::Vector3d &)> &of_bonds,
                       const std::vector<double>                            &of_masses)
  {
    refuse_late(*this, "Weights");
    Particles &p     = self->particles;
    LinkSet   &bonds = self->bonds;
    for (std::size_t l = 0; l < bonds.count; ++l)
      {
        if (!bonds.is_alive(l))
          continue;
        const Eigen::Vector3d place = contact_point(p, bonds, l);
        bonds.area[l] *= checked(of_bonds(place), place);
      }
    for (std::size_t number = 0; number < p.count; ++number)
      {
        const auto i = static_cast<std::size_t>(self->slot[number]);
        scale_mass(p, i, checked(of_masses.at(number), p.position_of(i)));
      }
    self->longest_step = self->time_step = self->parameters.step_factor * self->stable();
  }

  void Specimen::Implementation::remove_bonds(const std::vector<bool> &among)
  {
    for (std::size_t l = 0; l < bonds.count; ++l)
      if (const auto first = static_cast<std::size_t>(bonds.first[l]),
          second           = static_cast<std::size_t>(bonds.second[l]);
          bonds.is_alive(l) && among[first] && among[second])
        {
          bonds.remove(l);
          --made_links;
          --particles.made_links[first];
          --particles.made_links[second];
        }
    bonds.compact(particles.count);
  }

  void Specimen::Implementation::remove_contacts_within_bodies()
  {
    for (std::size_t l = 0; l < contacts.count; ++l)
      if (contacts.is_alive(l) && particles.in_one_body(contacts.first[l], contacts.second[l]))
        contacts.remove(l);
  }

  void Specimen::leave(const std::vector<std::size_t> &given, const bool keep_bonds_between)
  {
    refuse_late(*this, "Particles of somebody else");
    Particles        &p = self->particles;
    std::vector<bool> left(p.count, false);
    for (const std::size_t number : given)
      {
        const auto i = static_cast<std::size_t>(self->slot.at(number));
        left[i]      = true;
        if (p.clump_of(i) >= 0)
          throw base::InputError("Particle " + std::to_string(number + 1) +
                                 " is a pebble of a clump, and cannot be left to somebody else.");
      }
    if (!keep_bonds_between)
      {
        self->remove_bonds(left);
        p.body.resize(p.count, Particles::alone);
        for (std::size_t i = 0; i < p.count; ++i)
          if (left[i])
            p.body[i] = Particles::left;
        self->remove_contacts_within_bodies();
      }
    Grip grip;
    grip.particles                           = given;
    grip.prescribed                          = {true, true, true, true, true, true};
    const std::size_t                  added = add_grip(grip);
    const std::vector<Eigen::Vector3d> rest(given.size(), Eigen::Vector3d::Zero());
    set_grip_velocities(added, rest, rest);
    for (const std::size_t number : given)
      {
        const auto i = static_cast<std::size_t>(self->slot[number]);
        p.mass[i] = p.inertia[i] = 0;
      }
    self->led_by.resize(p.count, {-1, 0});
    for (std::size_t k = 0; k < self->grips[added].members.size(); ++k)
      self->led_by[static_cast<std::size_t>(self->grips[added].members[k])] = {static_cast<std::int32_t>(added), k};
    self->longest_step = self->time_step = self->parameters.step_factor * self->stable();
  }

  namespace
  {
    void refuse_clump(const RigidClump &clump, const bool planar)
    {
      if (clump.particles.empty())
        throw base::InputError("Clump: has no particle.");
      if (!(clump.mass > 0 && std::isfinite(clump.mass)))
        throw base::InputError("Clump: mass of " + base::number_text(clump.mass) + " kg: must be above 0.");
      const bool turns =
        planar ? clump.inertia(2, 2) > 0 : clump.inertia.ldlt().isPositive() && clump.inertia.determinant() > 0;
      if (!turns || !clump.inertia.allFinite())
        throw base::InputError("Clump: its inertia must be symmetric and positive.");
    }
  } // namespace

  std::size_t Specimen::add_clump(const RigidClump &clump)
  {
    refuse_late(*this, "Clumps");
    const bool planar = self->parameters.physics.dimension == 2;
    refuse_clump(clump, planar);
    Particles        &p = self->particles;
    std::vector<bool> pebble(p.count, false);
    p.body.resize(p.count, Particles::alone);
    double whole = 0;
    for (const std::size_t number : clump.particles)
      {
        const auto i = static_cast<std::size_t>(self->slot.at(number));
        if (p.clump_of(i) >= 0 || p.inverse_mass[record_size * i] == 0)
          throw base::InputError("Clump: particle " + std::to_string(number + 1) +
                                 " is held, left to somebody else or a pebble of another clump.");
        pebble[i] = true;
        whole += p.mass[i];
      }
    std::vector<std::int32_t> members;
    std::vector<double>       shares;
    for (std::size_t i = 0; i < p.count; ++i)
      if (pebble[i])
        {
          members.push_back(static_cast<std::int32_t>(i));
          shares.push_back(p.mass[i] / whole);
          p.body[i] = static_cast<std::int32_t>(self->clumps.size());
          p.mass[i] = p.inertia[i] = 0;
          std::fill_n(&p.inverse_mass[record_size * i], 6, 0.0);
        }
    self->clumps.add(clump, members, shares, p, planar);
    self->accounts.resize(particle_blocks(p.count) + 1);
    self->remove_bonds(pebble);
    self->remove_contacts_within_bodies();
    const double step =
      self->bond_law->bonds() ? self->stable() : std::min(self->stable(), self->step_of_lone_particles());
    self->longest_step = self->time_step = self->parameters.step_factor * step;
    return self->clumps.size() - 1;
  }

  std::size_t Specimen::clumps() const { return self->clumps.size(); }

  ClumpState Specimen::clump(const std::size_t number) const { return self->clumps.state(number); }

  std::optional<std::size_t> Specimen::clump_of(const std::size_t particle) const
  {
    const std::int32_t clump = self->particles.clump_of(static_cast<std::size_t>(self->slot.at(particle)));
    return clump < 0 ? std::nullopt : std::optional<std::size_t>(clump);
  }
} // namespace dem
