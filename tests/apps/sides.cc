// Names of sides: by axis, and "top" where there is weight; couplings that nothing leads to.
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A ball above a block that is held at one side; weight along z. */
  const std::string ball_on_block = R"(set Kind = coupled
subsection Continuum
  subsection Model
    set Dimension = 3
  end
  subsection Mesh
    set Source = box
    subsection Box
      set Size = 0.1, 0.1, 0.02
    end
  end
  subsection Materials
    subsection solid
      set Law     = isotropic elastic
      set Density = 2400
      subsection isotropic elastic
        set Young modulus = 1e9
        set Poisson ratio = 0.2
      end
    end
  end
  subsection Boundary conditions
    subsection z min
      set Displacement x = 0
      set Displacement y = 0
      set Displacement z = 0
    end
  end
end
subsection Particles
  subsection Specimen
    set Source  = none
    set Density = 2500
  end
  subsection More particles
    subsection ball
      set Centre = 0.05, 0.05, 0.0301
      set Radius = 0.01
    end
  end
  subsection Material
    set Law = linear
    subsection linear
      set Effective modulus = 1e7
    end
  end
end
subsection Couplings
  subsection block
    set Boundary          = z max
    set Effective modulus = 1e7
  end
end
subsection Gravity
  set Acceleration = 0, 0, -9.81
end
subsection Time
  set End time = 6e-3
end
subsection Output
  set Samples   = 20
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("A side by its axis is the side by its word, and holds and couples as that does", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", ball_on_block);
  const Results by_axis = results_of(folder, "x.prm");
  CHECK(by_axis.summary["figures"]["peak_force"]["value"].get<double>() > 0);
  std::filesystem::remove_all(folder / "results");
  folder.file("words.prm", replaced(replaced(ball_on_block, "z min", "back"), "z max", "front"));
  const Results by_word = results_of(folder, "words.prm");
  CHECK(by_axis.series.columns == by_word.series.columns);
}

TEST_CASE("A side that has two sections, by its word and by its axis, is refused: their loads would add up",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", ball_on_block);
  is_refused(folder, "x.prm", {"Continuum/Boundary conditions/back/Displacement x=0"},
             "Boundary conditions/z min: the same side as back, which has a section, too.");
}

TEST_CASE("A side \"top\" that is not the upper side is refused where there is weight, with what may be meant",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", ball_on_block);
  is_refused(
    folder, "x.prm", {"Couplings/block/Boundary=top"},
    "Couplings/block/Boundary = top: \"top\" is the side of most y, and the weight acts along -z. Say \"y max\" "
    "if that is meant, or \"z max\" for the upper side.");
  folder.file("held.prm", replaced(ball_on_block, "z min", "bottom"));
  is_refused(
    folder, "held.prm", {},
    "Boundary conditions/bottom: \"bottom\" is the side of least y, and the weight acts along -z. Say \"y min\" "
    "if that is meant, or \"z min\" for the lower side.");
  // Without weight nothing is up.
  CHECK(outcome_of(folder, "check", "held.prm", {"Gravity/Acceleration=0, 0, 0"}).status == 0);
  folder.file("along_y.prm", replaced(replaced(ball_on_block, "z min", "bottom"), "z max", "top"));
  CHECK(outcome_of(folder, "check", "along_y.prm", {"Gravity/Acceleration=0, -9.81, 0"}).status == 0);
  is_refused(folder, "along_y.prm", {"Gravity/Acceleration=0, 9.81, 0"}, "or \"y max\" for the lower side");
}

TEST_CASE("check warns of a coupling that neither weight nor velocity leads its particles to", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", ball_on_block);
  const auto check = [&](const std::vector<std::string> &changes) {
    const Outcome found = outcome_of(folder, "check", "x.prm", changes);
    INFO(found.err);
    CHECK(found.status == 0);
    return found.out;
  };
  const std::string warning =
    "warning      coupling block: neither the weight nor a velocity leads its particles to Boundary = ";
  CHECK_THAT(check({}), !Contains(warning));
  CHECK_THAT(check({"Couplings/block/Boundary=y max"}), Contains(warning + "y max"));
  CHECK_THAT(check({"Couplings/block/Boundary=z min"}), Contains(warning + "z min"));
  CHECK_THAT(check({"Gravity/Acceleration=0, 0, 9.81"}), Contains(warning + "z max"));
  CHECK_THAT(check({"Gravity/Acceleration=0, 0, 0"}), Contains(warning + "z max"));
  CHECK_THAT(check({"Gravity/Acceleration=0, 0, 0", "Particles/Initial velocity/ball/Velocity z=-1"}),
             !Contains(warning));
  // Below the face, and falling away from it.
  CHECK_THAT(check({"Particles/More particles/ball/Centre=0.05, 0.05, -0.02"}), Contains(warning + "z max"));
}

TEST_CASE("check warns of a coupling out of reach beside motions and forces that are 0, and not beside those that lead",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm",
              replaced(ball_on_block, "  subsection More particles\n",
                       "  subsection More particles\n    subsection other\n      set Centre = 0.02, 0.02, 0.1\n"
                       "      set Radius = 0.01\n    end\n") +
                "subsection Particles\n  subsection Motion\n    subsection ball\n      set Velocity x = 0\n"
                "      set Velocity y = 0\n    end\n  end\nend\n");
  const auto warns = [&](std::vector<std::string> changes) {
    changes.insert(changes.end(), {"Couplings/block/Groups=ball", "Couplings/block/Boundary=y max"});
    const Outcome found = outcome_of(folder, "check", "x.prm", changes);
    INFO(found.err);
    REQUIRE(found.status == 0);
    return found.out.find("warning      coupling block: neither the weight nor a velocity") != std::string::npos;
  };
  CHECK(warns({}));
  CHECK(warns({"Particles/Forces/ball/Force x=0"}));
  CHECK(warns({"Particles/Motion/other/Velocity y=-1"})); // of another particle, which nothing joins to it
  CHECK(!warns({"Particles/Motion/ball/Velocity y=-1"}));
  CHECK(!warns({"Particles/Motion/ball/Velocity y=-t"}));
  CHECK(!warns({"Particles/Forces/ball/Force z=-1"}));
  CHECK(!warns({"Particles/Motion/other/Velocity y=-1", "Particles/More particles/other/Centre=0.05, 0.06, 0.0474"}));
  CHECK_THAT(run(folder.path(), {"check", places::scene("hertz_impact.prm"), "-s", "Couplings/top/Boundary=y max"}).out,
             Contains("warning      coupling top: neither the weight nor a velocity leads its particles to Boundary"));
}

TEST_CASE("A particle that begins in a coupled side is refused by the coupling's name, and not as at a wall",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", ball_on_block);
  is_refused(folder, "x.prm", {"Particles/More particles/ball/Centre=0.05, 0.05, 0.022"},
             "surface block: particle 1 at ( 0.05  0.05 0.022) m lies in it by 0.008 m");
}
