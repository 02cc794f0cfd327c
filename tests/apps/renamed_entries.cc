// Old names of sections and entries, which scenes may have for one version.
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/overrides.h"
#include "apps/scene/renamed.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::string scenes = places::sources() + "/apps/scenes/";
}

TEST_CASE("A scene with old names is the scene with the present ones, and what has another name is noted", "[apps]")
{
  const ScratchFolder folder;
  const std::string   present = content_of(scenes + "bouncing_sphere.prm");
  folder.file("present.prm", present);
  folder.file("old.prm", replaced(present, "subsection Probes", "subsection gauges"));
  const apps::CheckedScene one = apps::read_scene(folder / "present.prm", {}),
                           old = apps::read_scene(folder / "old.prm", {});
  CHECK(one.notes.empty());
  REQUIRE(old.notes.size() == 1);
  CHECK_THAT(old.notes[0], Contains("old.prm:") && Contains("\"Gauges\" is called \"Probes\" now"));
  CHECK(apps::request_of(old).deciding_text == apps::request_of(one).deciding_text);

  const std::string        impact = "Particles/Impact/";
  const apps::CheckedScene typed =
    apps::read_scene(scenes + "impact_beam.prm", {impact + "Striker radius=0.01", impact + "striker velocities=1, 2"});
  REQUIRE(typed.notes.size() == 2);
  CHECK_THAT(typed.notes[0] + typed.notes[1], Contains("entry \"Striker radius\" is called \"Impactor radius\" now") &&
                                                Contains("\"Impactor velocities\""));
  CHECK(typed.root->find_section("Particles")->find_section("Impact")->find_entry("Impactor radius")->value == "0.01");
}

TEST_CASE("The terminal shows notes of old names, and a run goes on", "[apps]")
{
  const ScratchFolder folder;
  folder.file("old.prm",
              replaced(content_of(scenes + "bouncing_sphere.prm"), "subsection Probes", "subsection Gauges"));
  const Outcome checked = outcome_of(folder, "check", "old.prm", {});
  CHECK(checked.status == 0);
  CHECK_THAT(checked.out, Contains("valid"));
  CHECK_THAT(checked.err, Contains("note: ") && Contains("\"Gauges\" is called \"Probes\" now"));
}

TEST_CASE("Only what had the old name is renamed: not what a scene names so itself", "[apps]")
{
  auto assignments = apps::read_overrides({"Groups/Gauges/Axis=x", "Motion/Striker radius/Velocity x=0",
                                           "Particles/Gauges/force/Group=load", "Gauges/force/Group=load"});
  CHECK(apps::use_present_names(assignments).size() == 2);
  CHECK(assignments[0].path() == "Groups/Gauges/Axis");
  CHECK(assignments[1].path() == "Motion/Striker radius/Velocity x");
  CHECK(assignments[2].path() == "Particles/Probes/force/Group");
  CHECK(assignments[3].path() == "Probes/force/Group");
}

TEST_CASE("Words and columns of before are read in lists and in any case, and nothing else of a value changes",
          "[apps]")
{
  auto assignments = apps::read_overrides(
    {"Handshakes/core/Method=Slaved", "Waves/Methods=absorber p=2, slaved , legacy", "Output/Curve vertical=beam_made",
     "Output/Curve horizontal=core_twice", "Output/Curve vertical=beam_made_by_contacts", "Output/Curve vertical=_made",
     "Groups/slaved/Axis=x", "Waves/Methods=enslaved"});
  CHECK(apps::use_present_names(assignments).size() == 5);
  CHECK(assignments[0].value == "constrained");
  CHECK(assignments[1].value == "absorber p=2, constrained, legacy");
  CHECK(assignments[2].value == "beam_spurious");
  CHECK(assignments[3].value == "core_double_counted");
  CHECK(assignments[4].value == "beam_spurious_of_contacts");
  CHECK(assignments[5].value == "_made");
  CHECK(assignments[6].path() == "Groups/slaved/Axis");
  CHECK(assignments[7].value == "enslaved");
}
