// What a run returns: in memory what its files say, with or without files, several times in a process and at a time.
#include "apps/process/exit_status.h"
#include "apps/process/mpi_session.h"
#include "apps/results/run_observer.h"
#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"
#include "base/errors.h"
#include "dem/specimen/specimen.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <thread>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A stack of spheres that is pulled until it breaks, in about a second. */
  apps::CheckedScene stack(const ScratchFolder &folder, const std::vector<std::string> &changes = {})
  {
    folder.file("packing.txt", stack_packing());
    std::vector<std::string> all = {"Loading/Tests=tension", "Output/Samples=40", "Output/Snapshots=0"};
    all.insert(all.end(), changes.begin(), changes.end());
    return apps::read_scene(folder.file("stack.prm", scene_with_file()), all);
  }

  apps::RunRequest without_files(const apps::CheckedScene &scene)
  {
    apps::RunRequest request = apps::request_of(scene);
    request.output_folder.clear();
    return request;
  }

  bool same(const postprocess::CsvTable &a, const postprocess::CsvTable &b)
  {
    return a.names == b.names && a.units == b.units && a.columns == b.columns && a.words == b.words;
  }

  /** All that does not hang on the clock or on the file. */
  nlohmann::json lasting(nlohmann::json summary)
  {
    for (const char *part : {"cost", "tests", "scene"})
      summary.erase(part);
    return summary;
  }

  /** Notes the calls and keeps the rows. */
  class Listener : public apps::RunObserver
  {
  public:
    void prepares() override { calls.emplace_back("prepares"); }
    void begins(const apps::RunOutline &outline) override
    {
      calls.emplace_back("begins");
      rows = apps::empty_series(outline.columns, "");
      size = outline.size;
    }
    void stage(const std::string &name) override { calls.push_back(name); }
    void row(const apps::SeriesRow &row) override { apps::append(rows, row); }
    void progress(const double part, const std::string &) override
    {
      backwards = backwards || part < done;
      done      = part;
    }
    void ends(const apps::RunResult &result) override
    {
      calls.emplace_back("ends");
      at_end = result.series;
    }

    std::vector<std::string> calls;
    postprocess::CsvTable    rows, at_end;
    std::string              size;
    double                   done      = 0;
    bool                     backwards = false;
  };
} // namespace

TEST_CASE("A run returns what its files say, and writes none unless they are requested", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene   = stack(folder);
  apps::RunRequest         request = apps::request_of(scene);
  request.output_folder            = folder / "out";
  const apps::RunResult with       = scene.scene->run(request);
  const auto            before     = std::distance(std::filesystem::recursive_directory_iterator(folder / ""), {});
  const apps::RunResult without    = scene.scene->run(without_files(scene));
  CHECK(std::distance(std::filesystem::recursive_directory_iterator(folder / ""), {}) == before);

  CHECK(with.exit_status() == apps::exit_success);
  CHECK(with.folder == folder / "out");
  CHECK(without.folder.empty());
  CHECK(same(with.series, without.series));
  CHECK(same(with.series, postprocess::read_csv_table(folder / "out/series.csv", true, {"test"})));
  CHECK(with.series.words[0] == std::vector<std::string>(with.series.rows(), "tension"));
  CHECK(lasting(with.summary) == lasting(without.summary));
  CHECK(with.summary == nlohmann::json::parse(content_of(folder / "out/summary.json")));
  CHECK(without.balance_error().value() < 1e-3);
  REQUIRE(without.specimen);
  CHECK(static_cast<double>(without.specimen->counts().broken) == without.series.column("broken_links").back());
}

TEST_CASE("Figures of a result have their value and unit, or the reason why there is none", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene whole = stack(folder);
  const apps::RunResult    found = whole.scene->run(without_files(whole));
  const apps::Figure       E     = found.figure("young_modulus");
  CHECK(E.value.value() == found.summary["figures"]["young_modulus"]["value"].get<double>());
  CHECK(E.unit == "Pa");
  CHECK(E.not_determined.empty());
  CHECK(std::count(E.unit.begin(), E.unit.end(), 'P') == 1);
  CHECK_THROWS_WITH(found.figure("youngs_modulus"), Contains("young_modulus") && Contains("there is no figure"));
  const std::vector<std::string> names = found.figures();
  CHECK(std::count(names.begin(), names.end(), "tensile_strength") == 1);

  const apps::CheckedScene early   = stack(folder, {"Loading/Tension/Stop strain=2e-5"}); // far before the peak
  const apps::Figure       nothing = early.scene->run(without_files(early)).figure("tensile_strength");
  CHECK_FALSE(nothing.value);
  CHECK(nothing.unit == "Pa");
  CHECK_THAT(nothing.not_determined, Contains("may be passed yet"));
}

TEST_CASE("Observers follow a run in order, with every row", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene   = stack(folder);
  apps::RunRequest         request = without_files(scene);
  Listener                 first, second;
  request.observers            = {&first, &second};
  const apps::RunResult result = scene.scene->run(request);
  CHECK(first.calls == std::vector<std::string>{"prepares", "begins", "tension", "results", "ends"});
  CHECK(first.calls == second.calls);
  CHECK(first.size == "175 particles, 1094 links");
  CHECK_FALSE(first.backwards);
  CHECK(first.rows.rows() > 10);
  CHECK(same(first.rows, result.series));
  CHECK(same(first.at_end, result.series));
}

TEST_CASE("A scene runs again in a process, and two at a time in threads of it, to the same bits", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene = stack(folder), other = stack(folder, {"Material/CPM/Cohesion=2e6"});
  const apps::RunResult first = scene.scene->run(without_files(scene)), again = scene.scene->run(without_files(scene)),
                        apart = other.scene->run(without_files(other));
  CHECK(same(first.series, again.series));
  CHECK_FALSE(same(first.series, apart.series));

  apps::RunResult a, b;
  std::thread     one([&] { a = scene.scene->run(without_files(scene)); }),
    two([&] { b = other.scene->run(without_files(other)); });
  one.join();
  two.join();
  CHECK(same(a.series, first.series));
  CHECK(same(b.series, apart.series));
}

TEST_CASE("A run stops where its request says so, and only that run, and goes on to the same bits", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene   = stack(folder);
  const apps::RunResult    whole   = scene.scene->run(without_files(scene));
  apps::RunRequest         request = apps::request_of(scene);
  request.output_folder            = folder / "out";
  Listener listener;
  request.observers = {&listener};
  request.stop      = [&listener] { return listener.rows.rows() >= 5; };

  apps::RunResult stopped, beside;
  std::thread     one([&] { stopped = scene.scene->run(request); }),
    two([&] { beside = scene.scene->run(without_files(scene)); });
  one.join();
  two.join();
  CHECK(stopped.end == apps::RunResult::End::interrupted);
  CHECK(stopped.exit_status() == apps::exit_interrupted);
  CHECK(stopped.stage == "tension");
  CHECK_THAT(stopped.go_on, Contains("--resume"));
  CHECK(stopped.summary.is_null());
  CHECK(stopped.series.rows() == 5);
  CHECK(beside.end == apps::RunResult::End::complete);
  CHECK(same(beside.series, whole.series));

  request.stop         = nullptr;
  request.resume       = true;
  const auto completed = scene.scene->run(request);
  CHECK(same(completed.series, whole.series)); // those from before the stop, too
  CHECK(lasting(completed.summary) == lasting(whole.summary));
}

TEST_CASE("A run without a folder that is stopped says so, and cannot be resumed", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene   = stack(folder);
  apps::RunRequest         request = without_files(scene);
  request.stop                     = [] { return true; };
  const apps::RunResult stopped    = scene.scene->run(request);
  CHECK(stopped.end == apps::RunResult::End::interrupted);
  CHECK(stopped.go_on.empty());
  request.resume = true;
  CHECK_THROWS_WITH(scene.scene->run(request), Contains("without a folder"));
}

TEST_CASE("Every kind of scene returns its figures and writes nothing where no files are requested", "[apps]")
{
  apps::start_mpi();
  struct Case
  {
    const char              *scene;
    std::vector<std::string> changes;
    const char              *figure; ///< that it must find; "": it has a summary
  };
  const std::vector<Case> cases = {
    {"bouncing_sphere", {"Time/End time=0.02"}, "height/end"},
    {"hertz_impact", {"Time/End time=2e-6"}, "broken_links"},
    {"cantilever", {}, "largest_displacement"},
    {"wave_transmission", {"Waves/Methods=strict", "Waves/Wavelengths=0.96"}, ""},
    {"homogenisation_sweep",
     {"Homogenisation/Particles=100", "Homogenisation/Seeds=1", "Homogenisation/Interaction ratios=1.5",
      "Homogenisation/Shear ratios=0.2"},
     ""},
  };
  const std::filesystem::path here = std::filesystem::current_path();
  for (const Case &one : cases)
    {
      INFO(one.scene);
      const ScratchFolder folder;
      std::filesystem::current_path(folder / "");
      const apps::CheckedScene scene =
        apps::read_scene(places::sources() + "/apps/scenes/" + one.scene + ".prm", one.changes);
      const apps::RunResult result = scene.scene->run(without_files(scene));
      CHECK(std::filesystem::is_empty(folder / ""));
      std::filesystem::current_path(here);
      CHECK(result.end == apps::RunResult::End::complete);
      CHECK(result.summary.is_object());
      if (*one.figure != '\0')
        CHECK(result.figure(one.figure).value);
    }
}
