#include "dem/genesis/growing_assembly.h"

#include "dem/core/memory_pages.h"
#include "dem/model/materials.h"
#include "dem/specimen/shared_work.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    /** Part of the stable step that a step is. */
    constexpr double step_factor = 0.8;
    /** How far beyond the particles' radii walls are sought, in mean radii. */
    constexpr double wall_skin = 0.25;

    Physics physics_of(const Vessel &vessel)
    {
      Physics physics;
      physics.dimension = vessel.dimension;
      physics.damage    = false;
      return physics;
    }

    std::shared_ptr<const LinkLaw> law_of(const Vessel &vessel, const GrowthMaterial &material)
    {
      return LinkMaterials(material.contact).contacts(physics_of(vessel));
    }
  } // namespace

  GrowingAssembly::GrowingAssembly(const Packing &start, const Vessel &walls, const GrowthMaterial &of)
    : vessel(walls)
    , material(of)
    , shape{walls.dimension, 1.0, of.thickness, {}}
    , particles(make_particles(start, shape, true))
    , constants(of.contact)
    , law(law_of(walls, of))
    , pass(law->pass(Mixture::radii))
    , search(particles, 0.0, true)
    , slot(particles.count)
    , accounts(particle_blocks(particles.count))
  {
    for (std::size_t i = 0; i < particles.count; ++i)
      slot[static_cast<std::size_t>(particles.number[i])] = static_cast<std::int32_t>(i);
    assign_zeros(particles.pushed, record_size * particles.count);
    make_links(none, {}, particles, shape, *law);
    add_contacts(contacts, {}, particles, shape, *law);
    fit_to_radii();
    growth = measure().stored; // of what overlaps from the start
  }

  void GrowingAssembly::set_friction(const double coefficient)
  {
    find_forces(); // with the friction of before
    take_friction(coefficient);
  }

  void GrowingAssembly::take_friction(const double coefficient)
  {
    material.contact.friction_coefficient = coefficient;
    constants                             = LinearContactConstants(material.contact);
    law                                   = law_of(vessel, material);
  }

  double GrowingAssembly::wall_stiffness(const double radius) const
  {
    return shape.link_area(radius, radius) * constants.normal / radius;
  }

  /**
   * Discs that cover one all around have normal stiffnesses of together at most 2 pi t E*, spheres 0.907 * 8 pi r E*; each counts with
   * max(1, (1 + m r^2/I)/kappa) (doc/theory/integration.md, 3). A tenth more for overlaps.
   */
  void GrowingAssembly::set_masses()
  {
    const bool   planar = vessel.dimension == 2;
    const double lever  = planar ? 2.0 : 2.5;
    const double factor =
      1.1 * std::max(1.0, (1 + lever) * constants.shear / constants.normal) / (2 * step_factor * step_factor);
    constexpr double coverage = 0.9069; // of a plane by equal discs
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        const double r       = particles.radius_of(i);
        particles.mass[i]    = factor * 2 * M_PI * constants.normal * (planar ? material.thickness : 4 * coverage * r);
        particles.inertia[i] = particles.mass[i] * r * r / lever;
        double *inverse      = &particles.inverse_mass[record_size * i];
        for (int c = 0; c < 3; ++c)
          {
            inverse[c]     = !planar || c < 2 ? 1 / particles.mass[i] : 0.0;
            inverse[3 + c] = !planar || c == 2 ? 1 / particles.inertia[i] : 0.0;
          }
      }
  }

  void GrowingAssembly::fit_to_radii()
  {
    ++fits;
    set_masses();
    for (std::size_t i = 0; i < particles.count; ++i)
      std::copy_n(particles.pose_of(i), 3, &particles.reference[3 * i]);
    search = ContactSearch(particles, 0.0, true);
    look_for_contacts();
    fit_contacts();
    look_for_walls();
  }

  void GrowingAssembly::fit_contact(const std::size_t l)
  {
    const double one   = particles.radius_of(static_cast<std::size_t>(contacts.first[l])),
                 other = particles.radius_of(static_cast<std::size_t>(contacts.second[l]));
    for (base::Column &of : contacts.history)
      of[l] *= contacts.reference_length[l] / (one + other); // the same displacement
    contacts.reference_length[l] = one + other;
    contacts.area[l]             = shape.link_area(one, other);
  }

  void GrowingAssembly::fit_contacts()
  {
    const std::vector<LinkPart> all   = {{0, contacts.count, 0, true}};
    const std::vector<LinkPart> parts = lacks_contacts() ? contacts.parts : all;
    for (const LinkPart &part : parts)
      for (std::size_t l = part.begin; l < std::min(part.end, contacts.count); ++l)
        if (contacts.is_alive(l))
          fit_contact(l);
  }

  void GrowingAssembly::look_for_contacts()
  {
    gather_places();
    const auto searches = search.searches();
    const auto born     = search.find_contacts(particles, none, contacts, shared ? shared->search() : SharedSearch());
    if (search.searches() != searches)
      for (std::size_t l = 0; l < contacts.count; ++l)
        if (contacts.is_alive(l) && !search.is_near(particles, {contacts.first[l], contacts.second[l], 0}))
          contacts.remove(l);
    if (born.empty())
      return;
    if (shared)
      shared->gather_contacts(contacts);
    add_contacts(contacts, born, particles, shape, *law);
  }

  void GrowingAssembly::look_for_walls()
  {
    gather_places();
    double mean = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      mean += particles.radius_of(i) / static_cast<double>(particles.count);
    wall_margin = wall_skin * mean;
    wall_path   = 0;
    for (const std::int32_t i : near_wall)
      std::fill_n(&particles.pushed[record_size * static_cast<std::size_t>(i)], record_size, 0.0);
    near_wall.clear();
    for (std::size_t i = 0; i < particles.count; ++i)
      if (vessel.near(particles.position_of(i), particles.radius_of(i), wall_margin).count > 0)
        near_wall.push_back(static_cast<std::int32_t>(i));
  }

  void GrowingAssembly::push_from_walls()
  {
    const auto count = static_cast<std::ptrdiff_t>(near_wall.size());
    for (std::ptrdiff_t k = 0; k < count; ++k)
      {
        const auto i = static_cast<std::size_t>(near_wall[static_cast<std::size_t>(k)]);
        if (!moves(near_wall[static_cast<std::size_t>(k)]))
          continue;
        const double r    = particles.radius_of(i);
        Vector3d     push = Vector3d::Zero();
        for (const WallTouch &wall : vessel.near(particles.position_of(i), r, 0.0))
          push -= wall_stiffness(r) * wall.gap * wall.inward;
        std::copy_n(push.data(), 3, &particles.pushed[record_size * i]);
      }
  }

  void GrowingAssembly::find_forces()
  {
    if (forces_known)
      return;
    share_out();
    if (contacts.count > 0)
      pass(contacts, particles, *law, contacts.whole());
    if (shared)
      shared->links_updated(particles, none, contacts);
    push_from_walls();
    forces_known = true;
  }

  void GrowingAssembly::advance(const std::int64_t steps)
  {
    const StepHalves halves{0.5, 0.5};
    const auto       move = select_particle_pass(true, material.damping > 0, false, false, Surroundings::pushed);
    for (std::int64_t s = 0; s < steps; ++s)
      {
        share_out_anew();
        find_forces();
        move(particles, none, &contacts, {}, halves, material.damping, Vector3d::Zero(), own_blocks(), accounts);
        if (shared)
          shared->share_motion(particles, accounts, {}, {});
        forces_known   = false;
        double fastest = 0;
        for (const auto &block : accounts)
          {
            damped -= block.damping_before + block.damping_after;
            fastest = std::max(fastest, block.fastest);
          }
        ++step_count;
        fastest = std::sqrt(fastest);
        if (search.moved(fastest, 0))
          look_for_contacts();
        wall_path += fastest;
        if (wall_path >= wall_margin)
          look_for_walls();
      }
  }
} // namespace dem
