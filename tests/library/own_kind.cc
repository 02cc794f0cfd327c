// A kind of scene of one's own: a model, three functions and a line, and it is read, described, checked and run like the others.
#include "apps/results/life_cycle.h"
#include "apps/results/run_observer.h"
#include "apps/scene/description.h"
#include "apps/scene/kinds/kinds.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/scene_of.h"
#include "apps/scene/section.h"
#include "base/entry_path.h"
#include "base/errors.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A weight on a spring without damping, from rest at its amplitude: x = a cos(omega t), by central differences. */
  struct Oscillator
  {
    double mass = 1, stiffness = 1, amplitude = 1, end_time = 1, steps = 100;

    void check(const base::EntryPath &) const {}
  };

  class OscillatorRun : public apps::RunWork
  {
  public:
    explicit OscillatorRun(const Oscillator &what)
      : model(what)
    {
    }

    void prepare() override
    {
      if (step() * std::sqrt(model.stiffness / model.mass) >= 2)
        throw base::InputError("Oscillator/Steps: too few, the motion would grow without end.");
      place = before = model.amplitude;
    }
    void reopen(const std::filesystem::path &) override {}
    void keep_files(const std::filesystem::path &, bool) override {}
    void begin(const Record &record) override { record(row()); }
    void visit_state(apps::RunState &state) override
    {
      state.group("oscillator");
      state.scalar("taken", taken);
      state.scalar("place", place);
      state.scalar("before", before);
    }
    std::vector<postprocess::SeriesColumn> series_columns() const override { return {{"time", "s"}, {"place", "m"}}; }
    std::string                            size() const override { return "one weight"; }
    std::string                            stage() const override { return "motion"; }
    double                                 done() const override { return time() / model.end_time; }
    std::string                            details() const override { return ""; }
    bool finished() const override { return taken >= static_cast<std::int64_t>(model.steps); }
    void advance(const Record &record) override
    {
      const double push = -model.stiffness * place / model.mass * step() * step();
      const double next = taken == 0 ? place + 0.5 * push : 2 * place - before + push;
      before            = place;
      place             = next;
      ++taken;
      record(row());
    }
    apps::RunFindings findings(const postprocess::CsvTable &series, double) override
    {
      return {{{"figures", {{"last_place", {{"value", series.column("place").back()}, {"unit", "m"}}}}}}, "", nullptr};
    }
    void write_results(const std::filesystem::path &, const postprocess::CsvTable &) override {}

  private:
    double          step() const { return model.end_time / model.steps; }
    double          time() const { return static_cast<double>(taken) * step(); }
    apps::SeriesRow row() const { return {{}, {time(), place}, {}}; }

    Oscillator   model;
    std::int64_t taken = 0;
    double       place = 0, before = 0;
  };

  // What a kind of scene is: entries, and what to do with the model that they fill.
  void declare(apps::Section &root, Oscillator &model)
  {
    using apps::Need;
    using apps::Range;
    apps::Section &s = root.section("Oscillator", "A weight on a spring");
    s.number("Mass", model.mass, "kg", Range::positive(), Need::required).means("Of the weight");
    s.number("Stiffness", model.stiffness, "N/m", Range::positive(), Need::required).means("Of the spring");
    s.number("Amplitude", model.amplitude, "m", Range::positive(), Need::optional).means("At the start, at rest");
    s.number("End time", model.end_time, "s", Range::positive(), Need::optional).means("Of the motion");
    s.number("Steps", model.steps, "-", Range::positive(), Need::optional).means("Until then");
  }

  std::string forecast(const Oscillator &model) { return "  steps        " + std::to_string(model.steps) + "\n"; }

  apps::RunResult run(const Oscillator &model, const apps::RunRequest &request)
  {
    OscillatorRun work(model);
    return apps::LifeCycle(request, 600, work).execute();
  }

  void register_once()
  {
    static const bool done = [] {
      apps::add_scene_kind({"oscillator", "a weight on a spring", apps::make_scene<Oscillator>});
      return true;
    }();
    static_cast<void>(done);
  }

  const char *const scene_text = "set Kind = oscillator\nsubsection Oscillator\n  set Mass = 2\n  set Stiffness = 50\n"
                                 "  set Amplitude = 0.1\n  set End time = 3\nend\n";

  double error_with(const ScratchFolder &folder, const int steps)
  {
    const apps::CheckedScene scene =
      apps::read_scene(folder.file("spring.prm", scene_text), {"Oscillator/Steps=" + std::to_string(steps)});
    apps::RunRequest request = apps::request_of(scene);
    request.output_folder.clear();
    return scene.scene->run(request).figure("last_place").value.value() - 0.1 * std::cos(5.0 * 3);
  }
} // namespace

TEST_CASE("A kind of scene that a program registers is read, described, checked and run like the others", "[apps]")
{
  register_once();
  const ScratchFolder      folder;
  const apps::CheckedScene scene = apps::read_scene(folder.file("spring.prm", scene_text), {});
  CHECK(scene.kind == "oscillator");
  CHECK_THAT(scene.scene->forecast(), Contains("steps"));
  CHECK_THAT(apps::completed_scene(*apps::declare_scene("oscillator").root, apps::Completed::everything),
             Contains("Amplitude"));
  CHECK_THROWS_WITH(apps::read_scene(folder.file("no.prm", "set Kind = oscillator\nsubsection Oscillator\n"
                                                           "  set Mass = -1\n  set Stiffness = 1\nend\n"),
                                     {}),
                    Contains("no.prm") && Contains("Mass"));
  CHECK_THROWS_WITH(apps::read_scene(folder.file("what.prm", "set Kind = oscilator\n"), {}), Contains("oscillator"));

  const double ratio = error_with(folder, 200) / error_with(folder, 400);
  CHECK(std::log2(ratio) == Approx(2).margin(0.05)); // central differences

  apps::RunRequest request = apps::request_of(scene);
  request.output_folder    = folder / "out";
  int rows                 = 0;
  request.stop             = [&rows] { return ++rows > 40; };
  CHECK(scene.scene->run(request).end == apps::RunResult::End::interrupted);
  request.stop            = nullptr;
  request.resume          = true;
  const apps::RunResult b = scene.scene->run(request);
  request.output_folder.clear();
  request.resume = false;
  CHECK(b.series.columns == scene.scene->run(request).series.columns);
  CHECK(std::filesystem::exists(folder / "out/summary.json"));

  CHECK_THROWS_WITH(apps::add_scene_kind({"Coupled", "", apps::make_scene<Oscillator>}), Contains("already"));
}
