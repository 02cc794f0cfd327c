// Runs of scenes that are coupled with other programs, against a double of preCICE in this process.
#include "apps/process/mpi_session.h"
#include "apps/results/run_result.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/particles/run.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/scene_of.h"
#include "base/errors.h"
#include "tests/apps/scratch_folder.h"
#include "tests/coupling/precice_double.h"
#include "tests/library/ball_in_code.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace apps_tests;
using Catch::Contains;
using precice_double::Course;
using precice_double::Values;

namespace
{
  const std::string scenes = places::sources() + "/apps/scenes/";

  apps::PreciceSection section_with(Course &course, const std::string &vertices)
  {
    apps::PreciceSection section;
    section.participant   = "Breccia";
    section.configuration = "precice-config.xml";
    section.mesh          = "Mesh";
    section.vertices      = vertices;
    section.join          = [&course](const std::string &, const std::string &) {
      return std::make_unique<precice_double::Double>(course);
    };
    return section;
  }

  constexpr double period = 1e-3, omega = 2 * M_PI / period, speed = 0.5; // [s, 1/s, m/s]

  /** A ball at 0.5 m/s along x, with no floor below; a row of the series every hundredth of a millisecond. */
  apps::ParticlesModel swinging_ball(Course &course)
  {
    apps::ParticlesModel model = library_tests::ball_in_code();
    model.walls.walls.clear();
    model.initial_velocity.velocities.front().velocity[2] = {};
    model.probes.probes.front().component                 = apps::ProbeSection::Component::x;
    model.output.samples                                  = 100;
    model.precice                                         = section_with(course, "ball");
    model.precice.reads.force                             = "Force";
    model.precice.writes.displacement                     = "Displacement";
    return model;
  }

  /** The other code is a spring. @param iterations of each window */
  Course spring(const int iterations)
  {
    const double mass = 2500 * 4.0 / 3.0 * M_PI * std::pow(library_tests::radius, 3);
    Course       course;
    course.answer = [mass](const Values &data, double) {
      return Values{{"Force", {-mass * omega * omega * data.at("Displacement")[0], 0, 0}}};
    };
    course.readable   = {{"Force", {0, 0, 0}}};
    course.window     = period / 400;
    course.end        = 0.5 * period;
    course.iterations = iterations;
    return course;
  }
} // namespace

TEST_CASE("run of particles on the spring of another program swings as in closed form, and ends with it", "[library]")
{
  Course                     course = spring(1);
  const apps::ParticlesModel model  = swinging_ball(course);
  REQUIRE_NOTHROW(model.check({}));
  const apps::RunResult      result = run(model, apps::RunRequest());
  const std::vector<double> &time = result.series.column("time"), &place = result.series.column("height");
  REQUIRE(time.size() == 51); // of 100 up to the end time
  CHECK(time.back() == Approx(0.5 * period).epsilon(1e-9));
  for (std::size_t row = 0; row < time.size(); ++row)
    CHECK(place[row] == Approx(speed / omega * std::sin(omega * time[row])).margin(1e-4 * speed / omega));
  CHECK(result.summary["ended_by"] == "coupling");
  CHECK(result.summary["cost"]["windows"] == 200);
  CHECK(result.warnings().empty());
  CHECK(course.finalized);
}

TEST_CASE("coupled run of particles that was stopped goes on, with the other program, to the same bits", "[library]")
{
  const ScratchFolder   folder;
  Course                at_once = spring(3), in_two = spring(3);
  const apps::RunResult whole = run(swinging_ball(at_once), apps::RunRequest());
  apps::RunRequest      request;
  request.output_folder       = folder / "out";
  request.stop                = [&in_two] { return in_two.windows.size() >= 77; };
  const apps::RunResult first = run(swinging_ball(in_two), request);
  CHECK(first.end == apps::RunResult::End::interrupted);
  CHECK_FALSE(in_two.finalized);
  request.stop              = nullptr;
  request.resume            = true;
  const apps::RunResult end = run(swinging_ball(in_two), request);
  CHECK(end.series.columns == whole.series.columns);
  CHECK(end.summary["cost"]["iterations"] == 600);
  CHECK(at_once.places == in_two.places); // where the ball was at the start of all
}

TEST_CASE("run that ends before its coupling does so with a warning", "[library]")
{
  Course               course  = spring(1);
  apps::ParticlesModel model   = swinging_ball(course);
  model.end_time               = 0.2 * period;
  const apps::RunResult result = run(model, apps::RunRequest());
  REQUIRE(result.warnings().size() == 1);
  CHECK_THAT(result.warnings().front(), Contains("the run ended at 0.0002 s, before the coupling"));
  CHECK(result.summary["ended_by"] == "end time");
}

TEST_CASE("participant of preCICE is one process: several are refused before the others are met", "[library]")
{
  struct TwoRanks // as mpirun says it
  {
    TwoRanks() { ::setenv("OMPI_COMM_WORLD_SIZE", "2", 1); }
    ~TwoRanks() { ::unsetenv("OMPI_COMM_WORLD_SIZE"); }
  };
  Course                     course = spring(1);
  const apps::ParticlesModel model  = swinging_ball(course);
  const TwoRanks             two;
  std::string                said;
  try
    {
      run(model, apps::RunRequest());
    }
  catch (const base::InputError &refusal)
    {
      said = refusal.what();
    }
  CHECK_THAT(said, Contains("a participant is one process, and mpirun has started 2"));
  CHECK(course.windows.empty());
}

TEST_CASE("run of a rod whose end another program leads takes rho c v A there, and twice that at its support",
          "[library]")
{
  apps::start_mpi();
  const ScratchFolder folder;
  constexpr double    lead = 2; // [m/s]
  const auto          rod  = [&](Course &course, const std::string &boundary) {
    apps::CheckedScene scene = apps::read_scene(
                scenes + "bar_impact.prm",
                {"Mesh/Source=box", "Mesh/Box/Size=0.5, 0.02, 0.02", "Mesh/Box/Divisions x=100", "Mesh/Refinements=0",
       "Motion/Initial velocity x=", "Materials/solid/isotropic elastic/Poisson ratio=0", "Output/Snapshots=0",
       "Output/Samples=150"});
    // Its text cannot say by what double of preCICE the others are met.
    auto &model =
      const_cast<apps::ContinuumModel &>(dynamic_cast<apps::SceneOf<apps::ContinuumModel> &>(*scene.scene).model());
    model.precice                = section_with(course, boundary);
    model.precice.reads.velocity = "Velocity";
    model.precice.writes.force   = "Force";
    course.answer                = [&course](const Values &, double) {
      Values values{{"Velocity", {}}};
      for (std::size_t k = 0; k < course.places.size(); k += 3)
        values["Velocity"].insert(values["Velocity"].end(), {lead, 0, 0});
      return values;
    };
    course.window   = 2e-6;
    course.end      = 2.4e-4;
    course.readable = {{"Velocity", std::vector<double>(3 * 1000, 0.0)}}; // of the first window
    for (std::size_t k = 0; k < 3000; k += 3)
      course.readable["Velocity"][k] = lead;
    return scene;
  };
  Course                   course;
  const apps::CheckedScene scene   = rod(course, "right");
  apps::RunRequest         request = apps::request_of(scene);
  request.output_folder.clear();
  const apps::RunResult whole = scene.scene->run(request);
  CHECK(whole.summary["ended_by"] == "coupling");
  double force = 0;
  for (std::size_t w = 10; w < 50; ++w) // before the wave is at the support, L/c = 0.099 ms
    for (std::size_t k = 0; k < course.places.size(); k += 3)
      force += course.windows[w].written.at("Force")[k] / 40;
  const std::vector<double> &time = whole.series.column("time"), &reaction = whole.series.column("reaction_left_x");
  double                     mean = 0, count = 0;
  for (std::size_t row = 0; row < time.size(); ++row)
    if (time[row] > 1.4e-4)
      {
        mean += reaction[row];
        ++count;
      }
  CHECK(mean / count == Approx(2 * force).epsilon(0.02));
  CHECK(force == Approx(-std::sqrt(200e9 * 7850) * lead * 0.02 * 0.02).epsilon(0.01));

  Course     in_two;
  const auto again      = rod(in_two, "right");
  request.output_folder = folder / "out";
  request.stop          = [&in_two] { return in_two.windows.size() >= 31; };
  CHECK(again.scene->run(request).end == apps::RunResult::End::interrupted);
  request.stop   = nullptr;
  request.resume = true;
  CHECK(again.scene->run(request).series.columns == whole.series.columns);

  Course     held;
  const auto refused = rod(held, "left");
  request.output_folder.clear();
  request.resume = false;
  CHECK_THROWS_WITH(refused.scene->run(request),
                    Contains("preCICE/Boundary") && Contains("left has nodes whose displacement"));
}

TEST_CASE("scene that couples is refused where there is no preCICE, and one that couples what cannot be by the entry",
          "[library]")
{
  Course               course = spring(1);
  apps::ParticlesModel model  = swinging_ball(course);
  model.precice.vertices      = "bal";
  CHECK_THROWS_WITH(model.check({}), Contains("preCICE/Group") && Contains("ball"));
  model                     = swinging_ball(course);
  model.precice.reads.force = "";
  CHECK_THROWS_WITH(model.check({}), Contains("preCICE: the mesh reads nothing"));
  model              = swinging_ball(course);
  model.precice.join = {};
  CHECK_THROWS_WITH(model.check({}), Contains("preCICE/Participant: this program was built without preCICE"));
  if (!coupling::precice_library())
    CHECK_THROWS_WITH(
      apps::read_scene(scenes + "bouncing_sphere.prm",
                       {"preCICE/Participant=Ball", "preCICE/Configuration=c.xml", "preCICE/Mesh=M",
                        "preCICE/Group=all", "preCICE/Read force=Force", "preCICE/Write displacement=Displacement"}),
      Contains("command line: preCICE/Participant = Ball: this program was built without preCICE"));
}
