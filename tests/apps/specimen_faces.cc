// Faces of generated boxes: cut out of a cell, or moulded; what is said of them before a run, and what they make of a specimen.
#include "postprocess/packings/packing_io.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::string scene = places::sources() + "/apps/scenes/quick_uniaxial.prm";
  /** A cube of ten diameters, of which stiffness is measured in a few hundred steps. */
  const std::vector<std::string> cube = {"Specimen/Box size=0.04, 0.04, 0.04",
                                         "Loading/Grip lateral motion blocked=false",
                                         "Loading/Tests=tension",
                                         "Loading/Tension/Strain rate=0.2",
                                         "Loading/Tension/Stop strain=4e-5",
                                         "Physics/Damage=false",
                                         "Output/Snapshots=0"};

  std::vector<std::string> with(std::vector<std::string> changes, const std::string &more)
  {
    changes.push_back(more);
    return changes;
  }

  const std::string cut_out = "Specimen/Generator/Faces=cut", moulded = "Specimen/Generator/Faces=moulded",
                    cut_faces = "faces of the specimen are cut and sparse";

  double number_after(const std::string &words, const std::string &text)
  {
    std::smatch found;
    REQUIRE(std::regex_search(text, found, std::regex(words + "([0-9.e+-]+)")));
    return std::stod(found[1]);
  }

  /** Stress over strain at the end [Pa]. */
  double modulus(const Results &results)
  {
    return results.series.column("stress").back() / results.series.column("strain").back();
  }
} // namespace

TEST_CASE("A small box cut out of a cell is warned of before the run, a moulded one is dense to its faces", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       cut = outcome_of(folder, "check", scene, with(cube, cut_out));
  CHECK_THAT(cut.err, Contains(cut_faces) && Contains("Specimen/Generator/Faces = moulded"));
  CHECK(number_after("packed       ", cut.out) == Approx(0.553).margin(0.01)); // inside; the scatter of seeds is 0.003
  CHECK(number_after(" inside, ", cut.out) < 0.42);

  const Outcome flat = outcome_of(folder, "check", scene, with(cube, moulded));
  CHECK_THAT(flat.err, !Contains(cut_faces));
  CHECK(number_after(" inside, ", flat.out) > 0.50);

  // Large specimens have the same faces, and they hardly count; periodic cells have none.
  CHECK(number_after("packed       ",
                     outcome_of(folder, "check", places::sources() + "/apps/scenes/periodic_cell.prm", {}).out) > 0.5);
}

TEST_CASE("Sparse faces are warned of where bonds hold the grains together, and not where they are loose", "[apps]")
{
  const ScratchFolder folder;
  const std::string   grains = R"(set Kind = particles
subsection Specimen
  set Source   = generator
  set Box size = 0.04, 0.04, 0.04
  set Density  = 2500
  subsection Generator
    set Particle radius = 0.002
  end
end
subsection Time
  set End time = 1e-4
end
)";
  folder.file("loose.prm", grains + "subsection Material\n  set Law = linear\n  subsection linear\n"
                                    "    set Effective modulus = 1e8\n  end\nend\n");
  folder.file(
    "bonded.prm",
    replaced(grains, "set Density", "set Interaction ratio = 1.05\n  set Density") +
      "subsection Material\n  set Law = parallel-bond\n  subsection parallel-bond\n    set Effective modulus = 1e9\n"
      "    set Tensile strength = 1e6\n    set Cohesion = 1e6\n  end\nend\n");
  const Outcome loose  = outcome_of(folder, "check", "loose.prm", {}),
                bonded = outcome_of(folder, "check", "bonded.prm", {"Specimen/Loose pieces=drop"});
  INFO(loose.err << bonded.err);
  CHECK(loose.status == 0);
  CHECK_THAT(loose.err, !Contains(cut_faces));
  CHECK(bonded.status == 0);
  CHECK_THAT(bonded.err, Contains(cut_faces));
  // A packing that was cut before has no cell any more, and the same faces.
  REQUIRE(run(folder.path(), {"pack", "--radius", "0.002", "--box", "0.04,0.04,0.04", "-o", "cut.txt"}).status == 0);
  folder.file("from_file.prm", replaced(content_of(folder / "bonded.prm"), "set Source   = generator",
                                        "set Source   = file\n  set File     = cut.txt"));
  CHECK_THAT(outcome_of(folder, "check", "from_file.prm", {"Specimen/Loose pieces=drop"}).err, Contains(cut_faces));
}

TEST_CASE("A moulded specimen of ten diameters is stiffer by a quarter than one whose sparse faces are cut",
          "[apps][slow]")
{
  const ScratchFolder folder, other;
  const double        cut = modulus(results_of(folder, scene, with(cube, cut_out), {"test"})),
               flat       = modulus(results_of(other, scene, with(cube, moulded), {"test"}));
  CHECK(flat > 1.25 * cut);

  // What the note says is left, beside what is left of the stiffness of the cell.
  REQUIRE(run(folder.path(), {"pack", "--radius", "0.002", "--count", "1000", "-o", "cell.txt"}).status == 0);
  const Outcome homogenised = run(folder.path(), {"homogenise", "cell.txt", "--interaction-ratio", "1.5",
                                                  "--normal-modulus", "25e9", "--shear-ratio", "0.2"});
  const double  of_cell     = 1e9 * number_after("relaxed +", homogenised.out),
               said =
                 number_after("by its links it has some ", outcome_of(folder, "check", scene, with(cube, cut_out)).err);
  CHECK(said == Approx(100 * cut / of_cell).margin(8));
}

TEST_CASE("A generated box is moulded where a laboratory's specimen is meant, unless its scene says otherwise",
          "[apps]")
{
  const ScratchFolder folder;
  const std::string   left_out = replaced(content_of(scene), "    set Faces           = moulded\n", "");
  folder.file("left_out.prm", left_out);
  const Outcome by_default = outcome_of(folder, "check", "left_out.prm", cube);
  CHECK(by_default.out == outcome_of(folder, "check", "left_out.prm", with(cube, moulded)).out);
  CHECK(by_default.out != outcome_of(folder, "check", "left_out.prm", with(cube, cut_out)).out);

  is_refused(folder, "left_out.prm", {"Specimen/Generator/Cell particles=500"},
             "a moulded box, which Faces has by default, is made in one piece");
  // A cell has no faces; that of this kind has them by default all the same.
  const std::string path = places::sources() + "/apps/scenes/quasi_static.prm";
  folder.file("cell.prm", replaced(content_of(path), "    set Faces ", "    # "));
  CHECK(outcome_of(folder, "check", "cell.prm", {"Specimen/Body=cell"}).status == 0);
}

TEST_CASE("pack moulds a box whose spheres reach to all six faces", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       outcome =
    run(folder.path(), {"pack", "--radius", "2e-3", "--box", "0.04,0.03,0.03", "--moulded", "-o", "box.h5"});
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("mould: ") && Contains("box:  "));
  const dem::Packing packing = postprocess::read_packing(folder / "box.h5");
  CHECK_FALSE(packing.periodic_cell.has_value());
  const Eigen::Vector3d box(0.04, 0.03, 0.03);
  for (int d = 0; d < 3; ++d)
    {
      const auto by_place    = [d](const Eigen::Vector3d &a, const Eigen::Vector3d &b) { return a[d] < b[d]; };
      const auto [low, high] = std::minmax_element(packing.centre.begin(), packing.centre.end(), by_place);
      CHECK((*low)[d] == Approx(2e-3).epsilon(0.02));
      CHECK(box[d] - (*high)[d] == Approx(2e-3).epsilon(0.02));
    }
  for (const std::vector<std::string> &more : {std::vector<std::string>{"--radius", "2e-3"},
                                               {"--radius", "2e-3", "--count", "64", "--box", "0.04,0.03,0.03"},
                                               {"--from", "box.h5", "--box", "0.04,0.03,0.03"}})
    {
      std::vector<std::string> words = {"pack", "--moulded", "-o", "other.h5"};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome refused = run(folder.path(), words);
      CHECK(refused.status == 2);
      CHECK_THAT(refused.err, Contains("--moulded goes with --radius and --box"));
    }
}

TEST_CASE("Moulded faces are refused where a packing has none, or is made of a cell", "[apps]")
{
  const ScratchFolder folder;
  is_refused(folder, scene, {moulded, "Specimen/Generator/Cell particles=1000"}, "made in one piece");
  is_refused(folder, places::sources() + "/apps/scenes/quasi_static.prm", {"Specimen/Body=cell", moulded},
             "a periodic cell has none");
}
