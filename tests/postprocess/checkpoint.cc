#include "postprocess/hdf5/checkpoint.h"

#include "base/errors.h"
#include "full_disk.h"
#include "postprocess/files/errors.h"
#include "postprocess/hdf5/hdf5_file.h"
#include "postprocess/vtk/pvd.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace postprocess;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using postprocess_tests::content_of;
using postprocess_tests::files_in;
using postprocess_tests::FullDisk;
using postprocess_tests::ScratchFolder;

namespace
{
  const std::string scene = "set Damping = 0.3\nset Seed = 1\n";

  /** A state with every kind of item, and numbers that a careless writer would change. */
  struct State
  {
    base::Column              column;
    std::vector<std::int32_t> numbers;
    base::Column              none;
    double                    time  = 0;
    std::int64_t              steps = 0;

    void visit_state(base::StateVisitor &visitor)
    {
      visitor.column("column", column);
      visitor.column("numbers", numbers);
      visitor.column("none", none);
      visitor.scalar("time", time);
      visitor.scalar("steps", steps);
    }
  };

  State sample_state(const std::size_t size = 300)
  {
    State state;
    state.column = {-0.0, 5e-324, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()};
    for (std::size_t i = state.column.size(); i < size; ++i)
      state.column.push_back(std::sqrt(i) / 3);
    state.numbers = {-2147483647 - 1, 0, 2147483647};
    state.time    = 1.0 / 3;
    state.steps   = (std::int64_t(1) << 62) + 1; // would not survive as a double
    return state;
  }

  void write(const std::filesystem::path &path, State state, const std::string &of_scene = scene)
  {
    CheckpointWriter writer(path, of_scene);
    writer.group("specimen");
    state.visit_state(writer);
    writer.commit();
  }

  State read(const std::filesystem::path &path)
  {
    State            state;
    CheckpointReader reader(path, scene);
    reader.group("specimen");
    state.visit_state(reader);
    reader.finish();
    return state;
  }

  /** The message of the refusal. */
  template <typename Action>
  std::string refusal(const Action &action)
  {
    try
      {
        action();
      }
    catch (const base::InputError &error)
      {
        return error.what();
      }
    return "accepted";
  }
} // namespace

TEST_CASE("a checkpoint gives back the same bits", "[postprocess]")
{
  const ScratchFolder folder;
  const std::size_t   size  = GENERATE(4, 300, 400000); // one, one and several chunks
  const State         state = sample_state(size);
  write(folder / "checkpoint.h5", state);
  const State back = read(folder / "checkpoint.h5");
  REQUIRE(back.column.size() == size);
  REQUIRE(std::memcmp(back.column.data(), state.column.data(), size * sizeof(double)) == 0);
  REQUIRE(back.numbers == state.numbers);
  REQUIRE(back.none.empty());
  REQUIRE(back.time == state.time);
  REQUIRE(back.steps == state.steps);
  REQUIRE(files_in(folder.path) == 1);
}

TEST_CASE("a column that comes in parts makes the file of one that comes whole, which is read in parts again",
          "[postprocess]")
{
  const ScratchFolder at_once, by_parts; // a checkpoint lists what lies beside it
  const std::size_t   size = GENERATE(0, 300, 131072, 400000);
  base::Column        column;
  for (std::size_t i = 0; i < size; ++i)
    column.push_back(std::sqrt(i) / 3);
  const auto in_parts = [&](const std::size_t said, const std::size_t length) {
    CheckpointWriter writer(by_parts / "checkpoint.h5", scene);
    writer.column_in_parts("column", said, [&](const base::StateVisitor::Take &take) {
      for (std::size_t at = 0; at < size; at += length)
        take(&column[at], std::min(length, size - at));
    });
    writer.commit();
  };
  {
    CheckpointWriter writer(at_once / "checkpoint.h5", scene);
    writer.column("column", column);
    writer.commit();
  }
  {
    CheckpointReader reader(at_once / "checkpoint.h5", scene);
    base::Column     back;
    std::size_t      longest = 0;
    reader.read_in_parts("column", [&](const double *const numbers, const std::size_t count) {
      back.insert(back.end(), numbers, numbers + count);
      longest = std::max(longest, count);
    });
    CHECK((back == column));
    CHECK(longest <= size_t(1) << 17);
    reader.finish();
  }
  for (const std::size_t length : {size_t(7001), size_t(1) << 17, size_t(300001)})
    {
      INFO(size << " numbers in parts of " << length);
      in_parts(size, length);
      CHECK((content_of(by_parts / "checkpoint.h5") == content_of(at_once / "checkpoint.h5")));
    }
  CHECK_THROWS_WITH(in_parts(size + 1, 1000), Contains("fewer numbers than were said"));
  if (size > 0)
    CHECK_THROWS_WITH(in_parts(size - 1, 1000), Contains("more numbers than were said"));
  CHECK(files_in(by_parts.path) == 1);
}

TEST_CASE("reading a checkpoint resizes columns, and groups keep equal names apart", "[postprocess]")
{
  const ScratchFolder folder;
  State               first = sample_state(10), second = sample_state(20);
  {
    CheckpointWriter writer(folder / "c.h5", scene);
    writer.group("first");
    first.visit_state(writer);
    writer.group("driver/second");
    second.visit_state(writer);
    writer.commit();
  }
  State            back = sample_state(1000);
  CheckpointReader reader(folder / "c.h5", scene);
  reader.group("driver/second");
  back.visit_state(reader);
  REQUIRE(back.column.size() == 20);
  REQUIRE(refusal([&] { reader.finish(); }) ==
          (folder / "c.h5").string() +
            ": holds \"state/first/column\", which this program does not know: it was made by "
            "another version. Start the run afresh with --restart.");
  reader.group("first");
  back.visit_state(reader);
  REQUIRE(back.column.size() == 10);
  REQUIRE_NOTHROW(reader.finish());
}

TEST_CASE("a checkpoint of another scene is refused and says what differs", "[postprocess]")
{
  const ScratchFolder folder;
  write(folder / "c.h5", sample_state(), "set Damping = 0.3\n  set Seed = 2\n");
  REQUIRE(
    refusal([&] { read(folder / "c.h5"); }) ==
    (folder / "c.h5").string() +
      ": was made by another scene: then \"set Seed = 2\", now \"set Seed = 1\". Start the run afresh with --restart.");
  write(folder / "c.h5", sample_state(), scene + "set More = 1\n");
  REQUIRE_THAT(refusal([&] { read(folder / "c.h5"); }), Contains("then \"set More = 1\", now nothing"));
}

TEST_CASE("a checkpoint that is missing, foreign, of another version or lacks an item is refused", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder / "c.h5";
  REQUIRE(refusal([&] { read(path); }) == path.string() + ": no such file.");
  folder.file("c.h5", "text");
  REQUIRE(refusal([&] { read(path); }) == path.string() + ": is not an HDF5 file.");
  {
    hdf5::OutputFile foreign(path);
    foreign.commit();
  }
  REQUIRE(refusal([&] { read(path); }) == path.string() + ": is not a checkpoint.");
  {
    const std::int64_t version = 7;
    hdf5::OutputFile   newer(path);
    newer.write_text("format", "breccia checkpoint");
    newer.write("format_version", &version, {});
    newer.commit();
  }
  REQUIRE(refusal([&] { read(path); }) ==
          path.string() + ": checkpoint format 7, this program reads format 1. Start the run afresh with --restart.");
  {
    CheckpointWriter writer(path, scene);
    writer.commit();
  }
  REQUIRE(refusal([&] { read(path); }) == path.string() + ": \"state/specimen/column\" is missing.");
}

TEST_CASE("an item of another type or shape is refused by name", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder / "c.h5";
  write(path, sample_state());
  CheckpointReader reader(path, scene);
  reader.group("specimen");
  base::Column              column;
  std::vector<std::int32_t> numbers;
  double                    real  = 0;
  std::int64_t              whole = 0;
  REQUIRE_THAT(refusal([&] { reader.column("numbers", column); }), EndsWith("another type: real numbers expected."));
  REQUIRE_THAT(refusal([&] { reader.column("column", numbers); }), EndsWith("whole numbers of 32 bits expected."));
  REQUIRE_THAT(refusal([&] { reader.scalar("time", whole); }), EndsWith("another type: whole numbers expected."));
  REQUIRE_THAT(refusal([&] { reader.scalar("column", real); }), Contains("is a column, one number expected"));
  REQUIRE_THAT(refusal([&] { reader.column("time", column); }), Contains("is one number, a column expected"));
}

TEST_CASE("a checkpoint that was cut short or has a wrong byte is refused", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder / "c.h5";
  write(path, sample_state(1000));
  const std::string whole = content_of(path);

  SECTION("cut short, anywhere")
  {
    for (std::size_t bytes = 0; bytes < whole.size(); bytes += 97)
      {
        CAPTURE(bytes);
        folder.file("c.h5", whole.substr(0, bytes));
        REQUIRE(refusal([&] { read(path); }) != "accepted");
      }
  }
  SECTION("one byte of the stored column changed")
  {
    const double value = sample_state(1000).column[500];
    char         bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    const std::size_t place = whole.find(std::string(bytes, sizeof(value)));
    REQUIRE(place != std::string::npos);
    std::string damaged = whole;
    damaged[place] ^= 1;
    folder.file("c.h5", damaged);
    REQUIRE_THAT(refusal([&] { read(path); }), Contains("\"state/specimen/column\" is damaged"));
  }
}

TEST_CASE("a full disk leaves the earlier checkpoint, is reported, and the program goes on", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder / "c.h5";
  write(path, sample_state(50));
  const std::string earlier = content_of(path);
  const State       state   = sample_state(400000);
  for (const rlim_t bytes :
       {1, 5000, 100000, 2000000}) // in the first block, in metadata, in the first and a later chunk
    {
      std::string message = "written";
      {
        const FullDisk limit(bytes);
        try
          {
            write(path, state);
          }
        catch (const OutputError &error)
          {
            message = error.what();
          }
      }
      CAPTURE(bytes);
      REQUIRE_THAT(message, EndsWith("File too large."));
      REQUIRE_THAT(message, Contains(path.string()));
      REQUIRE(content_of(path) == earlier);
      REQUIRE(files_in(folder.path) == 1);
    }
  write(path, state); // HDF5 is still in order
  REQUIRE(read(path).column.size() == 400000);
}

TEST_CASE("a checkpoint that is not committed leaves the earlier one", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder / "c.h5";
  write(path, sample_state(50));
  const std::string earlier = content_of(path);
  {
    CheckpointWriter writer(path, scene);
    State            state = sample_state(1000);
    state.visit_state(writer);
  }
  REQUIRE(content_of(path) == earlier);
  REQUIRE(files_in(folder.path) == 1);
}

TEST_CASE("a name used twice in one group is refused", "[postprocess]")
{
  const ScratchFolder folder;
  CheckpointWriter    writer(folder / "c.h5", scene);
  double              value = 1;
  writer.scalar("value", value);
  REQUIRE_THROWS_AS(writer.scalar("value", value), OutputError);
}

TEST_CASE("a collection of snapshots goes on from its checkpoint", "[postprocess]")
{
  const ScratchFolder folder;
  PvdCollection       snapshots(folder.path, "particles");
  snapshots.add(0);
  snapshots.add(0.5);
  {
    CheckpointWriter writer(folder / "c.h5", scene);
    base::Column     times = snapshots.listed();
    writer.group("particles");
    writer.column("times", times);
    writer.commit();
  }
  snapshots.add(1);
  const std::string whole = content_of(folder / "particles.pvd");

  PvdCollection    resumed(folder.path, "particles");
  CheckpointReader reader(folder / "c.h5", scene);
  base::Column     times;
  reader.group("particles");
  reader.column("times", times);
  reader.finish();
  std::filesystem::remove(folder / "particles.pvd");
  resumed.restore(times);
  REQUIRE(std::filesystem::exists(folder / "particles.pvd")); // lost in between, or longer than at the checkpoint
  REQUIRE(resumed.next() == folder / "particles/particles_000002.vtp");
  resumed.add(1);
  REQUIRE(content_of(folder / "particles.pvd") == whole);
}

TEST_CASE("a state that was not written so is refused before anything of it is used", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder / "c.h5";
  {
    hdf5::OutputFile forged(path);
    const auto number = [&](const std::string &name, const std::int64_t value) { forged.write(name, &value, {}); };
    forged.write_text("format", "breccia checkpoint");
    number("format_version", 1);
    forged.write_text("scene", scene);
    number("state/specimen/steps", 5);
    number("fingerprint", 12345);
    forged.write_text("companions", "");
    forged.commit();
  }
  REQUIRE_THAT(refusal([&] { CheckpointReader(path, scene); }), Contains("its content is not what was written"));
}

TEST_CASE("a series or snapshot beside a checkpoint may grow, and not change or go", "[postprocess]")
{
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "solid");
  folder.file("series.csv", "time [s]\n1\n2\n");
  folder.file("solid/solid_000000.vtu", "snapshot");
  folder.file("solid.pvd", "one");
  folder.file("notes.txt", "mine");
  write(folder / "c.h5", sample_state());
  const auto refused = [&] { return refusal([&] { read(folder / "c.h5"); }); };
  REQUIRE(refused() == "accepted");

  SECTION("what is written after the checkpoint, or is no result, does not matter")
  {
    folder.file("series.csv", "time [s]\n1\n2\n3\n");
    folder.file("solid/solid_000001.vtu", "another");
    folder.file("solid.pvd", "one, two");
    std::filesystem::remove(folder / "notes.txt");
    CHECK(refused() == "accepted");
  }
  SECTION("a row that changed")
  {
    folder.file("series.csv", "time [s]\n1\n7\n");
    CHECK_THAT(refused(), Contains("series.csv: has changed since the checkpoint beside it was written"));
  }
  SECTION("a row that is missing")
  {
    folder.file("series.csv", "time [s]\n1\n");
    CHECK_THAT(refused(), Contains("series.csv: has lost its end since the checkpoint"));
  }
  SECTION("a snapshot that has gone")
  {
    std::filesystem::remove(folder / "solid/solid_000000.vtu");
    CHECK_THAT(refused(), Contains("solid_000000.vtu: has gone since the checkpoint"));
  }
  SECTION("a change between two checkpoints is no damage")
  {
    folder.file("series.csv", "time [s]\n1\n7\n");
    write(folder / "c.h5", sample_state());
    CHECK(refused() == "accepted");
  }
}
