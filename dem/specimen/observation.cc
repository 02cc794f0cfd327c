#include "dem/specimen/observation.h"

#include "dem/measures/link_measures.h"
#include "dem/ranks/exact_sum.h"
#include "dem/specimen/core.h"
#include "dem/specimen/shown.h"

#include <Eigen/LU>

#include <algorithm>
#include <utility>

namespace dem
{
  ObservedSpecimen::ObservedSpecimen(std::unique_ptr<SpecimenCore> core)
    : self(std::move(core))
  {
  }
  ObservedSpecimen::~ObservedSpecimen()                                       = default;
  ObservedSpecimen::ObservedSpecimen(ObservedSpecimen &&) noexcept            = default;
  ObservedSpecimen &ObservedSpecimen::operator=(ObservedSpecimen &&) noexcept = default;
  ObservedSpecimen::ObservedSpecimen(const ObservedSpecimen &other)
    : self(std::make_unique<SpecimenCore>(*other.self))
  {
  }
  ObservedSpecimen &ObservedSpecimen::operator=(const ObservedSpecimen &other)
  {
    if (this != &other)
      *self = *other.self;
    return *this;
  }

  const SpecimenParameters &ObservedSpecimen::parameters() const { return self->parameters; }

  std::int64_t ObservedSpecimen::steps() const { return self->step_count; }
  double       ObservedSpecimen::time() const { return self->time; }
  double       ObservedSpecimen::time_step() const { return self->time_step; }

  double ObservedSpecimen::stable_step() const { return self->stable(); }

  double ObservedSpecimen::critical_step() const
  {
    self->gather();
    return dem::critical_step(self->particles, self->all_links(), self->parameters.physics.rotations);
  }

  Counts ObservedSpecimen::counts() const
  {
    const std::size_t in_place = self->bonds.broken();
    return {self->particles.count,
            self->bonds.alive - in_place,
            self->touching_contacts() + in_place,
            self->cracks.count(),
            self->search.searches(),
            self->surfaces.count(),
            std::max(self->overlaps.deepest(), self->deepest_overlap().depth),
            self->largest_turn};
  }

  std::vector<RankWork> ObservedSpecimen::shares() const
  {
    return self->shares() ? self->shared->work(self->bonds, self->contacts, self->surfaces) : std::vector<RankWork>{};
  }

  std::size_t ObservedSpecimen::bytes() const
  {
    return self->particles.bytes() + self->bonds.bytes() + self->contacts.bytes();
  }

  double ObservedSpecimen::longest_step() const { return self->longest_step; }

  GripReadings    ObservedSpecimen::grips() const { return GripReadings(*self); }
  SurfaceReadings ObservedSpecimen::surfaces() const { return SurfaceReadings(*self); }
  ClumpReadings   ObservedSpecimen::clumps() const { return ClumpReadings(*self); }

  namespace
  {
    std::array<bool, 6> held_axes(const double *inverse_mass)
    {
      std::array<bool, 6> held{};
      for (std::size_t c = 0; c < held.size(); ++c)
        held[c] = !(inverse_mass[c] > 0);
      return held;
    }
  } // namespace

  ParticleState ObservedSpecimen::particle(const std::size_t number) const
  {
    self->gather_particle(self->slot.at(number));
    const Particles &p = self->particles;
    const auto       i = static_cast<std::size_t>(self->slot.at(number));
    const double    *v = &p.velocity[record_size * i];
    return {p.position_of(i),   Eigen::Vector3d(&p.motion[record_size * i]),
            Eigen::Vector3d(v), Eigen::Vector3d(v + 3),
            p.radius_of(i),     self->mass_of(i),
            p.inertia[i],       held_axes(&p.inverse_mass[record_size * i])};
  }

  double ObservedSpecimen::mass(const std::size_t particle) const
  {
    return self->mass_of(static_cast<std::size_t>(self->slot.at(particle)));
  }

  double ObservedSpecimen::stiffness_around(const std::size_t number) const
  {
    self->gather();
    return dem::stiffness_around(self->particles, self->all_links(), self->parameters.physics.rotations,
                                 self->slot.at(number), 0, self->stiffening.ahead());
  }

  namespace
  {
    double elastic_energy_of_contacts(SpecimenCore &core)
    {
      double sum = 0;
      core.walk(core.contacts, &sum, 1, [&](const LinkRange &lines) {
        add_elastic_energy(core.particles, core.contacts, *core.contact_law, lines, sum);
      });
      return sum;
    }

    /** @pre what blocks have summed up is gathered */
    LinkEnergies energies_of_bonds(SpecimenCore &core)
    {
      LinkEnergies sums = {0, summed_damage(core.bonds)};
      core.walk(core.bonds, sums.data(), sums.size(),
                [&](const LinkRange &lines) { add_energies(core.particles, core.bonds, *core.bond_law, lines, sums); });
      return sums;
    }
  } // namespace

  EnergyAccount ObservedSpecimen::energy() const
  {
    self->gather_accounts();
    if (!self->surfaces.empty())
      self->gather_places();
    EnergyAccount e;
    auto         &s = *self;
    s.gather_wall_contacts();
    const SurfaceEnergies of_surfaces = s.surface_energies();
    const auto [stored, damage]       = energies_of_bonds(s);
    const double of_contacts          = elastic_energy_of_contacts(s);
    e.external_work                   = s.book.work.at_forces();
    e.gravity                         = s.step_count == 0 ? 0.0 : s.weight_work() - s.book.weight_at_start;
    e.initial                         = s.book.initial;
    if (s.step_count == 0)
      {
        e.kinetic = s.kinetic_of_velocities();
        e.initial = e.kinetic + s.book.stored_at_start + of_contacts + of_surfaces.stored;
      }
    else
      for (const auto &block : s.accounts)
        e.kinetic += block.kinetic;
    e.elastic  = stored + of_contacts + of_surfaces.stored;
    e.damage   = damage + s.cracks.dissipated() + of_surfaces.damage;
    e.friction = plastic_dissipation(s.bonds) + plastic_dissipation(s.contacts) + of_surfaces.friction;
    e.released = s.book.released + released_in_place(s.bonds) + of_surfaces.released;
    e.damping =
      s.book.damped.at_forces() + viscous_dissipation(s.bonds) + viscous_dissipation(s.contacts) + of_surfaces.viscous;
    e.rounding = s.book.rounding;
    return e;
  }

  double ObservedSpecimen::kinetic_energy() const
  {
    if (self->step_count == 0)
      return self->kinetic_of_velocities();
    double sum = 0;
    for (const auto &block : self->accounts)
      sum += block.kinetic;
    return sum;
  }

  double ObservedSpecimen::external_work() const { return self->book.work.at_forces(); }

  std::size_t ObservedSpecimen::logged_breaks() const { return self->cracks.events().size(); }

  std::vector<Break> ObservedSpecimen::breaks(const std::size_t from) const
  {
    std::vector<Break> found;
    for (std::size_t b = from; b < self->cracks.events().size(); ++b)
      {
        found.push_back(self->cracks.events().at(b));
        for (std::int32_t &end : found.back().ends)
          if (end >= 0)
            end = self->particles.number[static_cast<std::size_t>(end)];
      }
    return found;
  }

  const std::vector<EmissionEvent> &ObservedSpecimen::emission() const { return self->emission.events(); }

  Eigen::Vector3d ObservedSpecimen::displacement(const std::size_t particle) const
  {
    self->gather_places();
    self->gather_constants();
    return displacement_of(self->particles, static_cast<std::size_t>(self->slot.at(particle)));
  }

  double ObservedSpecimen::mean_damage() const
  {
    if (self->made_links == 0)
      return 0.0;
    ExactSum sum; // links may lie in any order: doc/theory/ranks.md, 6
    self->walk_without_order(self->bonds, sum, [&](const LinkRange &lines) {
      LinkReader reader(self->particles, self->bonds, *self->bond_law);
      each_living(self->bonds, lines, [&](const std::size_t l) {
        if (self->bonds.is_broken(l))
          return;
        reader.read(l);
        sum.add(reader.damage().stiffness);
      });
    });
    sum.add(static_cast<double>(self->cracks.count()));
    return sum.value() / static_cast<double>(self->made_links);
  }

  ParticleKinematics ObservedSpecimen::kinematics() const
  {
    self->gather_particles();
    return kinematics_of(*self, all_of(self->particles));
  }

  ParticleOutput ObservedSpecimen::particles() const
  {
    self->gather_particles();
    const ShownParticles all      = all_of(self->particles);
    const bool           in_parts = !self->has_all_links();
    LinkEffects          effects  = effects_of_links(*self, all, in_parts);
    if (in_parts)
      {
        self->shared->gather_numbers(effects.moments.data()->data(), 9);
        self->shared->gather_numbers(effects.damage.data(), 1);
      }
    return particles_of(*self, all, std::move(effects));
  }

  namespace
  {
    /** Which particles are of a group, in the order of Particles. */
    std::vector<bool> members(const std::vector<std::size_t> &group, const std::vector<std::int32_t> &slot)
    {
      std::vector<bool> is_of(slot.size(), false);
      for (const std::size_t number : group)
        is_of[static_cast<std::size_t>(slot.at(number))] = true;
      return is_of;
    }
  } // namespace

  Eigen::Vector3d ObservedSpecimen::force_on(const std::vector<std::size_t> &group) const
  {
    const std::vector<bool> is_of = members(group, self->slot);
    Eigen::Vector3d         sum   = Eigen::Vector3d::Zero();
    for (const LinkSet *links : {&self->bonds, &self->contacts})
      self->walk(*links, sum.data(), 3, [&](const LinkRange &lines) {
        each_living(*links, lines, [&](const std::size_t l) {
          if (is_of[links->first[l]] == is_of[links->second[l]])
            return;
          const Eigen::Vector3d force = link_at(self->particles, *links, l).force;
          sum += is_of[links->first[l]] ? force : Eigen::Vector3d(-force);
        });
      });
    self->gather_wall_contacts();
    self->surfaces.each_push(
      [&](std::int32_t, const std::int32_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &) {
        if (is_of[static_cast<std::size_t>(particle)])
          sum += force;
      });
    return sum;
  }

  std::size_t ObservedSpecimen::broken_links_of(const std::vector<std::size_t> &group) const
  {
    return self->cracks.count_of(members(group, self->slot));
  }

  LinkOutput ObservedSpecimen::links() const
  {
    self->gather();
    return links_of(*self, all_of(self->particles), false).links;
  }
} // namespace dem
