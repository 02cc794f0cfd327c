#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string refusal_of(const std::string &packing)
  {
    const ScratchFolder folder;
    folder.file("packing.txt", packing);
    folder.file("x.prm", scene_with_file());
    const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find('\n') == outcome.err.size() - 1); // one line
    CHECK_FALSE(std::filesystem::exists(folder / "results"));
    return outcome.err;
  }
} // namespace

TEST_CASE("A packing of which no specimen can be made is refused with file and line", "[apps][S14]")
{
  CHECK_THAT(refusal_of("0 0 0 1e-3\n0 nan 2e-3 1e-3\n"), Contains("packing.txt, line 2") && Contains("nan"));
  CHECK_THAT(refusal_of("0 0 0 1e-3\n0 0 2e-3 -1e-3\n"), Contains("packing.txt, line 2") && Contains("radius"));
  CHECK_THAT(refusal_of("0 0 0 1e-3\n0 0 2e-3 0\n"), Contains("packing.txt, line 2") && Contains("radius"));
  CHECK_THAT(refusal_of("0 0 0 1e-3\n0 0 2e-3\n"), Contains("packing.txt, line 2"));
  CHECK_THAT(refusal_of("0 0 0 1e-3\n0 0 two 1e-3\n"), Contains("packing.txt, line 2") && Contains("two"));
  CHECK_THAT(refusal_of("0 0 0 1e-3\n1e-3 0 0 1e-3\n0 0 0 1e-3\n"),
             Contains("packing.txt") && Contains("1") && Contains("3"));
  CHECK_THAT(refusal_of(""), Contains("packing.txt") && Contains("no particle"));
  CHECK_THAT(refusal_of("# x y z radius\n"), Contains("packing.txt") && Contains("no particle"));
}

TEST_CASE("A packing whose particles overlap by almost a diameter is refused by check and run", "[apps]")
{
  const std::string packing = "0 0 0 1e-3\n0 0 2e-3 1e-3\n0 0.1e-3 2e-3 1e-3\n";
  CHECK_THAT(refusal_of(packing), Contains("packing.txt: particles 2 and 3 overlap by") && Contains("95 %"));
  const ScratchFolder folder;
  folder.file("packing.txt", packing);
  folder.file("x.prm", scene_with_file());
  CHECK(run(folder.path(), {"check", "x.prm"}).status == 2);
}

TEST_CASE("A single particle, with nothing to be linked to, is refused", "[apps][S14]")
{
  CHECK_THAT(refusal_of("0 0 0 1e-3\n"), Contains("no two particles are near enough to be linked"));
}
