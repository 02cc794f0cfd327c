#include "apps/specimens/genesis_cache.h"

#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "base/flat_state.h"
#include "dem/ranks/from_one.h"
#include "postprocess/files/digest.h"

#include <fmt/format.h>

#include <utility>

namespace apps
{
  namespace
  {
    constexpr const char *grown = "genesis"; ///< kind of file

    /** Everything that determines a grown packing, each number exactly. */
    std::string key_of(const dem::GenesisParameters &p)
    {
      const dem::LinearContactParameters &contact = p.material.contact;
      postprocess::Digest                 radii;
      for (const double radius : p.radii)
        radii.add(fmt::format("{:a} ", radius));
      std::string key =
        fmt::format("genesis {}\nvessel {} {} {:a} {:a} {:a}\nradii {} {:016x}\nseed {}\n", dem::genesis_version,
                    p.vessel.dimension, static_cast<int>(p.vessel.shape), p.vessel.size.x(), p.vessel.size.y(),
                    p.vessel.size.z(), p.radii.size(), radii.value(), p.seed);
      key += fmt::format("contact {:a} {:a} {:a} {} {:a}\ndamping {:a}\nthickness {:a}\n", contact.effective_modulus,
                         contact.stiffness_ratio, contact.friction_coefficient, static_cast<int>(contact.normal_force),
                         contact.restitution, p.material.damping, p.material.thickness);
      key += fmt::format("growth {:a} {} {:a} {}\nsolution {:a} {}\nstress {:a} {:a} {}\n", p.growth_friction,
                         p.increments, p.increment_ratio, p.increment_steps, p.ratio, p.solve_steps, p.stress,
                         p.stress_tolerance, p.stress_rounds);
      return key + fmt::format("floaters {} {} {:a} {}\n", p.fit_floaters, p.floater_contacts, p.floaters_allowed,
                               p.floater_rounds);
    }

    std::optional<base::Column> state_in(const postprocess::hdf5::InputFile &file)
    {
      const postprocess::hdf5::Shape shape = file.shape("state");
      if (shape.size() != 1)
        return std::nullopt;
      std::vector<double> numbers(shape.front());
      file.read("state", numbers.data());
      return base::Column(numbers.begin(), numbers.end());
    }
  } // namespace

  GenesisCache::GenesisCache(CacheFolder where)
    : folder(std::move(where))
  {
  }

  std::filesystem::path GenesisCache::file_of(const dem::GenesisParameters &parameters) const
  {
    return folder.file_of(key_of(parameters), grown);
  }

  std::optional<base::Column> GenesisCache::find(const dem::GenesisParameters &parameters) const
  {
    std::optional<base::Column> state;
    folder.find(key_of(parameters), grown, [&](const postprocess::hdf5::InputFile &file) {
      state = state_in(file);
      return state.has_value();
    });
    return state;
  }

  bool GenesisCache::has(const dem::GenesisParameters &parameters) const { return find(parameters).has_value(); }

  void GenesisCache::keep(dem::Genesis &genesis, const dem::GenesisParameters &parameters) const
  {
    base::Column          state;
    base::FlatStateWriter writer(state);
    genesis.visit_state(writer);
    folder.keep(key_of(parameters), grown,
                [&](postprocess::hdf5::OutputFile &file) { file.write("state", state.data(), {state.size()}); });
  }

  std::optional<GenesisCache> genesis_cache()
  {
    auto folder = packing_cache_folder();
    return folder ? std::optional(GenesisCache(std::move(*folder))) : std::nullopt;
  }

  bool finish_as_kept(const std::optional<GenesisCache> &cache,
                      dem::Genesis                      &genesis,
                      const dem::GenesisParameters      &parameters)
  {
    std::optional<base::Column> state;
    if (cache && is_first_rank())
      state = cache->find(parameters);
    if (!on_any_rank(state.has_value()))
      return false;
    if (const std::shared_ptr<dem::Ranks> ranks = launched_team())
      {
        std::int64_t count = state ? static_cast<std::int64_t>(state->size()) : 0;
        dem::take_from_first(*ranks, &count, 1);
        if (!state)
          state.emplace(static_cast<std::size_t>(count));
        dem::take_from_first(*ranks, state->data(), state->size());
      }
    base::FlatStateReader reader(*state);
    genesis.visit_state(reader);
    return true;
  }
} // namespace apps
