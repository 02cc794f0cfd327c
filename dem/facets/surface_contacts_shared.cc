// Contacts with surfaces of several ranks: who has them, and what all know of them (doc/theory/ranks.md, 3).

#include "dem/core/memory_pages.h"
#include "dem/facets/crossing.h"
#include "dem/facets/surface_contacts.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dem
{
  std::size_t SurfaceContacts::count() const
  {
    std::int64_t sum = 0;
    for (const Surface &surface : all)
      sum += surface.touching;
    return static_cast<std::size_t>(sum);
  }

  std::pair<SurfaceContacts::Known, SurfaceContacts::Known> SurfaceContacts::known_of(const std::int32_t first,
                                                                                      const std::int32_t last) const
  {
    const auto before = [](const SurfaceContact &contact, const std::int32_t i) { return contact.particle < i; };
    return {std::lower_bound(contacts.begin(), contacts.end(), first, before),
            std::lower_bound(contacts.begin(), contacts.end(), last, before)};
  }

  std::int64_t SurfaceContacts::count_of(const std::int32_t first, const std::int32_t last) const
  {
    const auto [begin, end] = known_of(first, last);
    return end - begin;
  }

  std::vector<std::int32_t> SurfaceContacts::standing_beside() const
  {
    return spread() ? beside.particles() : std::vector<std::int32_t>();
  }

  std::vector<RunningSum> SurfaceContacts::sums_of_contacts()
  {
    std::vector<RunningSum> sums = {{&slid, 1}, {&let_go, 1}, {&damped, 1}};
    for (Surface &surface : all)
      {
        for (Eigen::Vector3d *of : {&surface.total_force, &surface.total_moment})
          sums.push_back({of->data(), 3});
        sums.insert(sums.end(), {{&surface.along, 1}, {&surface.touching, 1}, {&surface.made, 1}});
        sums.push_back({surface.force.data(), 3 * surface.force.size()});
        sums.push_back({surface.stiffness.data(), surface.stiffness.size()});
      }
    return sums;
  }

  void SurfaceContacts::take(std::vector<SurfaceContact> &&now,
                             const Sunk                   &sunk,
                             const Particles              &particles,
                             const ParticleShape          &shape,
                             const SharedSurfaces         &with_others)
  {
    struct Census
    {
      std::int64_t contacts, adds, particle, surface;
    };
    const auto [old, old_end]    = known_of(with_others.first(), with_others.last());
    const auto                in = static_cast<std::int64_t>(now.size());
    const Census              own{in, in > 0 || old != old_end, sunk.particle, sunk.surface};
    const std::vector<Census> each  = with_others.alone() ? std::vector<Census>{own} : with_others.of_each(own);
    std::int64_t              total = 0, fresh = 0;
    adding.clear();
    for (std::size_t r = 0; r < each.size(); ++r)
      {
        if (each[r].particle >= 0)
          refuse_sunk(particles, static_cast<std::int32_t>(each[r].particle),
                      all[static_cast<std::size_t>(each[r].surface)]);
        total += each[r].contacts;
        if (each[r].adds != 0)
          adding.push_back(r);
      }
    if (total > 0 && records.empty())
      assign_zeros(records, record_size * particles.count);
    const auto add = [&, from = old, to = old_end] {
      settle(std::move(now), from, to, particles, shape);
      hand_out(particles, shape);
      fresh += static_cast<std::int64_t>(born.size());
    };
    lacking = !with_others.alone();
    if (!lacking)
      return add();
    if (own.adds == 0)
      contacts.clear();
    std::vector<RunningSum> sums = sums_of_contacts();
    sums.push_back({&fresh, 1});
    with_others.in_turn(sums, adding, add);
    if (fresh > 0)
      born = with_others.of_all(std::move(born));
  }

  void SurfaceContacts::gather(const SharedSurfaces &with_others)
  {
    if (!std::exchange(lacking, false))
      return;
    struct OnParticle
    {
      std::int64_t                    particle;
      std::array<double, record_size> record;
    };
    std::vector<OnParticle> touched;
    for (const SurfaceContact &contact : contacts)
      if (touched.empty() || touched.back().particle != contact.particle)
        {
          touched.push_back({contact.particle, {}});
          std::copy_n(&records[record_size * static_cast<std::size_t>(contact.particle)], record_size,
                      touched.back().record.data());
        }
    for (const OnParticle &one : with_others.of_all(std::move(touched)))
      std::copy_n(one.record.data(), record_size, &records[record_size * static_cast<std::size_t>(one.particle)]);

    std::int32_t                    before = 0;
    const std::vector<std::int64_t> parts  = with_others.of_each(static_cast<std::int64_t>(vertex_parts.size()));
    for (std::size_t r = 0; r < with_others.rank(); ++r)
      before += static_cast<std::int32_t>(parts[r]);
    for (SurfaceContact &contact : contacts)
      {
        contact.parts_begin += before;
        contact.parts_end += before;
      }
    contacts     = with_others.of_all(std::move(contacts));
    vertex_parts = with_others.of_all(std::move(vertex_parts));
  }
} // namespace dem
