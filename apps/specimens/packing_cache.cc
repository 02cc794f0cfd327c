#include "apps/specimens/packing_cache.h"

#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "dem/ranks/from_one.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace apps
{
  namespace
  {
    constexpr const char *compacted = "packing"; ///< kind of file

    /** Everything that determines a packing, each number exactly. */
    std::string key_of(const dem::CompactionParameters &p)
    {
      return fmt::format("compaction {}\nradius {:a}\ncount {}\nseed {}\nproportions {:a} {:a} {:a}\nfriction {:a}\n"
                         "damping {:a}\nshear ratio {:a}\ninitial spacing {:a}\nhigh pressure {:a}\nlow pressure {:a}\n"
                         "time step factor {:a}\nstep limit {}\n{}",
                         dem::compaction_version, p.radius, p.count, p.seed, p.proportions.x(), p.proportions.y(),
                         p.proportions.z(), p.friction, p.damping, p.shear_ratio, p.initial_spacing, p.high_pressure,
                         p.low_pressure, p.time_step_factor, p.step_limit, p.moulded ? "moulded\n" : "");
    }

    /** A packing as it is kept: what its parameters do not say. */
    struct Kept
    {
      std::vector<double> centres, cell, figures;
      std::int64_t        steps = 0;

      explicit Kept(const dem::CompactionParameters &p)
        : centres(3 * p.count)
        , cell(3)
        , figures(4)
      {
      }
      explicit Kept(const dem::CompactionResult &result)
        : cell(result.edges.data(), result.edges.data() + 3)
        , figures{result.packing_fraction, result.mean_overlap, result.unbalanced_ratio, result.coordination}
        , steps(result.steps)
      {
        for (const Eigen::Vector3d &x : result.packing.centre)
          centres.insert(centres.end(), x.data(), x.data() + 3);
      }

      dem::CompactionResult result(const dem::CompactionParameters &p) const
      {
        dem::CompactionResult made{{},   Eigen::Vector3d(cell.data()), figures[0], figures[1], figures[2], figures[3],
                                   steps};
        for (std::size_t i = 0; i < p.count; ++i)
          made.packing.centre.emplace_back(&centres[3 * i]);
        made.packing.radius.assign(p.count, p.radius);
        if (!p.moulded)
          made.packing.periodic_cell = made.edges;
        return made;
      }
    };

    dem::CompactionResult result_in(const postprocess::hdf5::InputFile &file, const dem::CompactionParameters &p)
    {
      Kept kept(p);
      file.read("centre", kept.centres.data());
      file.read("periodic_cell", kept.cell.data());
      file.read("figures", kept.figures.data());
      file.read("steps", &kept.steps);
      return kept.result(p);
    }
  } // namespace

  PackingCache::PackingCache(CacheFolder where)
    : folder(std::move(where))
  {
  }

  std::filesystem::path PackingCache::file_of(const dem::CompactionParameters &parameters) const
  {
    return folder.file_of(key_of(parameters), compacted);
  }

  std::optional<dem::CompactionResult> PackingCache::find(const dem::CompactionParameters &parameters) const
  {
    using postprocess::hdf5::Shape;
    std::optional<dem::CompactionResult> found;
    folder.find(key_of(parameters), compacted, [&](const postprocess::hdf5::InputFile &file) {
      if (file.shape("centre") != Shape{parameters.count, 3} || file.shape("periodic_cell") != Shape{3} ||
          file.shape("figures") != Shape{4} || !file.shape("steps").empty())
        return false;
      found = result_in(file, parameters);
      return true;
    });
    return found;
  }

  void PackingCache::keep(const dem::CompactionParameters &parameters, const dem::CompactionResult &result) const
  {
    folder.keep(key_of(parameters), compacted, [&](postprocess::hdf5::OutputFile &file) {
      const Kept kept(result);
      file.write("centre", kept.centres.data(), {result.packing.size(), 3});
      file.write("periodic_cell", kept.cell.data(), {3});
      file.write("figures", kept.figures.data(), {4});
      file.write("steps", &kept.steps, {});
    });
  }

  std::optional<PackingCache> packing_cache()
  {
    auto folder = packing_cache_folder();
    return folder ? std::optional(PackingCache(std::move(*folder))) : std::nullopt;
  }

  std::optional<dem::CompactionResult> find_on_first_rank(const std::optional<PackingCache> &cache,
                                                          const dem::CompactionParameters   &parameters)
  {
    std::optional<dem::CompactionResult> found;
    if (cache && is_first_rank())
      found = cache->find(parameters);
    const std::shared_ptr<dem::Ranks> ranks = launched_team();
    if (!ranks || !on_any_rank(found.has_value()))
      return found;
    Kept kept = found ? Kept(*found) : Kept(parameters);
    dem::take_from_first(*ranks, kept.centres.data(), kept.centres.size());
    dem::take_from_first(*ranks, kept.cell.data(), kept.cell.size());
    dem::take_from_first(*ranks, kept.figures.data(), kept.figures.size());
    dem::take_from_first(*ranks, &kept.steps, 1);
    return kept.result(parameters);
  }
} // namespace apps
