#include "apps/specimens/packing_cache.h"

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

    dem::CompactionResult result_in(const postprocess::hdf5::InputFile &file, const dem::CompactionParameters &p)
    {
      std::vector<double> centres(3 * p.count), cell(3), figures(4);
      std::int64_t        steps = 0;
      file.read("centre", centres.data());
      file.read("periodic_cell", cell.data());
      file.read("figures", figures.data());
      file.read("steps", &steps);
      dem::CompactionResult result{{},   Eigen::Vector3d(cell.data()), figures[0], figures[1], figures[2], figures[3],
                                   steps};
      for (std::size_t i = 0; i < p.count; ++i)
        result.packing.centre.emplace_back(&centres[3 * i]);
      result.packing.radius.assign(p.count, p.radius);
      if (!p.moulded)
        result.packing.periodic_cell = result.edges;
      return result;
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
      const double        figures[] = {result.packing_fraction, result.mean_overlap, result.unbalanced_ratio,
                                       result.coordination};
      std::vector<double> centres;
      for (const Eigen::Vector3d &x : result.packing.centre)
        centres.insert(centres.end(), x.data(), x.data() + 3);
      file.write("centre", centres.data(), {result.packing.size(), 3});
      file.write("periodic_cell", result.edges.data(), {3});
      file.write("figures", figures, {4});
      file.write("steps", &result.steps, {});
    });
  }

  std::optional<PackingCache> packing_cache()
  {
    auto folder = packing_cache_folder();
    return folder ? std::optional(PackingCache(std::move(*folder))) : std::nullopt;
  }
} // namespace apps
