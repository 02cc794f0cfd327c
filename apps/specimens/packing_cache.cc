#include "apps/specimens/packing_cache.h"

#include "base/errors.h"
#include "postprocess/files/digest.h"
#include "postprocess/files/errors.h"
#include "postprocess/hdf5/hdf5_file.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <vector>

namespace apps
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr const char *extension = ".packing.h5";

    bool without_cache = false;

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

    /** An absolute path that a variable of the environment holds; others are to be passed over, by the XDG rules for base folders. */
    fs::path folder_in(const char *variable)
    {
      const char *const value = std::getenv(variable);
      const fs::path    path  = value ? value : "";
      return path.is_absolute() ? path : fs::path();
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

  PackingCache::PackingCache(fs::path where, const std::uintmax_t bytes)
    : folder(std::move(where))
    , most_bytes(bytes)
  {
  }

  fs::path PackingCache::file_of(const dem::CompactionParameters &parameters) const
  {
    return folder / fmt::format("{:016x}{}", postprocess::Digest().add(key_of(parameters)).value(), extension);
  }

  std::optional<dem::CompactionResult> PackingCache::find(const dem::CompactionParameters &parameters) const
  {
    const fs::path  path = file_of(parameters);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
      return std::nullopt;
    try
      {
        const postprocess::hdf5::InputFile file(path);
        if (file.read_text("key") != key_of(parameters) ||
            file.shape("centre") != postprocess::hdf5::Shape{parameters.count, 3} ||
            file.shape("periodic_cell") != postprocess::hdf5::Shape{3} ||
            file.shape("figures") != postprocess::hdf5::Shape{4} || !file.shape("steps").empty())
          return std::nullopt;
        dem::CompactionResult result = result_in(file, parameters);
        fs::last_write_time(path, fs::file_time_type::clock::now(), ignored); // used today
        return result;
      }
    catch (const base::InputError &) // damaged
      {
        return std::nullopt;
      }
  }

  void PackingCache::keep(const dem::CompactionParameters &parameters, const dem::CompactionResult &result) const
  {
    try
      {
        write(parameters, result);
        drop_oldest();
      }
    catch (const postprocess::OutputError &)
      {
      }
    catch (const fs::filesystem_error &)
      {
      }
  }

  void PackingCache::write(const dem::CompactionParameters &parameters, const dem::CompactionResult &result) const
  {
    fs::create_directories(folder);
    const fs::path path = file_of(parameters);
    fs::path       own  = path; // several programs may make the same packing at once
    own += fmt::format(".{}", ::getpid());
    const double        figures[] = {result.packing_fraction, result.mean_overlap, result.unbalanced_ratio,
                                     result.coordination};
    std::vector<double> centres;
    for (const Eigen::Vector3d &x : result.packing.centre)
      centres.insert(centres.end(), x.data(), x.data() + 3);
    postprocess::hdf5::OutputFile file(own);
    file.write_text("key", key_of(parameters));
    file.write("centre", centres.data(), {result.packing.size(), 3});
    file.write("periodic_cell", result.edges.data(), {3});
    file.write("figures", figures, {4});
    file.write("steps", &result.steps, {});
    file.commit();
    fs::rename(own, path);
  }

  void PackingCache::drop_oldest() const
  {
    struct Kept
    {
      fs::file_time_type asked_for;
      std::uintmax_t     bytes;
      fs::path           path;
    };
    std::vector<Kept> all;
    std::uintmax_t    bytes = 0;
    for (const fs::directory_entry &entry : fs::directory_iterator(folder))
      if (entry.is_regular_file())
        {
          all.push_back({entry.last_write_time(), entry.file_size(), entry.path()});
          bytes += all.back().bytes;
        }
    std::sort(all.begin(), all.end(), [](const Kept &a, const Kept &b) { return a.asked_for < b.asked_for; });
    std::error_code ignored; // another program may have dropped it
    for (auto oldest = all.begin(); bytes > most_bytes && oldest != all.end(); ++oldest)
      {
        fs::remove(oldest->path, ignored);
        bytes -= oldest->bytes;
      }
  }

  std::optional<PackingCache> packing_cache()
  {
    if (without_cache)
      return std::nullopt;
    if (const fs::path caches = folder_in("XDG_CACHE_HOME"); !caches.empty())
      return PackingCache(caches / "breccia" / "packings");
    if (const fs::path home = folder_in("HOME"); !home.empty())
      return PackingCache(home / ".cache" / "breccia" / "packings");
    return std::nullopt;
  }

  void do_without_packing_cache() { without_cache = true; }
} // namespace apps
