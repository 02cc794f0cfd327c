#include "dem/specimen/specimen.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/contacts/particle_pairs.h"
#include "dem/measures/bulk_volume.h"
#include "dem/neighbours/tie.h"
#include "dem/specimen/implementation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

namespace dem
{
  namespace
  {
    [[noreturn]] void refuse(const char *entry, const double value, const char *rule)
    {
      std::ostringstream message;
      message << entry << " = " << value << ": " << rule;
      throw base::InputError(message.str());
    }

    void check(const SpecimenParameters &p)
    {
      if (p.physics.dimension != 2 && p.physics.dimension != 3)
        refuse("Dimension", p.physics.dimension, "must be 2 or 3.");
      if (!(p.density > 0))
        refuse("Density", p.density, "must be above 0 kg/m^3.");
      if (!(p.interaction_ratio >= 1 && p.interaction_ratio <= 10))
        refuse("Interaction ratio", p.interaction_ratio,
               "must be at least 1, and at most 10. 1.5 is usual for concrete.");
      if (!(p.installation_gap >= 0 && std::isfinite(p.installation_gap)))
        refuse("Installation gap", p.installation_gap, "must not be negative.");
      if (!(p.step_factor > 0 && p.step_factor < 1.5))
        refuse("Step factor", p.step_factor, "must be above 0, and below 1 for a stable run.");
      if (const double most = p.physics.largest_overlap; !(most > 0 && most <= DeepestOverlap::gone_through))
        refuse("Largest overlap", most, "must be above 0, and at most 1.");
      if (!(p.damping >= 0 && p.damping < 1))
        refuse("Damping", p.damping, "must be in [0, 1).");
      if (!p.gravity.allFinite())
        throw base::InputError("Gravity: must be finite.");
      if (p.physics.periodic && !p.gravity.isZero(0))
        throw base::InputError("Gravity: a periodic cell has nothing to stand on and would fall for ever.");
      if (p.physics.dimension == 2 && p.gravity.z() != 0)
        throw base::InputError("Gravity: in two dimensions it must lie in the plane, z = 0.");
      if (p.physics.dimension == 2 && !(p.thickness > 0))
        refuse("Thickness", p.thickness, "must be above 0 m in two dimensions.");
    }

    void check_plane(const Packing &packing)
    {
      for (std::size_t i = 0; i < packing.size(); ++i)
        if (packing.centre[i].z() != 0)
          {
            std::ostringstream message;
            message << "particle " << i + 1 << ": z = " << packing.centre[i].z()
                    << " m, but a scene in two dimensions lies in the plane z = 0.";
            throw base::InputError(message.str());
          }
    }

    /** The packing's cell, or none. In the plane the third base vector is the thickness. */
    Cell make_cell(const Packing &packing, const SpecimenParameters &p)
    {
      if (!p.physics.periodic)
        return {};
      if (!packing.periodic_cell)
        throw base::InputError(
          "Periodic: the packing has no periodic cell. Use a periodic packing, or a free specimen.");
      Eigen::Vector3d edges = *packing.periodic_cell;
      if (p.physics.dimension == 2)
        edges.z() = p.thickness;
      if (!edges.allFinite())
        throw base::InputError("Periodic: the edges of the packing's periodic cell must be finite.");
      return Cell(edges.asDiagonal(), p.physics.dimension);
    }

    /** Their materials are noted only where there are several. */
    Particles make_particles_in_cell(const Packing            &packing,
                                     const ParticleShape      &shape,
                                     const SpecimenParameters &p,
                                     const bool                several_materials)
    {
      Particles particles = make_particles(packing, shape, p.physics.rotations);
      particles.cell      = make_cell(packing, p);
      if (!several_materials)
        particles.material.clear();
      else if (particles.material.empty())
        particles.material.assign(particles.count, 0);
      return particles;
    }

    /** As much as rounding of places strains a bond or a contact, a few digits more; see EnergyAccount::rounding. */
    constexpr double strain_of_rounding = 1e-11;

    /**
     * Bounding box of the particles (or their cell) over their own volume: how much space, voids included, stands for one volume of
     * particle. Of those that have links: what flies beside the specimen is no part of it.
     */
    double volume_per_solid(const Particles &p, const ParticleShape &shape)
    {
      std::vector<Eigen::Vector3d> centre;
      std::vector<double>          radius, solid;
      double                       all = 0;
      for (std::size_t i = 0; i < p.count; ++i)
        {
          all += shape.volume(p.radius_of(i));
          if (p.made_links[i] == 0)
            continue;
          centre.push_back(p.position_of(i));
          radius.push_back(p.radius_of(i));
          solid.push_back(shape.volume(p.radius_of(i)));
        }
      if (p.cell.repeats())
        return p.cell.volume() / all;
      return centre.empty() ? 1.0 : bulk_over_solid(centre, radius, solid, shape.dimension, shape.thickness);
    }
  } // namespace

  Specimen::Implementation::Implementation(const Packing            &packing,
                                           const SpecimenParameters &p,
                                           const LinkMaterials      &materials)
    : parameters(p)
    , shape{p.physics.dimension, p.density, p.thickness, materials.densities(p.density)}
    , particles(make_particles_in_cell(packing, shape, p, materials.several()))
    , equal_radii(std::all_of(
        packing.radius.begin(), packing.radius.end(), [&](const double r) { return r == packing.radius[0]; }))
    , smallest_radius(*std::min_element(packing.radius.begin(), packing.radius.end()))
    , bond_law(materials.bonds(p.physics))
    , contact_law(materials.contacts(p.physics))
    , unbonded(materials.unbonded_pairs())
    , start_margin(2.0 * smallest_radius * std::max((1 - tie) * p.interaction_ratio - 1.0, 0.0) +
                   (1 - tie) * p.installation_gap)
    , search(particles, start_margin, contact_law->waits())
    , bond_pass(bond_law->pass(mixture()))
    , contact_pass(contact_law->pass(mixture()))
    , accounts(particle_blocks(particles.count))
    , slot(particles.count)
  {
    for (std::size_t i = 0; i < particles.count; ++i)
      slot[particles.number[i]] = static_cast<std::int32_t>(i);
    link();
    overlap_ahead   = overlap_ahead_of_all();
    space_per_solid = volume_per_solid(particles, shape);
    longest_step = time_step = parameters.step_factor * (bond_law->bonds() ? stable() : step_of_lone_particles());
    if (!std::isfinite(time_step))
      throw base::InputError(
        "Interaction ratio = " + base::number_text(p.interaction_ratio) +
        ": no two particles are near enough to be linked, nothing holds the specimen together. Raise "
        "the ratio or check the packing.");
    rounding_energy = made_links > 0 ? energy_of_strain(particles, bonds, *bond_law, strain_of_rounding) :
                                       energy_of_strained_packing(strain_of_rounding);
    if (parameters.physics.contacts)
      make_contacts(); // of what overlaps from the start
  }

  std::size_t Specimen::Implementation::touching_contacts() const
  {
    if (!contact_law->waits())
      return contacts.alive;
    std::size_t touching = 0;
    for (std::size_t l = 0; l < contacts.count; ++l)
      touching +=
        contacts.is_alive(l) && !Eigen::Map<const Eigen::Vector3d>(&contacts.force[record_size * l]).isZero(0);
    return touching;
  }

  void Specimen::Implementation::leave_loose(std::vector<NeighbourPair> &pairs)
  {
    if (parameters.loose == 0)
      return;
    const auto first_loose = static_cast<std::int32_t>(particles.count - std::min(parameters.loose, particles.count));
    const auto is_loose    = [&](const std::int32_t i) {
      return particles.number[static_cast<std::size_t>(i)] >= first_loose;
    };
    double     margin     = start_margin;
    const auto linked_end = std::remove_if(pairs.begin(), pairs.end(), [&](const NeighbourPair &pair) {
      if (!is_loose(pair.first) && !is_loose(pair.second))
        return false;
      margin = std::min(margin, gap(particles, {pair.first, pair.second, 0}));
      return true;
    });
    pairs.erase(linked_end, pairs.end());
    search = ContactSearch(particles, std::max(margin, 0.0), contact_law->waits());
  }

  void Specimen::Implementation::leave_unbonded(std::vector<NeighbourPair> &pairs)
  {
    if (unbonded.empty())
      return;
    const auto material = [&](const std::int32_t i) {
      return particles.material.empty() ? 0 : particles.material[static_cast<std::size_t>(i)];
    };
    const auto linked_end = std::remove_if(pairs.begin(), pairs.end(), [&](const NeighbourPair &pair) {
      return unbonded[static_cast<std::size_t>(material_pair(material(pair.first), material(pair.second)))];
    });
    if (linked_end == pairs.end())
      return;
    pairs.erase(linked_end, pairs.end());
    search = ContactSearch(particles, 0.0, contact_law->waits()); // they may touch from the start
  }

  double Specimen::Implementation::step_of_lone_particles() const
  {
    std::vector<double> history(contact_law->columns().size());
    const auto          stiffness = [&](const std::size_t i, const std::size_t pair, const double lever) {
      constexpr double neighbours = 12; // as many equal spheres touch one
      const double     r = particles.radius_of(i), area = shape.link_area(r, r);
      NewLink          fresh;
      fresh.distance     = 2 * r;
      fresh.first_radius = fresh.second_radius = r;
      fresh.area                               = area;
      fresh.thickness                          = shape.dimension == 3 ? 0 : shape.thickness;
      std::fill(history.begin(), history.end(), 0.0);
      contact_law->begin(pair, fresh, history.data());
      const double          strain = contact_law->stiffens() ? -overlap_ahead / (2 * r) : -1e-9;
      const LinkStiffnesses s = contact_law->stiffness_of_step(pair, {strain, 2 * r, 2 * r, area}, history.data());
      return neighbours * area / (2 * r) * std::max(s.normal, s.shear * (1 + lever));
    };
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t pair = 0; pair < contact_law->pairs(); ++pair)
      {
        for (std::size_t i = 0; i < particles.count; ++i)
          if (const double mass = particles.mass[i]; mass > 0)
            {
              const double r     = particles.radius_of(i),
                           lever = parameters.physics.rotations ? mass * r * r / particles.inertia[i] : 0.0;
              smallest           = std::min(smallest, std::sqrt(2 * mass / stiffness(i, pair, lever)));
            }
        for (std::size_t clump = 0; clump < clumps.size(); ++clump)
          smallest = std::min(smallest, clumps.stable_step(particles, clump, [&](const std::int32_t pebble) {
            return stiffness(static_cast<std::size_t>(pebble), pair, 0.0);
          }));
      }
    return smallest;
  }

  double Specimen::Implementation::energy_of_strained_packing(const double strain) const
  {
    const double speed = 2 * smallest_radius * parameters.step_factor / longest_step;
    return 0.5 * std::accumulate(particles.mass.begin(), particles.mass.end(), 0.0) * speed * speed * strain * strain;
  }

  void Specimen::Implementation::link()
  {
    std::vector<NeighbourPair> pairs;
    if (bond_law->bonds())
      {
        pairs = particle_pairs(particles, parameters.interaction_ratio, parameters.installation_gap);
        leave_loose(pairs);
        leave_unbonded(pairs);
      }
    else
      search = ContactSearch(particles, 0.0, contact_law->waits()); // any two may be in contact from the start
    make_links(bonds, pairs, particles, shape, *bond_law);
    if (bonds.logs_breaks)
      {
        // Those that never hold do not break.
        LinkReader reader(particles, bonds, *bond_law);
        for (std::size_t l = 0; l < bonds.count; ++l)
          {
            if (!bonds.is_alive(l))
              continue;
            reader.read(l, Geometry::present);
            bonds.noted[l] = reader.phase() == LinkPhase::whole ? 0 : 1;
          }
      }
    made_links = pairs.size();
    for (const auto &pair : pairs)
      {
        ++particles.made_links[pair.first];
        ++particles.made_links[pair.second];
      }
    add_contacts(contacts, {}, particles, shape, *contact_law);
  }

  Specimen::Specimen(const Packing &packing, const SpecimenParameters &parameters, const LinkMaterials &materials)
  {
    check(parameters);
    check_packing(packing, "packing");
    check_in_cell(packing, "packing");
    check_materials(packing, materials);
    if (parameters.physics.dimension == 2)
      check_plane(packing);
    self = std::make_unique<Implementation>(packing, parameters, materials);
  }

  Specimen::~Specimen()                               = default;
  Specimen::Specimen(Specimen &&) noexcept            = default;
  Specimen &Specimen::operator=(Specimen &&) noexcept = default;
  Specimen::Specimen(const Specimen &other)
    : self(std::make_unique<Implementation>(*other.self))
  {
  }
  Specimen &Specimen::operator=(const Specimen &other)
  {
    if (this != &other)
      *self = *other.self;
    return *this;
  }

  void Specimen::advance(const std::int64_t steps)
  {
    advance(steps, [] { return true; });
  }

  void Specimen::advance(const std::int64_t steps, const std::function<bool()> &go_on)
  {
    if (self->step_count == 0)
      self->begin();
    bool more = true;
    for (std::int64_t s = 0; s < steps && more; ++s)
      {
        self->step();
        more = go_on();
      }
    self->check_numbers();
  }

  const SpecimenParameters &Specimen::parameters() const { return self->parameters; }

  std::int64_t Specimen::steps() const { return self->step_count; }
  double       Specimen::time() const { return self->time; }
  double       Specimen::time_step() const { return self->time_step; }
  double       Specimen::stable_step() const { return self->stable(); }

  double Specimen::critical_step() const
  {
    return dem::critical_step(self->particles, self->all_links(), self->parameters.physics.rotations);
  }

  Counts Specimen::counts() const
  {
    const std::size_t in_place = self->bonds.broken();
    return {self->particles.count,
            self->bonds.alive - in_place,
            self->touching_contacts() + in_place,
            self->crack_log.size() / 2,
            self->search.searches(),
            self->surfaces.list().size(),
            std::max(self->deepest_seen, self->deepest().depth),
            self->largest_turn};
  }

  std::size_t Specimen::bytes() const { return self->particles.bytes() + self->bonds.bytes() + self->contacts.bytes(); }

  std::size_t Specimen::add_grip(const Grip &grip)
  {
    if (self->parameters.physics.periodic)
      throw base::InputError("Grips: a periodic cell has no place for them; it is loaded by its deformation.");
    for (const std::size_t particle : grip.particles)
      if (self->particles.clump_of(static_cast<std::size_t>(self->slot.at(particle))) >= 0)
        throw base::InputError("Grips: particle " + std::to_string(particle + 1) +
                               " is a pebble of a clump, which moves as a whole. Hold others.");
    HeldGrip held;
    held.grip = grip;
    std::vector<std::pair<std::int32_t, std::size_t>> order;
    for (std::size_t k = 0; k < grip.particles.size(); ++k)
      order.emplace_back(self->slot.at(grip.particles[k]), k);
    std::sort(order.begin(), order.end());
    for (const auto &[member, given] : order)
      {
        held.members.push_back(member);
        held.given.push_back(given);
      }
    held.lost_velocity.assign(6 * held.members.size(), 0.0);
    for (const std::int32_t i : held.members)
      for (int c = 0; c < 6; ++c)
        if (grip.prescribed[c])
          self->particles.inverse_mass[record_size * static_cast<std::size_t>(i) + c] = 0.0;
    self->grips.push_back(std::move(held));
    set_grip_velocity(self->grips.size() - 1, grip.velocity, grip.spin);
    return self->grips.size() - 1;
  }

  void
  Specimen::set_grip_velocity(const std::size_t number, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin)
  {
    HeldGrip &held     = self->grips.at(number);
    held.grip.velocity = velocity;
    held.grip.spin     = spin;
    held.own_rates.clear();
    for (std::size_t k = 0; k < held.members.size(); ++k)
      for (int c = 0; c < 6; ++c)
        self->set_rate(held, k, c);
  }

  void Specimen::set_damping(const double damping)
  {
    if (!(damping >= 0 && damping < 1))
      throw base::InputError("Damping: must be in [0, 1).");
    self->parameters.damping = damping;
  }

  Eigen::Vector3d Specimen::reaction(const std::size_t grip) const
  {
    const auto &pull = self->grips.at(grip).pull;
    return {-pull[0], -pull[1], -pull[2]};
  }

  Eigen::Vector3d Specimen::reaction_moment(const std::size_t grip) const
  {
    const auto &pull = self->grips.at(grip).pull;
    return {-pull[3], -pull[4], -pull[5]};
  }

  void Specimen::set_velocity(const std::size_t particle, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin)
  {
    double *v = &self->particles.velocity[record_size * static_cast<std::size_t>(self->slot.at(particle))];
    std::copy_n(velocity.data(), 3, v);
    std::copy_n(spin.data(), 3, v + 3);
    const std::int32_t of = self->particles.clump_of(static_cast<std::size_t>(self->slot[particle]));
    if (of >= 0)
      self->clumps.take_velocities(self->particles, static_cast<std::size_t>(of));
  }

  void Specimen::set_velocities(const std::vector<AskedVelocity> &asked)
  {
    Particles                       &p = self->particles;
    std::set<std::size_t>            moved; // clumps
    std::vector<std::array<bool, 6>> given(p.count, {true, true, true, true, true, true});
    for (const AskedVelocity &one : asked)
      {
        const auto i = static_cast<std::size_t>(self->slot.at(one.particle));
        for (int c = 0; c < 6; ++c)
          p.velocity[record_size * i + c] = !one.given[c] ? 0.0 : c < 3 ? one.velocity[c] : one.spin[c - 3];
        given[i] = one.given;
        if (p.clump_of(i) >= 0)
          moved.insert(static_cast<std::size_t>(p.clump_of(i)));
      }
    for (const std::size_t clump : moved)
      {
        self->clumps.take_velocities(p, clump, given);
        self->clumps.lead(p, clump);
      }
  }

  namespace
  {
    void visit_kicks(base::StateVisitor &visitor, std::vector<VelocityKick> &kicks)
    {
      std::vector<std::int32_t> particle;
      base::Column              change;
      for (const VelocityKick &kick : kicks)
        {
          particle.push_back(kick.particle);
          change.insert(change.end(), kick.change.begin(), kick.change.end());
        }
      visitor.column("kicks/particle", particle);
      visitor.column("kicks/change", change);
      kicks.resize(particle.size());
      for (std::size_t k = 0; k < kicks.size(); ++k)
        {
          kicks[k].particle = particle[k];
          std::copy_n(&change[6 * k], 6, kicks[k].change.begin());
        }
    }
  } // namespace

  void Specimen::visit_state(base::StateVisitor &visitor)
  {
    auto &s = *self;
    s.particles.visit_state(visitor);
    s.bonds.visit_state(visitor, "bonds", s.particles.count);
    s.contacts.visit_state(visitor, "contacts", s.particles.count);
    s.search.visit_state(visitor);
    s.breaks.visit_state(visitor);
    visitor.column("crack_log", s.crack_log);
    visitor.column("crack_geometry", s.crack_geometry);
    if (s.parameters.physics.periodic)
      for (int c = 0; c < 9; ++c)
        visitor.scalar("cell/stress_moment_" + std::to_string(c), s.stress_moment.data()[c]);
    visitor.scalar("step", s.step_count);
    for (const auto &[name, value] :
         std::initializer_list<std::pair<const char *, double *>>{{"time", &s.time},
                                                                  {"time_step", &s.time_step},
                                                                  {"last_step", &s.last_step},
                                                                  {"longest_step", &s.longest_step},
                                                                  {"damping", &s.parameters.damping},
                                                                  {"energy/initial", &s.initial},
                                                                  {"energy/stored_at_start", &s.stored_at_start},
                                                                  {"energy/weight_at_start", &s.weight_at_start},
                                                                  {"energy/work_before", &s.work_before},
                                                                  {"energy/work_now", &s.work_now},
                                                                  {"energy/work_after", &s.work_after},
                                                                  {"energy/damped_before", &s.damped_before},
                                                                  {"energy/damped_now", &s.damped_now},
                                                                  {"energy/damped_after", &s.damped_after},
                                                                  {"energy/released", &s.released},
                                                                  {"energy/broken_damage", &s.broken_damage},
                                                                  {"deepest_overlap", &s.deepest_seen},
                                                                  {"largest_turn", &s.largest_turn},
                                                                  {"path_unlooked", &s.path_unlooked}})
      visitor.scalar(name, *value);
    if (s.contact_law->stiffens())
      {
        visitor.scalar("overlap_ahead", s.overlap_ahead);
        visitor.scalar("path_since_step", s.path_since_step);
      }
    for (std::size_t g = 0; g < s.grips.size(); ++g)
      {
        const std::string name = "grips/" + std::to_string(g);
        for (int c = 0; c < 6; ++c)
          visitor.scalar(name + "/pull_" + std::to_string(c), s.grips[g].pull[c]);
        for (int c = 0; c < 3; ++c)
          {
            visitor.scalar(name + "/velocity_" + std::to_string(c), s.grips[g].grip.velocity[c]);
            visitor.scalar(name + "/spin_" + std::to_string(c), s.grips[g].grip.spin[c]);
          }
        visitor.column(name + "/lost_velocity", s.grips[g].lost_velocity);
        visitor.column(name + "/own_rates", s.grips[g].own_rates);
      }
    s.clumps.visit_state(visitor);
    visit_kicks(visitor, s.kicks);
    s.visit_glide(visitor);
    s.surfaces.visit_state(visitor);
    base::Column kinetic(s.accounts.size());
    for (std::size_t b = 0; b < kinetic.size(); ++b)
      kinetic[b] = s.accounts[b].kinetic;
    visitor.column("energy/kinetic", kinetic);
    for (std::size_t b = 0; b < s.accounts.size(); ++b)
      s.accounts[b].kinetic = kinetic.at(b);
  }
} // namespace dem
