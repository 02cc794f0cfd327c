#include "postprocess/hdf5/checkpoint.h"

#include "base/errors.h"
#include "postprocess/files/companions.h"
#include "postprocess/files/digest.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/hdf5/hdf5_file.h"

#include <set>

namespace postprocess
{
  namespace
  {
    constexpr const char  *checkpoint_format  = "breccia checkpoint";
    constexpr std::int64_t checkpoint_version = 1;
    constexpr const char  *remedy             = " Start the run afresh with --restart.";

    /** The first line in which two texts differ, for a message. */
    std::string first_difference(const std::string &stored, const std::string &present)
    {
      numeric_text::Lines a(stored), b(present);
      while (true)
        {
          const bool more_a = a.next(), more_b = b.next();
          if (more_a && more_b && a.text() == b.text())
            continue;
          const auto quoted = [](const bool more, const numeric_text::Lines &lines) {
            return more ? "\"" + std::string(numeric_text::trimmed(lines.text())) + "\"" : std::string("nothing");
          };
          return "then " + quoted(more_a, a) + ", now " + quoted(more_b, b);
        }
    }
    /** Of one item, to which its bytes are to be added; the values of all items are added up, so that their order does not matter. */
    Digest digest_of(const std::string &name) { return Digest().add(name).add("="); }

    std::uint64_t fingerprint_of(const std::string &name, const std::string_view bytes)
    {
      return digest_of(name).add(bytes).value();
    }

    /** As stored: numbers of eight or four bytes, the least significant first. */
    template <typename Value>
    std::string_view bytes_of(const Value *values, const std::size_t count)
    {
      return {reinterpret_cast<const char *>(values), count * sizeof(Value)};
    }

    /** The list of the checkpoint that is about to be replaced; "" if it has none that can be read. */
    std::string companions_in(const std::filesystem::path &path)
    {
      try
        {
          return std::filesystem::exists(path) ? hdf5::InputFile(path).read_text("companions") : "";
        }
      catch (const base::InputError &)
        {
          return "";
        }
    }
  } // namespace

  // --- Writing ---

  struct CheckpointWriter::Implementation
  {
    explicit Implementation(const std::filesystem::path &path_)
      : path(path_)
      , file(path_)
    {
    }

    template <typename Value>
    void write(const std::string &name, const Value *values, const std::size_t count, const hdf5::Shape &shape)
    {
      file.write(prefix + name, values, shape);
      fingerprint += fingerprint_of(prefix + name, bytes_of(values, count));
    }

    std::filesystem::path path;
    hdf5::OutputFile      file;
    std::string           prefix      = "state/";
    std::uint64_t         fingerprint = 0;
  };

  CheckpointWriter::CheckpointWriter(const std::filesystem::path &path, const std::string &scene)
    : self(std::make_unique<Implementation>(path))
  {
    self->file.write_text("format", checkpoint_format);
    self->file.write("format_version", &checkpoint_version, {});
    self->file.write_text("scene", scene);
  }

  CheckpointWriter::~CheckpointWriter() = default;

  void CheckpointWriter::group(const std::string &name) { self->prefix = "state/" + name + "/"; }

  void CheckpointWriter::column(const std::string &name, base::Column &values)
  {
    self->write(name, values.data(), values.size(), {values.size()});
  }

  void CheckpointWriter::column(const std::string &name, std::vector<std::int32_t> &values)
  {
    self->write(name, values.data(), values.size(), {values.size()});
  }

  void CheckpointWriter::column_in_parts(const std::string &name, const std::size_t count, const Tell &tell)
  {
    Digest digest = digest_of(self->prefix + name);
    self->file.write_in_parts(self->prefix + name, count, [&](const Take &take) {
      tell([&](const double *const numbers, const std::size_t more) {
        take(numbers, more);
        digest.add(bytes_of(numbers, more));
      });
    });
    self->fingerprint += digest.value();
  }

  void CheckpointWriter::scalar(const std::string &name, double &value) { self->write(name, &value, 1, {}); }

  void CheckpointWriter::scalar(const std::string &name, std::int64_t &value) { self->write(name, &value, 1, {}); }

  void CheckpointWriter::commit()
  {
    const auto fingerprint = static_cast<std::int64_t>(self->fingerprint);
    self->file.write("fingerprint", &fingerprint, {});
    self->file.write_text("companions", list_companions(self->path, companions_in(self->path)));
    self->file.commit();
  }

  void CheckpointWriter::text(const std::string &name, const std::string &value) { self->file.write_text(name, value); }

  // --- Reading ---

  struct CheckpointReader::Implementation
  {
    explicit Implementation(const std::filesystem::path &path_)
      : path(path_.string())
      , file(path_)
    {
    }

    [[noreturn]] void refuse(const std::string &what) const { throw base::InputError(path + ": " + what + remedy); }

    void check_format() const
    {
      std::int64_t version = 0;
      if (!file.has("format") || file.read_text("format") != checkpoint_format)
        throw base::InputError(path + ": is not a checkpoint.");
      file.read("format_version", &version);
      if (version != checkpoint_version)
        refuse("checkpoint format " + std::to_string(version) + ", this program reads format " +
               std::to_string(checkpoint_version) + ".");
    }

    void check_scene(const std::string &scene) const
    {
      if (const std::string stored = file.read_text("scene"); stored != scene)
        refuse("was made by another scene: " + first_difference(stored, scene) + ".");
    }

    /** Before anything is used: damaged numbers could send the program anywhere. */
    void check_content() const
    {
      if (!file.has("fingerprint"))
        refuse("has no fingerprint of its content: it was made by another version.");
      std::uint64_t found = 0;
      for (const std::string &name : file.names("state"))
        {
          Digest digest = digest_of(name);
          file.read_bytes(name, [&](const std::string_view part) { digest.add(part); });
          found += digest.value();
        }
      std::int64_t expected = 0;
      file.read("fingerprint", &expected);
      if (found != static_cast<std::uint64_t>(expected))
        refuse("is damaged: its content is not what was written.");
    }

    template <typename Value>
    void read_scalar(const std::string &name, Value &value)
    {
      if (!file.shape(prefix + name).empty())
        refuse("\"" + prefix + name + "\" is a column, one number expected.");
      file.read(prefix + name, &value);
      visited.insert(prefix + name);
    }

    std::size_t length_of_column(const std::string &name)
    {
      const hdf5::Shape shape = file.shape(prefix + name);
      if (shape.size() != 1)
        refuse("\"" + prefix + name + "\" is one number, a column expected.");
      visited.insert(prefix + name);
      return shape[0];
    }

    template <typename Column>
    void read_column(const std::string &name, Column &values)
    {
      values.resize(length_of_column(name));
      file.read(prefix + name, values.data());
    }

    std::string           path;
    hdf5::InputFile       file;
    std::string           prefix = "state/";
    std::set<std::string> visited;
  };

  CheckpointReader::CheckpointReader(const std::filesystem::path &path, const std::string &scene)
    : self(std::make_unique<Implementation>(path))
  {
    self->check_format();
    self->check_scene(scene);
    self->check_content();
    check_companions(path, self->file.read_text("companions"));
  }

  CheckpointReader::~CheckpointReader() = default;

  void CheckpointReader::group(const std::string &name) { self->prefix = "state/" + name + "/"; }

  void CheckpointReader::column(const std::string &name, base::Column &values) { self->read_column(name, values); }

  void CheckpointReader::column(const std::string &name, std::vector<std::int32_t> &values)
  {
    self->read_column(name, values);
  }

  void CheckpointReader::read_in_parts(const std::string &name, const Take &take)
  {
    self->length_of_column(name);
    self->file.read_in_parts(self->prefix + name, take);
  }

  void CheckpointReader::scalar(const std::string &name, double &value) { self->read_scalar(name, value); }

  void CheckpointReader::scalar(const std::string &name, std::int64_t &value) { self->read_scalar(name, value); }

  std::string CheckpointReader::text(const std::string &name) const { return self->file.read_text(name); }

  void CheckpointReader::finish() const
  {
    for (const std::string &name : self->file.names("state"))
      if (self->visited.count(name) == 0)
        self->refuse("holds \"" + name + "\", which this program does not know: it was made by another version.");
  }

  std::string text_of_checkpoint(const std::filesystem::path &path, const std::string &name)
  {
    try
      {
        const hdf5::InputFile file(path.string());
        return file.has(name) ? file.read_text(name) : "";
      }
    catch (const base::InputError &) // whoever reads its state says what is wrong with it
      {
        return "";
      }
  }
} // namespace postprocess
