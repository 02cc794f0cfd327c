// How ranks share the work of a growing assembly (doc/theory/ranks.md, 3).

#include "dem/genesis/growing_assembly.h"
#include "dem/specimen/shared_work.h"

#include <algorithm>
#include <utility>

namespace dem
{
  void GrowingAssembly::share_among(std::shared_ptr<Ranks> ranks, const std::int64_t move_every)
  {
    shared = std::make_unique<SharedWork>(std::move(ranks), move_every);
  }

  GrowingAssembly::~GrowingAssembly() = default;

  bool GrowingAssembly::lacks_contacts() const { return shared && shared->lacks_contacts(); }

  bool GrowingAssembly::lacks_motion() const { return shared && (shared->lacks_particles() || lacks_contacts()); }

  void GrowingAssembly::share_out()
  {
    if (shared)
      shared->plan(particles, none, contacts, search, {}, {}, {});
  }

  void GrowingAssembly::share_out_anew()
  {
    if (shared && shared->changes_ranges(step_count))
      {
        gather();
        shared->change_ranges(step_count, none, contacts);
      }
    share_out();
  }

  void GrowingAssembly::gather_places()
  {
    if (shared && shared->lacks_places())
      shared->gather_places(particles);
  }

  void GrowingAssembly::gather()
  {
    if (!lacks_motion())
      return;
    shared->gather_particles(particles);
    shared->gather_contacts(contacts);
    shared->gather_column(particles.pushed);
    shared->gather_search(search);
  }

  void GrowingAssembly::take_radii_of_poses()
  {
    if (!particles.radii.empty())
      particles.keep_radii();
  }

  std::pair<std::size_t, std::size_t> GrowingAssembly::known_contacts() const
  {
    if (!lacks_contacts())
      return {0, contacts.count};
    std::pair<std::size_t, std::size_t> own = {0, 0};
    for (const LinkPart &part : contacts.parts)
      if (part.own)
        own = {own.second > 0 ? own.first : part.begin, std::min(part.end, contacts.count)};
    return own;
  }

  std::pair<std::size_t, std::size_t> GrowingAssembly::known_particles() const
  {
    if (!lacks_motion())
      return {0, particles.count};
    return {static_cast<std::size_t>(shared->first()), static_cast<std::size_t>(shared->last())};
  }

  bool GrowingAssembly::moves(const std::int32_t particle) const { return !shared || shared->owns(particle); }

  ParticleBlocks GrowingAssembly::own_blocks() const
  {
    return shared ? shared->bricks() : ParticleBlocks{0, accounts.size()};
  }
} // namespace dem
