// Joints of scenes: materials of their own, and kinds that have them.
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::string constants = R"(
subsection smooth-joint
  set Normal stiffness     = 4e12
  set Shear stiffness      = 2e12
  set Friction coefficient = 0.3
  set Cohesion             = 1e6
  set Tensile strength     = 1e6
end
)";

  std::string joint(const std::string &name, const std::string &says, const double height)
  {
    return "subsection Specimen\nsubsection Joints\nsubsection " + name +
           "\nset Shape = plane\nset Dip = 15\nset Place = 0, 0, " + std::to_string(height) + "\n" + says +
           "\nend\nend\nend\n";
  }

  /** Two joints through the stack, of one material, or with the same constants each. */
  std::string two_joints(const std::string &scene, const bool of_one_material)
  {
    const std::string says = of_one_material ? "set Material = fault" : constants;
    return scene + joint("lower", says, 0.003) + joint("upper", says, 0.007) +
           (of_one_material ? "subsection Joint materials\nsubsection fault" + constants + "end\nend\n" : "");
  }

  std::string static_scene()
  {
    std::string scene = replaced(scene_with_file(), "Kind = uniaxial", "Kind = quasi_static");
    scene             = replaced(scene, "  set Density           = 4800\n", "");
    scene             = replaced(scene, "set Strain rate = 4\n", "set Stop fraction = 0.5\n");
    scene = replaced(scene, "set Strain rate = 20\n", "set Stop strain = 1e-4\n    set Strain step = 2e-5\n");
    return replaced(scene, "  set Samples   = 50\n  set Snapshots = 5\n", "  set Points per snapshot = 0\n");
  }

  const std::vector<std::string> in_compression = {"run", "x.prm", "-o", "out", "-s", "Loading/Tests=compression"};
} // namespace

TEST_CASE("joints of one material have the bits of joints with these constants each, in motion and in equilibrium",
          "[apps]")
{
  for (const std::string &scene :
       {replaced(scene_with_file(), "set Strain rate = 20\n", "set Strain rate = 20\n    set Stop strain = 1e-4\n"),
        static_scene()})
    {
      std::vector<std::string> series;
      for (const bool of_one_material : {false, true})
        {
          const ScratchFolder folder;
          folder.file("packing.txt", stack_packing());
          folder.file("x.prm", two_joints(scene, of_one_material));
          const Outcome outcome = run(folder.path(), in_compression);
          INFO(outcome.err);
          REQUIRE(outcome.status == 0);
          series.push_back(content_of(folder / "out/series.csv"));
          const auto summary = nlohmann::json::parse(content_of(folder / "out/summary.json"));
          const auto classes = summary["tests"][0]["link_classes"];
          REQUIRE(classes.size() == 3);
          CHECK(classes[1]["class"] == "joint lower");
          CHECK(classes[1]["links"].get<double>() > 10);
          CHECK(summary["energy"]["balance_error"].get<double>() < 1e-2);
        }
      CHECK(series[0] == series[1]);
    }
}

TEST_CASE("materials of joints that are misspelt, missing or of no joint are refused by name", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", two_joints(static_scene(), true));
  const auto refusal = [&](const std::vector<std::string> &changes) {
    std::vector<std::string> words = {"check", "x.prm"};
    for (const std::string &change : changes)
      words.insert(words.end(), {"-s", change});
    const Outcome outcome = run(folder.path(), words);
    CHECK(outcome.status == 2);
    return outcome.err;
  };
  CHECK(run(folder.path(), {"check", "x.prm"}).status == 0);
  CHECK_THAT(refusal({"Specimen/Joints/lower/Material=falut"}),
             Contains("Specimen/Joints/lower/Material") && Contains("Did you mean \"fault\"?"));
  CHECK_THAT(refusal({"Specimen/Joints/lower/Material=", "Specimen/Joints/upper/Material="}),
             Contains("smooth-joint/Normal stiffness"));
  CHECK_THAT(refusal({"Joint materials/fault/smooth-joint/Dilation angle=40"}),
             Contains("Joint materials/fault/smooth-joint/Dilation angle"));
  folder.file("x.prm", two_joints(static_scene(), false) + "subsection Joint materials\nsubsection fault" + constants +
                         "end\nend\n");
  CHECK_THAT(refusal({}), Contains("Joint materials/fault") && Contains("no joint is of this material"));
}

TEST_CASE("a scene in equilibrium says what its joints cut, and a periodic cell has none", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", two_joints(static_scene(), true));
  const Outcome outcome = run(folder.path(), {"check", "x.prm"});
  INFO(outcome.err);
  CHECK_THAT(outcome.out, Contains("joint lower") && Contains("links, which share"));
  const Outcome cell = run(folder.path(), {"check", "x.prm", "-s", "Specimen/Body=cell"});
  CHECK(cell.status == 2);
  CHECK_THAT(cell.err, Contains("Joints"));
}

TEST_CASE(
  "The block of rock on an inclined joint slides as the closed form says, and stays below the angle of friction",
  "[apps]")
{
  const ScratchFolder folder;
  const std::string   scene  = places::sources() + "/apps/scenes/sliding_block.prm",
                    friction = "Specimen/Joints/fault/smooth-joint/Friction coefficient=";
  const auto   sliding       = results_of(folder, scene, {"Output/Snapshots=0"}).series;
  const auto  &time = sliding.column("time"), &way = sliding.column("way"), &down = sliding.column("down");
  const double dip = M_PI / 6, gain = 9.81 * (std::sin(dip) - 0.3 * std::cos(dip));
  for (std::size_t row = sliding.rows() / 2; row < sliding.rows(); ++row)
    {
      CHECK(way[row] == Approx(0.5 * gain * time[row] * time[row]).epsilon(2e-4));
      CHECK(-down[row] == Approx(way[row] * std::sin(dip)).epsilon(2e-4)); // along the joint
    }
  // To the normal of the joint it swings, and friction with it.
  CHECK(sliding.column("speed").back() == Approx(gain * time.back()).epsilon(2e-3));
  CHECK(way.back() == Approx(0.471e-3).epsilon(2e-3)); // as on its page

  std::filesystem::remove_all(folder / "results");
  const auto staying = results_of(folder, scene, {"Output/Snapshots=0", friction + "0.6", "Time/Damping=0.5"}).series;
  CHECK(*std::max_element(staying.column("way").begin(), staying.column("way").end()) < 1e-7);
}

TEST_CASE(
  "The shipped column is as strong as the study of its joint's angle says, and without weak rock as the closed form",
  "[apps][slow]")
{
  const std::string scenes = places::sources() + "/apps/scenes/", joint = "Joint materials/healed/smooth-joint/";
  const auto        table    = postprocess::read_csv_table(scenes + "tables/joint_angles.csv", false);
  const auto        strength = [&](const std::size_t row) {
    const ScratchFolder folder;
    const auto          entry = [&](const std::string &name, const char *column) {
      return name + "=" + std::to_string(table.column(column).at(row));
    };
    return results_of(folder, scenes + "jointed_column.prm",
                             {"Output/Points per snapshot=0", entry("Specimen/Joints/fault/Dip", "dip"),
                       entry("Material/flat-joint/Tensile strength", "tension"),
                       entry("Material/flat-joint/Cohesion", "cohesion"), entry(joint + "Normal stiffness", "normal"),
                       entry(joint + "Shear stiffness", "shear"), entry("Loading/Compression/Strain step", "step")},
                             {"test", "control"})
      .summary["tests"][0]["strength"]["value"]
      .get<double>();
  };
  for (const auto &[row, of_page] : {std::pair<std::size_t, double>{5, 4.91e6}, {9, 7.67e6}, {11, 6.03e6}})
    {
      const double dip         = table.column("dip").at(row) * M_PI / 180,
                   closed_form = 2 * 2e6 / ((1 - 0.4 / std::tan(dip)) * std::sin(2 * dip)), found = strength(row);
      INFO("row " << row << ": " << found << " for " << closed_form);
      CHECK(found == Approx(of_page).epsilon(2e-3));
      if (row >= 7) // of the joint alone
        CHECK(found == Approx(closed_form).epsilon(0.03));
    }
}
