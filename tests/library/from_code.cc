// Models filled by a program, without any text: checked, run, and with the answers of the text that says the same.
#include "apps/results/run_result.h"
#include "apps/runs/particles/run.h"
#include "apps/scene/kinds/read_scene.h"
#include "base/entry_path.h"
#include "tests/apps/scratch_folder.h"
#include "tests/library/ball_in_code.h"

#include <catch2/catch.hpp>

using Catch::Contains;
using library_tests::ball_in_code;

namespace
{
  constexpr const char *ball_in_text = R"(
set Kind = particles
subsection Specimen
  set Source  = none
  set Density = 2500
end
subsection More particles
  subsection ball
    set Centre = 0, 0, 0.0101
    set Radius = 0.01
  end
end
subsection Material
  set Law = hertz-mindlin
  subsection hertz-mindlin
    set Young modulus        = 1e9
    set Poisson ratio        = 0.25
    set Friction coefficient = 0.3
    set Restitution          = 0.9
  end
end
subsection Walls
  subsection floor
    set Law = hertz-mindlin
    subsection hertz-mindlin
      set Young modulus        = 1e9
      set Poisson ratio        = 0.25
      set Friction coefficient = 0.3
      set Restitution          = 0.9
    end
  end
end
subsection Initial velocity
  subsection ball
    set Velocity x = 0.5
    set Velocity z = -1
  end
end
subsection Probes
  subsection height
    set Quantity  = position
    set Group     = ball
    set Component = z
  end
end
subsection Time
  set End time    = 1e-3
  set Step factor = 0.1
  set Damping     = 0
end
subsection Output
  set Samples   = 50
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("scene that a program has filled runs to the bits of the text that says the same", "[library]")
{
  const apps_tests::ScratchFolder folder;
  const apps::CheckedScene        text    = apps::read_scene(folder.file("ball.prm", ball_in_text), {});
  apps::RunRequest                in_text = apps::request_of(text);
  in_text.output_folder.clear();
  const apps::RunResult by_text = text.scene->run(in_text);

  const apps::ParticlesModel model = ball_in_code();
  REQUIRE_NOTHROW(model.check({}));
  const apps::RunResult by_code = run(model, apps::RunRequest());
  CHECK(by_code.series.names == by_text.series.names);
  CHECK(by_code.series.columns == by_text.series.columns);
  CHECK(by_code.series.columns.front().size() == 51);
}

TEST_CASE("model that a program has filled is refused by the entry, as a text is by its line", "[library]")
{
  apps::ParticlesModel model      = ball_in_code();
  model.walls.walls.front().shape = apps::WallSection::Shape::box;
  model.walls.walls.front().lower = {0, 0, 0};
  model.walls.walls.front().upper = {1, 0, 1};
  CHECK_THROWS_WITH(model.check({}), "Walls/floor/Upper: each coordinate must be above that of Lower.");
  try
    {
      model.check({});
    }
  catch (const base::EntryError &refused)
    {
      CHECK(refused.sections == std::vector<std::string>{"Walls", "floor"});
      CHECK(refused.entry == "Upper");
    }
  model = ball_in_code();
  model.more.added.clear();
  CHECK_THROWS_WITH(model.check({}), Contains("Specimen/Source: there is no particle at all"));
  model                                           = ball_in_code();
  model.initial_velocity.velocities.front().group = "bal";
  CHECK_THROWS_WITH(model.check({}), Contains("Initial velocity/bal: must be named after a group") && Contains("ball"));

  const apps_tests::ScratchFolder folder;
  const std::string               file = folder.file("ball.prm", ball_in_text);
  CHECK_THROWS_WITH(
    apps::read_scene(file, {"Walls/floor/Shape=box", "Walls/floor/Lower=0, 0, 0", "Walls/floor/Upper=1, 0, 1"}),
    Contains("command line: Walls/floor/Upper = 1, 0, 1: each coordinate must be above"));
}
