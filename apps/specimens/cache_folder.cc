#include "apps/specimens/cache_folder.h"

#include "base/errors.h"
#include "postprocess/files/digest.h"
#include "postprocess/files/errors.h"

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

    bool without_cache = false;

    /** An absolute path that a variable of the environment holds; others are to be passed over, by the XDG rules for base folders. */
    fs::path folder_in(const char *variable)
    {
      const char *const value = std::getenv(variable);
      const fs::path    path  = value ? value : "";
      return path.is_absolute() ? path : fs::path();
    }
  } // namespace

  CacheFolder::CacheFolder(fs::path where, const std::uintmax_t bytes)
    : folder(std::move(where))
    , most_bytes(bytes)
  {
  }

  fs::path CacheFolder::file_of(const std::string &key, const std::string &kind) const
  {
    return folder / fmt::format("{:016x}.{}.h5", postprocess::Digest().add(key).value(), kind);
  }

  bool CacheFolder::find(const std::string                                               &key,
                         const std::string                                               &kind,
                         const std::function<bool(const postprocess::hdf5::InputFile &)> &take) const
  {
    const fs::path  path = file_of(key, kind);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
      return false;
    try
      {
        const postprocess::hdf5::InputFile file(path);
        if (file.read_text("key") != key || !take(file))
          return false;
        fs::last_write_time(path, fs::file_time_type::clock::now(), ignored); // used today
        return true;
      }
    catch (const base::InputError &) // damaged
      {
        return false;
      }
  }

  void CacheFolder::keep(const std::string                                          &key,
                         const std::string                                          &kind,
                         const std::function<void(postprocess::hdf5::OutputFile &)> &fill) const
  {
    try
      {
        fs::create_directories(folder);
        const fs::path path = file_of(key, kind);
        fs::path       own  = path; // several programs may make the same at once
        own += fmt::format(".{}", ::getpid());
        postprocess::hdf5::OutputFile file(own);
        file.write_text("key", key);
        fill(file);
        file.commit();
        fs::rename(own, path);
        drop_oldest();
      }
    catch (const postprocess::OutputError &)
      {
      }
    catch (const fs::filesystem_error &)
      {
      }
  }

  void CacheFolder::drop_oldest() const
  {
    struct Kept
    {
      fs::file_time_type last_used;
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
    std::sort(all.begin(), all.end(), [](const Kept &a, const Kept &b) { return a.last_used < b.last_used; });
    std::error_code ignored; // another program may have dropped it
    for (auto oldest = all.begin(); bytes > most_bytes && oldest != all.end(); ++oldest)
      {
        fs::remove(oldest->path, ignored);
        bytes -= oldest->bytes;
      }
  }

  std::optional<CacheFolder> packing_cache_folder()
  {
    if (without_cache)
      return std::nullopt;
    if (const fs::path caches = folder_in("XDG_CACHE_HOME"); !caches.empty())
      return CacheFolder(caches / "breccia" / "packings");
    if (const fs::path home = folder_in("HOME"); !home.empty())
      return CacheFolder(home / ".cache" / "breccia" / "packings");
    return std::nullopt;
  }

  void do_without_packing_cache() { without_cache = true; }
} // namespace apps
