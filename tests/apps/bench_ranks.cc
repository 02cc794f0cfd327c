// Cubes of a lattice shared out among ranks, as a specimen and on paper.
#include "apps/bench/cube_of_lattice.h"
#include "dem/specimen/rank_shares.h"
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <vector>

using namespace apps_tests;

TEST_CASE("bench ranks: links of a cube on paper are shared out as those of the specimen", "[apps][ranks]")
{
  constexpr int                     cells    = 9; // 2916 particles, twelve bricks
  const dem::Specimen               body     = apps::cube_of_lattice(cells);
  const dem::LinkEnds               links    = apps::links_of_cube(cells);
  const std::vector<dem::RankShare> expected = dem::share_out(body, 5),
                                    found    = dem::share_out(body.counts().particles, links, 5);
  REQUIRE(links.size() == body.counts().links);
  REQUIRE(found.size() == expected.size());
  for (std::size_t r = 0; r < found.size(); ++r)
    {
      INFO("rank " << r);
      CHECK(found[r].first_particle == expected[r].first_particle);
      CHECK(found[r].owned == expected[r].owned);
      CHECK(found[r].copied.size() == expected[r].copied.size());
      CHECK(found[r].ghosts == expected[r].ghosts);
    }
}

TEST_CASE("bench ranks --on-paper: a rank needs more memory the more ranks there are, and less than all",
          "[apps][ranks]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"bench", "ranks", "--on-paper", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const postprocess::CsvTable table = postprocess::read_csv_table(folder / "bench/ranks_on_paper.csv");
  const auto                 &rank = table.column("memory of a rank"), &whole = table.column("memory of all"),
             &efficiency = table.column("efficiency"), &particles = table.column("particles");
  const auto &cut = table.column("copies"), &twice = table.column("updated twice");
  REQUIRE(rank.size() == 6);
  CHECK(particles.front() == 16384);
  CHECK(efficiency.front() == Approx(1));
  CHECK(rank.front() == Approx(whole.front()));
  for (std::size_t row = 1; row < rank.size(); ++row)
    {
      CHECK(efficiency[row] < 1);
      CHECK(efficiency[row] > 0);
      CHECK(rank[row] > rank[row - 1]);
      CHECK(rank[row] < whole[row]);
      // A pack has one cut link at least, and eight at most.
      CHECK(twice[row] > cut[row]);
      CHECK(twice[row] < 8 * cut[row]);
    }
  CHECK(std::filesystem::file_size(folder / "bench/ranks_on_paper.png") > 0);
}
