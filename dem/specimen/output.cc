#include "dem/measures/link_measures.h"
#include "dem/specimen/implementation.h"

#include <Eigen/LU>

#include <algorithm>

namespace dem
{
  double Specimen::Implementation::kinetic_of_velocities() const
  {
    double sum = clumps.kinetic_of_velocities();
    for (std::size_t i = 0; i < particles.count; ++i)
      for (int c = 0; c < 6; ++c)
        {
          const double v = particles.velocity[record_size * i + c];
          sum += 0.5 * (c < 3 ? particles.mass[i] : particles.inertia[i]) * v * v;
        }
    return sum;
  }

  EnergyAccount Specimen::energy() const
  {
    EnergyAccount         e;
    const auto           &s           = *self;
    const SurfaceEnergies of_surfaces = s.surface_energies();
    e.external_work                   = s.work_before + s.work_now;
    e.gravity                         = s.step_count == 0 ? 0.0 : s.weight_work() - s.weight_at_start;
    e.initial                         = s.initial;
    if (s.step_count == 0)
      {
        e.kinetic = s.kinetic_of_velocities();
        e.initial =
          e.kinetic + s.stored_at_start + elastic_energy(s.particles, s.contacts, *s.contact_law) + of_surfaces.stored;
      }
    else
      for (const auto &block : s.accounts)
        e.kinetic += block.kinetic;
    e.elastic = elastic_energy(s.particles, s.bonds, *s.bond_law) +
                elastic_energy(s.particles, s.contacts, *s.contact_law) + of_surfaces.stored;
    e.damage   = damage_dissipation(s.particles, s.bonds, *s.bond_law) + s.broken_damage + of_surfaces.damage;
    e.friction = plastic_dissipation(s.bonds) + plastic_dissipation(s.contacts) + of_surfaces.friction;
    e.released = s.released + released_in_place(s.bonds) + of_surfaces.released;
    e.damping  = s.damped_before + s.damped_now + viscous_dissipation(s.contacts) + of_surfaces.viscous;
    e.rounding = s.rounding_energy;
    return e;
  }

  double Specimen::kinetic_energy() const
  {
    if (self->step_count == 0)
      return self->kinetic_of_velocities();
    double sum = 0;
    for (const auto &block : self->accounts)
      sum += block.kinetic;
    return sum;
  }

  double Specimen::external_work() const { return self->work_before + self->work_now; }

  std::size_t Specimen::logged_breaks() const { return self->breaks.size(); }

  std::vector<Break> Specimen::breaks(const std::size_t from) const
  {
    std::vector<Break> found;
    for (std::size_t b = from; b < self->breaks.size(); ++b)
      {
        found.push_back(self->breaks.at(b));
        for (std::int32_t &end : found.back().ends)
          if (end >= 0)
            end = self->particles.number[static_cast<std::size_t>(end)];
      }
    return found;
  }

  Eigen::Vector3d Specimen::displacement(const std::size_t particle) const
  {
    const auto i = static_cast<std::size_t>(self->slot.at(particle));
    return self->particles.position_of(i) - Eigen::Vector3d(&self->particles.reference[3 * i]);
  }

  double Specimen::mean_damage() const
  {
    if (self->made_links == 0)
      return 0.0;
    double     sum = static_cast<double>(self->crack_log.size() / 2);
    LinkReader reader(self->particles, self->bonds, *self->bond_law);
    for (std::size_t l = 0; l < self->bonds.count; ++l)
      if (self->bonds.is_alive(l) && !self->bonds.is_broken(l))
        {
          reader.read(l);
          sum += reader.damage().stiffness;
        }
    return sum / static_cast<double>(self->made_links);
  }

  ParticleOutput Specimen::particles() const
  {
    const Particles             &p = self->particles;
    const std::size_t            n = p.count;
    std::vector<double>          damage(n, 0.0);
    std::vector<Eigen::Matrix3d> moments(n, Eigen::Matrix3d::Zero());
    add_stress_moments(p, self->bonds, moments);
    add_stress_moments(p, self->contacts, moments);
    for (const SurfaceContact &contact : self->surfaces.list())
      moments[static_cast<std::size_t>(contact.particle)] +=
        contact.distance * contact.direction * contact.force.transpose();
    for (const SurfaceBonds &glue : self->surfaces.bonds())
      for (std::size_t bond = 0; bond < glue.count(); ++bond)
        if (glue.is_alive(bond))
          moments[static_cast<std::size_t>(glue.particle_of(bond))] += glue.branch(bond) * glue.force(bond).transpose();
    LinkReader reader(p, self->bonds, *self->bond_law);
    for (std::size_t l = 0; l < self->bonds.count; ++l)
      if (self->bonds.is_alive(l) && !self->bonds.is_broken(l))
        {
          reader.read(l);
          damage[self->bonds.first[l]] += reader.damage().stiffness;
          damage[self->bonds.second[l]] += reader.damage().stiffness;
        }

    ParticleOutput out;
    out.position.resize(n);
    out.displacement.resize(n);
    out.velocity.resize(n);
    out.angular_velocity.resize(n);
    out.radius.resize(n);
    out.mass.resize(n);
    out.damage.resize(n);
    out.broken_links.resize(n);
    out.volume.resize(n);
    out.held.assign(n, 0);
    out.stress.resize(n);
    out.material.resize(p.material.size());
    for (const HeldGrip &grip : self->grips)
      for (const std::size_t i : grip.grip.particles)
        out.held[i] = 1;
    for (std::size_t i = 0; i < n; ++i)
      {
        const std::size_t     to     = static_cast<std::size_t>(p.number[i]);
        const double          space  = self->space_per_solid * p.cell.deformation().determinant(); // 1 without a cell
        const double          volume = space * self->shape.volume(p.radius_of(i));
        const Eigen::Matrix3d moment = moments[i] / volume;
        out.position[to]             = p.position_of(i);
        out.displacement[to]         = p.position_of(i) - Eigen::Vector3d(&p.reference[3 * i]);
        out.velocity[to]         = Eigen::Vector3d(&p.velocity[record_size * i]) + p.cell.gradient() * p.position_of(i);
        out.angular_velocity[to] = Eigen::Vector3d(&p.velocity[record_size * i + 3]);
        out.radius[to]           = p.radius_of(i);
        out.mass[to]             = self->mass_of(i);
        out.damage[to]           = p.made_links[i] > 0 ? (damage[i] + p.broken_links[i]) / p.made_links[i] : 0.0;
        out.broken_links[to]     = p.broken_links[i];
        if (!p.material.empty())
          out.material[to] = p.material[i];
        out.volume[to] = volume;
        out.stress[to] = 0.5 * (moment + moment.transpose());
      }
    return out;
  }

  namespace
  {
    void append(LinkOutput &out, const Particles &particles, const LinkSet &links, const LinkLaw &law)
    {
      LinkReader reader(particles, links, law);
      for (std::size_t l = 0; l < links.count; ++l)
        {
          if (!links.is_alive(l))
            continue;
          reader.read(l);
          if (law.waits() && reader.phase() == LinkPhase::apart)
            continue;
          if (links.several_pairs)
            out.pair.push_back(links.pair[l]);
          const LinkView &view     = reader.view();
          const bool      cohesive = law.bonds() && !links.is_broken(l);
          const double normal = view.force.dot(view.direction), shear = (view.force - normal * view.direction).norm();
          out.ends.push_back({static_cast<std::size_t>(particles.number[links.first[l]]),
                              static_cast<std::size_t>(particles.number[links.second[l]])});
          out.kind.push_back(cohesive ? LinkOutput::cohesive : LinkOutput::contact);
          out.normal_force.push_back(normal);
          out.shear_force.push_back(shear);
          out.normal_stress.push_back(normal / links.area[l]);
          out.shear_stress.push_back(shear / links.area[l]);
          out.normal_strain.push_back(view.strain);
          out.damage.push_back(reader.damage().stiffness);
          out.strength_damage.push_back(reader.damage().strength);
          out.dissipated.push_back(cohesive ? reader.damage_dissipation() : 0.0);
          out.load.push_back(load_at(particles, links, l));
          std::size_t shown = 0;
          for (std::size_t c = 0; c < links.quantities.size(); ++c)
            if (law.bonds() && links.quantities[c].shown)
              out.history[shown++].push_back(links.history[c][l]);
          for (; shown < out.history.size(); ++shown)
            out.history[shown].push_back(0.0);
        }
    }
  } // namespace

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

  Eigen::Vector3d Specimen::force_on(const std::vector<std::size_t> &group) const
  {
    const std::vector<bool> is_of = members(group, self->slot);
    Eigen::Vector3d         sum   = Eigen::Vector3d::Zero();
    for (const LinkSet *links : {&self->bonds, &self->contacts})
      for (std::size_t l = 0; l < links->count; ++l)
        if (links->is_alive(l) && is_of[links->first[l]] != is_of[links->second[l]])
          {
            const Eigen::Vector3d force = link_at(self->particles, *links, l).force;
            sum += is_of[links->first[l]] ? force : Eigen::Vector3d(-force);
          }
    self->surfaces.each_push(
      [&](std::int32_t, const std::int32_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &) {
        if (is_of[static_cast<std::size_t>(particle)])
          sum += force;
      });
    return sum;
  }

  std::size_t Specimen::broken_links_of(const std::vector<std::size_t> &group) const
  {
    const std::vector<bool> is_of = members(group, self->slot);
    std::size_t             count = 0;
    for (std::size_t i = 0; i < self->crack_log.size(); i += 2)
      count +=
        is_of[static_cast<std::size_t>(self->crack_log[i])] || is_of[static_cast<std::size_t>(self->crack_log[i + 1])] ?
          1 :
          0;
    return count;
  }

  LinkOutput Specimen::links() const
  {
    LinkOutput out;
    for (const LinkQuantity &quantity : self->bond_law->columns())
      if (quantity.shown && self->bond_law->bonds())
        out.quantities.push_back(quantity);
    out.history.resize(out.quantities.size());
    append(out, self->particles, self->bonds, *self->bond_law);
    append(out, self->particles, self->contacts, *self->contact_law);
    for (std::size_t i = 0; i < self->crack_log.size(); i += 2)
      {
        out.ends.push_back({static_cast<std::size_t>(self->particles.number[self->crack_log[i]]),
                            static_cast<std::size_t>(self->particles.number[self->crack_log[i + 1]])});
        out.kind.push_back(LinkOutput::broken);
        if (self->bond_law->several())
          out.pair.push_back(material_pair(self->particles.material[self->crack_log[i]],
                                           self->particles.material[self->crack_log[i + 1]]));
        out.damage.push_back(1.0);
        out.strength_damage.push_back(1.0);
        const double         *geometry = &self->crack_geometry[record_size * (i / 2)];
        const Eigen::Vector3d branch(geometry), contact(geometry + 3);
        const double          arm = 0.5 * (branch.norm() + self->particles.radius_of(self->crack_log[i]) -
                                  self->particles.radius_of(self->crack_log[i + 1]));
        out.dissipated.push_back(geometry[6]);
        out.load.push_back({contact - arm * branch.normalized(), branch, contact, {0, 0, 0}, {0, 0, 0}});
        for (auto &column : out.history)
          column.push_back(0.0);
        for (auto *column :
             {&out.normal_force, &out.shear_force, &out.normal_stress, &out.shear_stress, &out.normal_strain})
          column->push_back(0.0);
      }
    for (const SurfaceBonds &glue : self->surfaces.bonds())
      glue.show(out.glue, self->particles, self->surfaces.surfaces()[static_cast<std::size_t>(glue.surface())]);
    return out;
  }
} // namespace dem
