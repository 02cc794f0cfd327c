#include "postprocess/files/companions.h"

#include "base/errors.h"
#include "postprocess/files/digest.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

namespace postprocess
{
  namespace fs = std::filesystem;

  namespace
  {
    struct Companion
    {
      std::uintmax_t size    = 0;
      std::int64_t   changed = 0; ///< ticks of the file system's clock
      std::uint64_t  print   = 0;
    };
    using Companions = std::map<std::string, Companion>; ///< by name within the checkpoint's folder

    /** Lists of snapshots (.pvd) are left out: they are written anew as snapshots are added. */
    bool counts(const fs::path &file, const fs::path &checkpoint)
    {
      constexpr std::array<const char *, 5> kinds = {".csv", ".h5", ".vtp", ".vtu", ".pvtu"};
      return file != checkpoint && std::find(kinds.begin(), kinds.end(), file.extension()) != kinds.end();
    }

    /** Of the first bytes; nothing past the end. @return how many there were */
    std::uintmax_t read_print(const fs::path &file, const std::uintmax_t bytes, std::uint64_t &print)
    {
      std::ifstream     stream(file, std::ios::binary);
      Digest            digest;
      std::vector<char> buffer(1 << 16);
      std::uintmax_t    done = 0;
      while (stream && done < bytes)
        {
          stream.read(buffer.data(),
                      static_cast<std::streamsize>(std::min<std::uintmax_t>(buffer.size(), bytes - done)));
          const auto got = static_cast<std::size_t>(stream.gcount());
          digest.add({buffer.data(), got});
          done += got;
        }
      print = digest.value();
      return done;
    }

    Companions parsed(const std::string &list)
    {
      Companions         companions;
      std::istringstream lines(list);
      for (std::string line; std::getline(lines, line);)
        {
          std::istringstream fields(line);
          Companion          one;
          std::string        name;
          if (fields >> one.size >> one.changed >> one.print >> std::ws && std::getline(fields, name))
            companions[name] = one;
        }
      return companions;
    }
  } // namespace

  std::string list_companions(const fs::path &checkpoint, const std::string &earlier)
  {
    const fs::path   folder = checkpoint.parent_path().empty() ? fs::path(".") : checkpoint.parent_path();
    const Companions known  = parsed(earlier);
    Companions       found;
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(folder))
      {
        if (!entry.is_regular_file() || !counts(entry.path(), checkpoint))
          continue;
        const std::string name = entry.path().lexically_relative(folder).string();
        Companion         one;
        one.size    = entry.file_size();
        one.changed = entry.last_write_time().time_since_epoch().count();
        if (const auto before = known.find(name);
            before != known.end() && before->second.size == one.size && before->second.changed == one.changed)
          one.print = before->second.print;
        else
          read_print(entry.path(), one.size, one.print);
        found[name] = one;
      }
    std::ostringstream list;
    for (const auto &[name, one] : found)
      list << one.size << ' ' << one.changed << ' ' << one.print << ' ' << name << '\n';
    return list.str();
  }

  void check_companions(const fs::path &checkpoint, const std::string &list)
  {
    const auto refuse = [&](const std::string &name, const std::string &what) {
      throw base::InputError(
        (checkpoint.parent_path() / name).string() + ": " + what +
        " since the checkpoint beside it was written, and the run cannot go on with it. Put the file "
        "back, or start the run afresh with --restart.");
    };
    for (const auto &[name, one] : parsed(list))
      {
        const fs::path file = checkpoint.parent_path() / name;
        if (!fs::is_regular_file(file))
          refuse(name, "has gone");
        std::uint64_t print = 0;
        if (read_print(file, one.size, print) < one.size)
          refuse(name, "has lost its end");
        if (print != one.print)
          refuse(name, "has changed");
      }
  }
} // namespace postprocess
