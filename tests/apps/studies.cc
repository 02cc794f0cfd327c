// breccia study: a scene with its constants varied, into one table.
#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/curve_reading.h"
#include "apps/studies/study_journal.h"
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <random>
#include <thread>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Two factors of a stack of spheres that is pulled until it breaks, in part of a second. */
  std::string study_of_stack()
  {
    return R"(set Kind       = study
set Base scene = stack.prm
subsection Design
  set Kind = full factorial
end
subsection Factors
  subsection stiffness
    set Entry  = Material/CPM/Normal modulus
    set Levels = 20e9, 30e9
  end
  subsection limit
    set Entry  = Material/CPM/Limit elastic strain
    set Levels = 0.5e-4, 1e-4
  end
end
subsection Responses
  subsection E
    set Figure = young_modulus
  end
  subsection f_t
    set Figure = tensile_strength
  end
end
)";
  }

  void write_study(const ScratchFolder &folder, const std::string &text)
  {
    folder.file("packing.txt", stack_packing());
    std::string scene = replaced(scene_with_file(), "set Grip thickness", "set Tests = tension\n  set Grip thickness");
    folder.file("stack.prm", replaced(scene, "set Snapshots = 5", "set Snapshots = 0"));
    folder.file("study.prm", text);
  }

  /** A process of its own: a study starts its program again for each run. */
  Outcome study(const ScratchFolder &folder, const std::vector<std::string> &options)
  {
    std::vector<std::string> words = {"study", "study.prm"};
    words.insert(words.end(), options.begin(), options.end());
    return Program(folder.path(), words).wait();
  }

  /** By three processes of mpirun; what it says goes to the file "said". @return 0 where it went well */
  /** @param processes what mpirun starts, "-np 3" and the words of each */
  int under_mpirun(const ScratchFolder &folder, const std::string &processes)
  {
    const std::string command = "cd " + folder.path().string() +
                                " && export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 && " +
                                places::mpirun() + " --oversubscribe " + processes + " > said 2>&1";
    return std::system(command.c_str());
  }

  int study_on_ranks(const ScratchFolder &folder, const std::string &options)
  {
    return under_mpirun(folder, "-np 3 " + places::program() + " study study.prm " + options);
  }
} // namespace

TEST_CASE("a study writes one table, the same for any number of processes and parts", "[apps][slow]")
{
  const ScratchFolder folder;
  write_study(folder, study_of_stack());
  const Outcome alone = study(folder, {"-o", "alone", "--processes", "1"});
  INFO(alone.err);
  REQUIRE(alone.status == 0);
  const std::string table = content_of(folder / "alone/table.csv");
  CHECK_THAT(table, Catch::StartsWith("run,stiffness [Pa],limit [-],E [Pa],f_t [Pa]\n1,2e+10,5e-05,") ||
                      Catch::StartsWith("run,stiffness [Pa],limit [-],E [Pa],f_t [Pa]\n1,20000000000,5e-05,"));
  CHECK(std::count(table.begin(), table.end(), '\n') == 5);
  CHECK_THAT(table, !Contains("nan"));
  CHECK_THAT(alone.out, Contains("4 runs, 0 failed"));

  const Outcome second = study(folder, {"-o", "parts", "--part", "2/2", "--processes", "3"});
  CHECK(second.status == 0);
  CHECK_THAT(second.out, Contains("2 of 4 runs are done"));
  CHECK_FALSE(std::filesystem::exists(folder / "parts/table.csv"));
  REQUIRE(study(folder, {"-o", "parts", "--part", "1/2"}).status == 0);
  CHECK(content_of(folder / "parts/table.csv") == table);

  const Outcome again = study(folder, {"-o", "alone"}); // nothing is left to do
  CHECK(again.status == 0);
  CHECK(content_of(folder / "alone/table.csv") == table);

  const Outcome analysed = run(folder.path(), {"analyse", "alone/table.csv", "--response", "f_t", "--factors",
                                               "stiffness,limit", "--model", "anova"});
  CHECK(analysed.status == 0);
}

TEST_CASE(
  "a study killed at fifty random instants ends with the same table to the byte, and repeats no run that is done",
  "[apps][slow]")
{
  const ScratchFolder folder;
  write_study(folder, study_of_stack());
  REQUIRE(study(folder, {"-o", "whole"}).status == 0);
  std::mt19937 stream(11);
  int          kills = 0;
  for (int attempt = 0; kills < 50 && attempt < 400; ++attempt)
    {
      if (std::filesystem::exists(folder / "killed/table.csv")) // all done: once more from the start
        std::filesystem::remove_all(folder / "killed");
      std::vector<std::string> words = {"study", "study.prm", "-o", "killed"};
      if (const auto part = stream() % 3; part > 0) // as jobs of a batch array are
        words.insert(words.end(), {"--part", std::to_string(part) + "/2"});
      Program program(folder.path(), words);
      std::this_thread::sleep_for(std::chrono::milliseconds(stream() % 1000));
      kills += program.running();
      program.send(SIGKILL);
      program.wait();
    }
  REQUIRE(kills == 50);
  const auto                                             journal = folder / "killed/journal";
  std::map<std::string, std::filesystem::file_time_type> before;
  if (std::filesystem::exists(journal))
    for (const auto &entry : std::filesystem::directory_iterator(journal))
      if (entry.path().extension() == ".json")
        before[entry.path()] = std::filesystem::last_write_time(entry);
  REQUIRE((places::skipped_without_mpirun() ? study(folder, {"-o", "killed"}).status :
                                              study_on_ranks(folder, "-o killed")) == 0);
  CHECK(content_of(folder / "killed/table.csv") == content_of(folder / "whole/table.csv"));
  for (const auto &[file, time] : before)
    CHECK(std::filesystem::last_write_time(file) == time);
}

TEST_CASE("a run that fails is a row of the table with its message, and the study goes on", "[apps][slow]")
{
  const ScratchFolder folder;
  write_study(folder, replaced(replaced(study_of_stack(), "Material/CPM/Normal modulus", "Loading/Grip thickness"),
                               "20e9, 30e9", "0.5e-3, 1"));
  const Outcome outcome = study(folder, {"-o", "out"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("4 runs, 2 failed"));
  const std::string table = content_of(folder / "out/table.csv");
  CHECK_THAT(table, Contains("\n3,1,5e-05,nan,nan\n# run 3 failed: ") && Contains("Grip thickness"));
  CHECK_THAT(table, !Contains("\n2,0.0005,0.0001,nan"));
}

TEST_CASE("a study that cannot run is refused before its first run, by entry and run", "[apps]")
{
  const ScratchFolder folder;
  const auto [from, to, said] = GENERATE(table<std::string, std::string, std::string>(
    {{"Material/CPM/Normal modulus", "Material/CPM/Normal moduli", "Normal modul"},
     {"20e9, 30e9", "20e9, -1", "run 3 (Material/CPM/Normal modulus=-1"},
     {"20e9, 30e9", "20e9, much", "\"much\" is no number"},
     {"20e9, 30e9", "2, 2", "2 is there twice"},
     {"set Base scene = stack.prm", "set Base scene = gone.prm", "gone.prm"},
     {"set Base scene = stack.prm", "", "Base scene"},
     {"full factorial", "half factorial", "half factorial"},
     {"full factorial", "orthogonal array\n  set Array = L25", "2 levels for a column of 5"},
     {"full factorial", "orthogonal array\n  set Array = L26", "known are L8"},
     {"full factorial", "Box-Behnken", "Lower"},
     {"full factorial", "table", "Table"},
     {"subsection limit", "subsection f_t", "\"f_t\" names two columns"},
     {"subsection limit", "subsection run", "\"run\" cannot name a column"},
     {"Kind       = study", "Kind = uniaxial", "a study is wanted"}}));
  write_study(folder, replaced(study_of_stack(), from, to));
  const Outcome outcome = run(folder.path(), {"study", "study.prm", "-o", "out"}); // starts no other process
  INFO(to);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(said));
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("a response that no run has is refused before the first run by name, with those that there are", "[apps]")
{
  const ScratchFolder folder;
  const auto [from, to, said, known] = GENERATE(table<std::string, std::string, std::string, std::string>(
    {{"tensile_strength", "tensile_strenght", "response f_t: there is no figure tensile_strenght",
      "Did you mean \"tensile_strength\"?"},
     {"tensile_strength", "compressive_strength", "there is no figure compressive_strength", // it is not crushed
      "Figures: young_modulus, poisson_ratio, section"},
     {"set Figure = tensile_strength", "set Curve = peak\n    set Ordinate = stretch",
      "response f_t: series.csv has no column stretch", "mean_damage"}}));
  write_study(folder, replaced(study_of_stack(), from, to));
  for (const char *command : {"study", "check"})
    {
      const Outcome outcome = run(folder.path(), command == std::string("study") ?
                                                   std::vector<std::string>{command, "study.prm", "-o", "out"} :
                                                   std::vector<std::string>{command, "study.prm"});
      CHECK(outcome.status == 2);
      CHECK_THAT(outcome.err, Contains("study.prm:") && Contains(said) && Contains(known));
    }
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("the folder of another study is refused", "[apps][slow]")
{
  const ScratchFolder folder;
  write_study(folder, replaced(study_of_stack(), "20e9, 30e9", "20e9, 31e9"));
  REQUIRE(study(folder, {"-o", "out", "--part", "1/4"}).status == 0);
  folder.file("study.prm", study_of_stack());
  const Outcome other = study(folder, {"-o", "out"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("holds the runs of another study") && Contains("--restart"));
  CHECK(study(folder, {"-o", "out", "--restart", "--part", "1/4"}).status == 0);
  CHECK(study(folder, {"-o", "out", "--part", "3/2"}).status == 2);
}

TEST_CASE("responses of a study can be read from curves, and a column that no run has is refused by name",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   curves = replaced(study_of_stack(), "    set Figure = young_modulus",
                                        "    set Curve = slope\n    set Test = tension\n    set To = 1e-5");
  write_study(folder, replaced(curves, "    set Figure = tensile_strength",
                               "    set Figure = tensile_strength\n  end\n  subsection peak\n    set Curve = peak\n"
                               "    set Test = tension\n  end\n  subsection beyond\n    set Curve = value\n"
                               "    set Test = tension\n    set To = 10"));
  const Outcome outcome = study(folder, {"-o", "out"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const std::string text = content_of(folder / "out/table.csv");
  CHECK_THAT(text, Catch::StartsWith("run,stiffness [Pa],limit [-],E [Pa],f_t [Pa],peak [Pa],beyond\n"));
  CHECK_THAT(text, Contains("# run 1 has no beyond: the curve does not get as far"));
  const auto table = postprocess::read_csv_table(folder / "out/table.csv", true);
  for (std::size_t run = 0; run < 4; ++run)
    {
      CHECK(table.column("peak")[run] == Approx(table.column("f_t")[run]).epsilon(0.02)); // series have fewer points
      CHECK(std::isnan(table.column("beyond")[run]));
    }
  CHECK(table.column("E")[2] > 1.4 * table.column("E")[0]); // of links half as stiff again

  const std::string page = content_of(folder / "out/report.html");
  CHECK_THAT(page, Contains("data:image/png;base64,iVBORw0KGgo") && Contains("<td class=\"n\">2e+10</td>"));
  CHECK_THAT(page, !Contains("src=\"http") && !Contains("href="));
  CHECK(page.size() < 2000000);

  write_study(folder, replaced(curves, "set Test = tension\n    set To", "set Ordinate = stretch\n    set To"));
  const Outcome other = study(folder, {"-o", "other"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("stretch") && Contains("mean_damage"));
}

TEST_CASE("the page of a study, sent elsewhere without any other file, gives the same table", "[apps][slow]")
{
  const ScratchFolder here, elsewhere;
  write_study(here, study_of_stack());
  REQUIRE(study(here, {"-o", "out", "-s", "Factors/limit/Levels=0.6e-4, 1e-4"}).status == 0);
  elsewhere.file("sent.html", content_of(here / "out/report.html"));
  for (const char *needed : {"packing.txt", "stack.prm", "study.prm"}) // the page has its own
    std::filesystem::remove(here / needed);
  const Outcome again = Program(elsewhere.path(), {"run", "sent.html", "-o", "again"}).wait();
  INFO(again.err);
  REQUIRE(again.status == 0);
  CHECK(content_of(elsewhere / "again/table.csv") == content_of(here / "out/table.csv"));
  CHECK(Program(elsewhere.path(), {"check", "sent.html"}).wait().status == 0);

  const Outcome threads = Program(elsewhere.path(), {"run", "sent.html", "--threads", "2"}).wait();
  CHECK(threads.status == 2);
  CHECK_THAT(threads.err, Contains("Threads per run"));
}

TEST_CASE("the report of one factor at a time has its elasticities", "[apps][slow]")
{
  const ScratchFolder folder;
  std::string         text = replaced(study_of_stack(), "full factorial", "one at a time");
  text = replaced(text, "set Levels = 20e9, 30e9", "set Levels = 20e9, 30e9\n    set Reference = 20e9");
  text = replaced(text, "set Levels = 0.5e-4, 1e-4", "set Levels = 0.5e-4, 1e-4\n    set Reference = 1e-4");
  write_study(folder, text);
  REQUIRE(study(folder, {"-o", "out"}).status == 0);
  const std::string page = content_of(folder / "out/report.html");
  INFO(page.substr(0, 3000));
  const auto of_modulus = [&page](const std::string &factor) {
    const std::string cell = "<td>" + factor + "</td><td class=\"n\">";
    REQUIRE_THAT(page, Contains(cell));
    return std::stod(page.substr(page.find(cell) + cell.size()));
  };
  CHECK(of_modulus("stiffness") == Approx(1).margin(0.01)); // it follows the modulus of the links
  CHECK(of_modulus("limit") == Approx(0).margin(0.01));
}

TEST_CASE("under mpirun each process takes a part of a study, and its runs know nothing of that", "[apps][mpi][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  write_study(folder, study_of_stack());
  REQUIRE(study(folder, {"-o", "alone"}).status == 0);
  const int status = study_on_ranks(folder, "-o ranks");
  INFO(content_of(folder / "said"));
  REQUIRE(status == 0);
  CHECK(content_of(folder / "ranks/table.csv") == content_of(folder / "alone/table.csv"));
  CHECK_THAT(content_of(folder / "said"), Contains("4 runs, 0 failed"));
  std::filesystem::resize_file(folder / "ranks/journal/000001.json", 0); // damaged: only beginning afresh gets over it
  REQUIRE(study_on_ranks(folder, "-o ranks --restart") == 0);
  CHECK(content_of(folder / "ranks/table.csv") == content_of(folder / "alone/table.csv"));
  CHECK(study_on_ranks(folder, "-o ranks --part 1/2") != 0);
  CHECK_THAT(content_of(folder / "said"), Contains("no --part"));
}

TEST_CASE("under mpirun a reason to end is given once, and also where only another process than the first has it",
          "[apps][mpi][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  write_study(folder, study_of_stack());
  const std::string one = "-np 1 " + places::program() + " study study.prm -o parts", reason = "no --part";
  for (const std::string &processes : {one + " --part 1/2 : " + one + " --part 2/2", one + " : " + one + " --part 2/2"})
    {
      CHECK(under_mpirun(folder, processes) != 0);
      const std::string said  = content_of(folder / "said");
      const std::size_t place = said.find(reason);
      INFO(said);
      REQUIRE(place != std::string::npos);
      CHECK(said.find(reason, place + 1) == std::string::npos);
    }
}

TEST_CASE("a part of a study that begins afresh leaves what other parts have begun", "[apps][slow]")
{
  const ScratchFolder   folder;
  apps::StudyPlan       plan, other;
  const apps::RunRecord done;
  plan.text  = "a study";
  other.text = "another";
  {
    const apps::StudyJournal first(folder / "out", plan, 1, 2, false), second(folder / "out", plan, 2, 2, false);
    first.keep(0, done);
    second.keep(1, done);
    std::filesystem::create_directory(folder / "out/runs/000004"); // the second part is at it
    CHECK_THROWS_WITH(apps::StudyJournal(folder / "out", other, 1, 1, true), Contains("another process works"));
    CHECK_THROWS_WITH(apps::StudyJournal(folder / "out", plan, 1, 1, false), Contains("another process works"));
  }
  {
    const apps::StudyJournal first(folder / "out", plan, 1, 2, true);
    CHECK_FALSE(first.find(0));
    CHECK(first.find(1));
    CHECK(std::filesystem::exists(folder / "out/runs/000004"));
  }
  const apps::StudyJournal fresh(folder / "out", other, 1, 1, true);
  CHECK_FALSE(fresh.find(1));
  CHECK_FALSE(std::filesystem::exists(folder / "out/runs/000004"));
}

TEST_CASE("a number that stands for a curve is read from its points in order", "[apps]")
{
  postprocess::CsvTable table;
  table.names   = {"strain", "stress"};
  table.units   = {"-", "Pa"};
  table.columns = {{-1, -2, -4}, {-10, -30, -10}}; // crushed: both are negative
  apps::CurveReading reading;
  const auto         read = [&](const apps::CurveMeasure measure, const double from, const double to) {
    reading.measure = measure;
    reading.from    = from;
    reading.to      = to;
    return apps::read_curve(table, reading);
  };
  using apps::CurveMeasure;
  CHECK(*read(CurveMeasure::peak, 0, 0) == -30);
  CHECK(*read(CurveMeasure::place_of_peak, 0, 0) == -2);
  CHECK(*read(CurveMeasure::value, 0, 3) == Approx(-20));
  CHECK_FALSE(read(CurveMeasure::value, 0, 5));
  CHECK(*read(CurveMeasure::area, 0, 0) == Approx(0.5 * 10 + 20 + 40)); // the work is positive
  CHECK(*read(CurveMeasure::area, 1, 3) == Approx(20 + 25));
  CHECK(*read(CurveMeasure::slope, 1, 2) == Approx(20));
  CHECK_FALSE(read(CurveMeasure::area, 3, 5));
  CHECK(reading.unit_in(table) == "Pa");
  table.units[0]  = "s";
  reading.measure = CurveMeasure::slope;
  CHECK(reading.unit_in(table) == "Pa/s");
}

TEST_CASE("hardening is the part of the peak that is reached after a curve has left its straight beginning", "[apps]")
{
  const double          sign = GENERATE(1.0, -1.0); // crushed: both are negative
  postprocess::CsvTable table;
  table.names = {"strain", "stress"};
  table.units = {"-", "Pa"};
  table.columns.resize(2);
  // Platens are seated up to 1e-4; then a line of 1e4 up to 6, one of a quarter of it up to 9, and down.
  const auto stress_at = [](const double e) {
    return e < 1e-4 ? 0 : e < 7e-4 ? 1e4 * (e - 1e-4) : e < 1.9e-3 ? 6 + 2.5e3 * (e - 7e-4) : 9 - 5e3 * (e - 1.9e-3);
  };
  for (int k = 1; k <= 300; ++k)
    {
      table.columns[0].push_back(sign * k * 1e-5);
      table.columns[1].push_back(sign * stress_at(k * 1e-5));
    }
  apps::CurveReading reading;
  reading.measure = apps::CurveMeasure::hardening;
  // Three quarters of a strain beyond the bend are lag behind the line: 5e-5 at 6.667e-5 beyond, where the stress is 6.1667.
  CHECK(*apps::read_curve(table, reading) == Approx(1 - 6.1667 / 9).margin(0.005));
  reading.offset = 1;
  CHECK(*apps::read_curve(table, reading) == 0);
  CHECK(reading.unit_in(table) == "-");
}

TEST_CASE("check of a study reads every run and says how many there are", "[apps]")
{
  const ScratchFolder folder;
  write_study(folder, study_of_stack());
  const Outcome outcome = run(folder.path(), {"check", "study.prm"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out,
             Contains("4 runs over 2 factors") && Contains("particles") && Contains("altogether   roughly"));
  write_study(folder, replaced(study_of_stack(), "20e9, 30e9", "20e9, -1"));
  CHECK(run(folder.path(), {"check", "study.prm"}).status == 2);
}

TEST_CASE("every design of a study makes its runs", "[apps]")
{
  const ScratchFolder folder;
  const auto [design, more, runs] =
    GENERATE(table<std::string, std::string, std::string>({{"one at a time", "", "3 runs"},
                                                           {"full factorial", "", "4 runs"},
                                                           {"orthogonal array", "  set Array = L9\n", "9 runs"},
                                                           {"central composite", "  set Centres = 3\n", "11 runs"},
                                                           {"Latin hypercube", "  set Runs = 7\n", "7 runs"},
                                                           {"Sobol", "  set Runs = 5\n", "5 runs"},
                                                           {"table", "  set Table = own.csv\n", "2 runs"}}));
  std::string text = replaced(study_of_stack(), "set Kind = full factorial\n", "set Kind = " + design + "\n" + more);
  const bool  box  = design == "central composite" || design == "Latin hypercube" || design == "Sobol";
  const auto  give = [&](const std::string &levels, const std::string &reference, const std::string &bounds) {
    if (box)
      text = replaced(text, "set Levels = " + levels, bounds);
    else if (design == "table")
      text = replaced(text, "set Levels = " + levels, "");
    else if (design == "one at a time")
      text = replaced(text, "set Levels = " + levels, "set Levels = " + levels + "\n set Reference = " + reference);
  };
  give("20e9, 30e9", "20e9", "set Lower = 20e9\n set Upper = 30e9");
  give("0.5e-4, 1e-4", "1e-4", "set Lower = 2e-4\n set Upper = 3e-4");
  write_study(folder, text);
  folder.file("own.csv", "stiffness,limit\n21e9,1e-4\n22e9,2e-4\n");
  const Outcome outcome = run(folder.path(), {"check", "study.prm"});
  INFO(design << outcome.err);
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains(runs + " over 2 factors"));
}

TEST_CASE("Parts of a study that begin at the same moment share one plan", "[apps][studies]")
{
  apps::StudyPlan plan;
  plan.text = std::string(100000, 'x') + "\n";
  for (int round = 0; round < 20; ++round)
    {
      const ScratchFolder      folder;
      std::atomic<int>         refused{0};
      std::vector<std::thread> parts;
      for (int part = 0; part < 4; ++part)
        parts.emplace_back([&, part] {
          try
            {
              apps::StudyJournal(folder / "study", plan, part + 1, 4, false);
            }
          catch (const std::exception &)
            {
              ++refused;
            }
        });
      for (std::thread &part : parts)
        part.join();
      REQUIRE(refused == 0);
      CHECK(content_of(folder / "study/journal/plan.txt") == plan.text);
    }
}
