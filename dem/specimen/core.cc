#include "dem/specimen/core.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/contacts/particle_pairs.h"
#include "dem/measures/bulk_volume.h"
#include "dem/measures/link_measures.h"
#include "dem/neighbours/tie.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace dem
{
  namespace
  {
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

    /** Their materials are noted only where links are of several pairs. */
    Particles make_particles_in_cell(const Packing            &packing,
                                     const ParticleShape      &shape,
                                     const SpecimenParameters &p,
                                     const LinkMaterials      &materials)
    {
      Particles particles   = make_particles(packing, shape, p.physics.rotations);
      particles.cell        = make_cell(packing, p);
      particles.cuts        = packing.cuts;
      particles.first_joint = materials.material_pairs();
      if (!materials.several())
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
        all += shape.volume(p.radius_of(i));
      if (p.cell.repeats())
        return p.cell.volume() / all;
      centre.reserve(p.count);
      for (std::vector<double> *of : {&radius, &solid})
        of->reserve(p.count);
      for (std::size_t i = 0; i < p.count; ++i)
        {
          if (p.made_links[i] == 0)
            continue;
          centre.push_back(p.position_of(i));
          radius.push_back(p.radius_of(i));
          solid.push_back(shape.volume(p.radius_of(i)));
        }
      return centre.empty() ? 1.0 : bulk_over_solid(centre, radius, solid, shape.dimension, shape.thickness);
    }
  } // namespace

  SpecimenCore::SpecimenCore(const Packing            &packing,
                             const SpecimenParameters &p,
                             const LinkMaterials      &materials,
                             Ranks *const              found_by)
    : parameters(p)
    , shape{p.physics.dimension, p.density, p.thickness, materials.densities(p.density)}
    , particles(make_particles_in_cell(packing, shape, p, materials))
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
    , stiffening(contact_law->stiffens() ? 1e-3 * smallest_radius : 0.0)
  {
    for (std::size_t i = 0; i < particles.count; ++i)
      slot[particles.number[i]] = static_cast<std::int32_t>(i);
    const SharedSearch with_others = search_by(found_by, particles.count);
    link(with_others);
    space_per_solid = volume_per_solid(particles, shape);
    longest_step = time_step = parameters.step_factor * (bond_law->bonds() ? stable() : step_of_lone_particles());
    if (!std::isfinite(time_step))
      throw base::InputError(
        "Interaction ratio = " + base::number_text(p.interaction_ratio) +
        ": no two particles are near enough to be linked, nothing holds the specimen together. Raise "
        "the ratio or check the packing.");
    book.rounding = made_links > 0 ? energy_of_strain(particles, bonds, *bond_law, strain_of_rounding) :
                                     energy_of_strained_packing(strain_of_rounding);
    if (parameters.physics.contacts)
      make_contacts(with_others); // of what overlaps from the start
  }

  std::size_t SpecimenCore::touching_contacts()
  {
    if (!contact_law->waits())
      return contacts.alive;
    double touching = 0;
    walk(contacts, &touching, 1, [&](const LinkRange &lines) {
      each_living(contacts, lines, [&](const std::size_t l) {
        touching += !Eigen::Map<const Eigen::Vector3d>(&contacts.force[record_size * l]).isZero(0);
      });
    });
    return static_cast<std::size_t>(touching);
  }

  DeepestOverlap SpecimenCore::deepest_overlap()
  {
    double     found[] = {0, 0, 0};
    const auto look    = [&](const LinkSet &links, const auto &find_deeper) {
      walk(links, found, std::size(found), [&](const LinkRange &lines) {
        DeepestOverlap deepest{found[0], static_cast<std::int32_t>(found[1]), static_cast<std::int32_t>(found[2])};
        find_deeper(particles, links, lines, deepest);
        std::copy_n(std::array<double, 3>{deepest.depth, double(deepest.first), double(deepest.second)}.data(), 3,
                       found);
      });
    };
    look(contacts, find_deeper_contact);
    if (bonds.logs_breaks)
      look(bonds, find_deeper_bond);
    return {found[0], static_cast<std::int32_t>(found[1]), static_cast<std::int32_t>(found[2])};
  }

  void SpecimenCore::leave_loose(std::vector<NeighbourPair> &pairs)
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

  void SpecimenCore::leave_unbonded(std::vector<NeighbourPair> &pairs)
  {
    if (unbonded.empty())
      return;
    const auto linked_end = std::remove_if(pairs.begin(), pairs.end(), [&](const NeighbourPair &pair) {
      const auto of_pair = static_cast<std::size_t>(particles.pair_of(pair.first, pair.second));
      return of_pair < unbonded.size() && unbonded[of_pair]; // joints link whatever they cut
    });
    if (linked_end == pairs.end())
      return;
    pairs.erase(linked_end, pairs.end());
    search = ContactSearch(particles, 0.0, contact_law->waits()); // they may touch from the start
  }

  void SpecimenCore::link(const SharedSearch &with_others)
  {
    std::vector<NeighbourPair> pairs;
    if (bond_law->bonds())
      {
        pairs = particle_pairs(particles, parameters.interaction_ratio, parameters.installation_gap, with_others.own());
        with_others.drop_others(pairs);
        pairs = with_others.of_all(std::move(pairs));
        leave_loose(pairs);
        leave_unbonded(pairs);
      }
    else
      search = ContactSearch(particles, 0.0, contact_law->waits()); // any two may be in contact from the start
    made_links = pairs.size();
    for (const auto &pair : pairs)
      {
        ++particles.made_links[pair.first];
        ++particles.made_links[pair.second];
      }
    make_links(bonds, std::move(pairs), particles, shape, *bond_law);
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
    add_contacts(contacts, {}, particles, shape, *contact_law);
    if (parameters.emission_reach > 0)
      emission =
        Emission(emission_window(parameters.emission_reach, parameters.physics.dimension, particles, bonds, *bond_law));
  }

  void SpecimenCore::remove_bonds(const std::vector<bool> &among)
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

  void SpecimenCore::remove_contacts_within_bodies()
  {
    for (std::size_t l = 0; l < contacts.count; ++l)
      if (contacts.is_alive(l) && particles.in_one_body(contacts.first[l], contacts.second[l]))
        contacts.remove(l);
  }

  double SpecimenCore::energy_of_strained_packing(const double strain) const
  {
    const double speed = 2 * smallest_radius * parameters.step_factor / longest_step;
    return 0.5 * std::accumulate(particles.mass.begin(), particles.mass.end(), 0.0) * speed * speed * strain * strain;
  }

  double SpecimenCore::kinetic_of_velocities() const
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

  void SpecimenCore::refuse_late(const char *what) const
  {
    if (step_count > 0)
      throw base::InputError(std::string(what) + ": only before the first step.");
    if (parameters.physics.periodic)
      throw base::InputError(std::string(what) + ": a periodic cell has no place for a partner's body.");
  }
} // namespace dem
