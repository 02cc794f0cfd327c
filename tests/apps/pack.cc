#include "postprocess/packings/packing_io.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <regex>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  double number_after(const std::string &words, const std::string &text)
  {
    std::smatch found;
    REQUIRE(std::regex_search(text, found, std::regex(words + " ([0-9.e+-]+)")));
    return std::stod(found[1]);
  }
} // namespace

TEST_CASE("pack writes a periodic packing whose packing fraction is the one it prints", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"pack", "--radius", "2e-3", "--count", "64", "-o", "p.h5"});
  REQUIRE(outcome.status == 0);
  const dem::Packing packing = postprocess::read_packing(folder / "p.h5");
  REQUIRE(packing.size() == 64);
  REQUIRE(packing.periodic_cell.has_value());
  const double fraction = 64 * 4.0 / 3.0 * M_PI * 8e-9 / packing.periodic_cell->prod();
  CHECK(number_after("packing fraction", outcome.out) == Approx(fraction).margin(5e-5)); // four decimals are printed
  CHECK_THAT(outcome.out, Contains("contacts per sphere") && Contains("mean overlap"));
}

TEST_CASE("pack repeats a packing to the last bit from its seed, in both formats", "[apps]")
{
  const ScratchFolder folder;
  const auto          pack = [&](const std::string &seed, const std::string &file) {
    REQUIRE(run(folder.path(), {"pack", "--radius", "2e-3", "--count", "64", "--seed", seed, "-o", file}).status == 0);
    return postprocess::read_packing(folder / file);
  };
  const dem::Packing first = pack("3", "a.txt"), again = pack("3", "b.h5"), other = pack("4", "c.txt");
  CHECK(first.centre == again.centre);
  CHECK(*first.periodic_cell == *again.periodic_cell);
  CHECK(first.centre != other.centre);
}

TEST_CASE("pack fills a box with whole spheres, of a new or of an existing packing", "[apps]")
{
  const ScratchFolder folder;
  REQUIRE(run(folder.path(), {"pack", "--radius", "2e-3", "--count", "64", "-o", "cell.h5"}).status == 0);
  const Outcome cropped = run(folder.path(), {"pack", "--from", "cell.h5", "--box", "0.03,0.02,0.04", "-o", "box.txt"});
  REQUIRE(cropped.status == 0);
  CHECK_THAT(cropped.err, Catch::Contains("faces of the box are cut and sparse") && Catch::Contains("--moulded"));
  REQUIRE(run(folder.path(), {"pack", "--radius", "2e-3", "--count", "64", "--box", "0.03,0.02,0.04", "-o", "same.h5"})
            .status == 0);
  const dem::Packing box = postprocess::read_packing(folder / "box.txt");
  CHECK(box.centre == postprocess::read_packing(folder / "same.h5").centre);
  CHECK_FALSE(box.periodic_cell.has_value());
  const Eigen::Vector3d edges(0.03, 0.02, 0.04);
  for (const Eigen::Vector3d &centre : box.centre)
    {
      CHECK(centre.minCoeff() >= 2e-3 * (1 - 1e-9)); // round-off of the periodic images
      CHECK((edges - centre).minCoeff() >= 2e-3 * (1 - 1e-9));
    }
}

TEST_CASE("pack leaves a packing under the prescribed pressure, as a scene does", "[apps]")
{
  const ScratchFolder folder;
  const auto          overlap = [&](const std::vector<std::string> &more) {
    std::vector<std::string> words = {"pack", "--radius", "0.01", "--count", "75", "--friction", "0.1", "-o", "p.txt"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(folder.path(), words);
    REQUIRE(outcome.status == 0);
    return number_after("mean overlap", outcome.out);
  };
  const double usual = overlap({}), same = overlap({"--pressure", "1e-3"}), high = overlap({"--pressure", "6.667e-3"});
  CHECK(same == usual);
  // Overlaps carry the pressure: as many times larger, but for the contacts that it adds.
  CHECK(high > 3 * usual);
  CHECK(high < 6.667 * usual);
  for (const char *wrong : {"0", "0.1", "-1e-3", "nan"})
    {
      const Outcome refused =
        run(folder.path(), {"pack", "--radius", "0.01", "--count", "75", "--pressure", wrong, "-o", "q.txt"});
      CHECK(refused.status == 2);
      CHECK_THAT(refused.err, Contains("pressure"));
    }
}

TEST_CASE("pack refuses wrong options and files with status 2", "[apps][S14]")
{
  const ScratchFolder folder;
  const auto          refused = [&](const std::vector<std::string> &arguments, const std::string &message) {
    std::vector<std::string> all = {"pack"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(folder.path(), all);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
  };
  refused({"-o", "p.h5"}, "give --radius (> 0, in m)");
  refused({"--radius", "1e-3"}, "--output is required");
  refused({"--radius", "1e-3", "--count", "64", "--friction", "-1", "-o", "p.h5"}, "friction");
  refused({"--radius", "1e-3", "--count", "64", "--damping", "1", "-o", "p.h5"}, "damping");
  refused({"--radius", "1e-3", "--box", "0.1,0.1", "-o", "p.h5"}, "--box 0.1,0.1: expected three edges");
  refused({"--radius", "1e-3", "--box", "0.1,0.1,0.1", "--periodic", "-o", "p.h5"}, "excludes");
  refused({"--from", "none.h5", "-o", "p.h5"}, "none.h5");
  refused({"--radius", "1e-3", "--count", "64", "-o", "none/p.h5"}, "none");
  CHECK_FALSE(std::filesystem::exists(folder / "p.h5"));
}
