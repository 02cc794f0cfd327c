#include "postprocess/files/atomic_file.h"

#include "full_disk.h"
#include "postprocess/files/errors.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

using namespace postprocess;
using Catch::Matchers::Contains;
using postprocess_tests::content_of;
using postprocess_tests::files_in;
using postprocess_tests::FullDisk;
using postprocess_tests::ScratchFolder;

TEST_CASE("an atomic file that is not committed leaves the earlier file and no other", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder.file("result", "earlier");
  {
    const AtomicFile target(path);
    std::ofstream(target.partial()) << "half of the new";
    REQUIRE(target.partial().parent_path() == folder.path); // the same disk, so that renaming is one step
    REQUIRE(content_of(path) == "earlier");
  }
  REQUIRE(content_of(path) == "earlier");
  REQUIRE(files_in(folder.path) == 1);
}

TEST_CASE("write_text replaces a file, and makes one where there was none", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder / "result";
  for (const std::string text : {"first and longer", "second", ""})
    {
      write_text(path, text);
      REQUIRE(content_of(path) == text);
      REQUIRE(files_in(folder.path) == 1);
    }
}

TEST_CASE("write_text follows a symbolic link", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder.file("result", "earlier");
  std::filesystem::create_symlink("result", folder / "link");
  write_text(folder / "link", "new");
  REQUIRE(std::filesystem::is_symlink(folder / "link"));
  REQUIRE(content_of(path) == "new");
}

TEST_CASE("a full disk leaves the earlier file as it was and is reported", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder.file("result", "earlier");
  std::string         message;
  {
    const FullDisk limit(1000);
    try
      {
        write_text(path, std::string(5000, 'x'));
      }
    catch (const OutputError &error)
      {
        message = error.what();
      }
  }
  REQUIRE_THAT(message, Contains("result.partial: cannot be written: File too large"));
  REQUIRE(content_of(path) == "earlier");
  REQUIRE(files_in(folder.path) == 1);
}

TEST_CASE("a device is written to, never replaced", "[postprocess]")
{
  REQUIRE_NOTHROW(write_text("/dev/null", "text"));
  REQUIRE(std::filesystem::is_character_file("/dev/null"));
  REQUIRE_THROWS_WITH(write_text("/dev/full", "text"), "/dev/full: cannot be written: No space left on device.");
  REQUIRE_THROWS_WITH(AtomicFile("/dev/null"), Contains("/dev/null: is a folder or device"));
  REQUIRE(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("a place where no file can be is refused with its name", "[postprocess]")
{
  const ScratchFolder folder;
  folder.file("file", "");
  REQUIRE_THROWS_WITH(write_text(folder / "missing/result", ""), Contains("missing does not exist"));
  REQUIRE_THROWS_WITH(write_text(folder / "file/result", ""), Contains("file does not exist"));
  REQUIRE_THROWS_WITH(write_text(folder.path, ""), Contains(folder.path.string() + ": is a folder"));
  REQUIRE_THROWS_WITH(write_text("/proc/self/result", ""),
                      Contains("cannot be opened for writing")); // unwritable, also for root
  REQUIRE_THROWS_AS(write_text("/proc/self/result", ""), OutputError);
}
