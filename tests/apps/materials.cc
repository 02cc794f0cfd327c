// Scenes of several materials.
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string cpm(const double modulus, const char *more = "")
  {
    std::ostringstream text;
    text << "    set Law = CPM\n    subsection CPM\n      set Normal modulus       = " << modulus
         << "\n      set Shear ratio          = 0.2\n      set Limit elastic strain = 1e-4\n"
            "      set Relative ductility   = 30\n      set Cohesion             = 3e6\n"
            "      set Friction coefficient = 0.8\n"
         << more << "    end\n";
    return text.str();
  }

  std::string materials(const std::string &first, const std::string &second)
  {
    return "subsection Materials\n  subsection mortar\n" + first + "  end\n  subsection aggregate\n" + second +
           "  end\nend\n";
  }

  /** The middle of stack_packing(), 25 of its 175 spheres. */
  const char *const middle_layer = "subsection Regions\n  subsection layer\n    set Material = aggregate\n"
                                   "    set Shape    = box\n    set Lower    = -1, -1, 4e-3\n"
                                   "    set Upper    = 1, 1, 6e-3\n  end\nend\n";

  /** scene_with_file() with these sections in place of Material. */
  std::string scene_of(const std::string &sections)
  {
    std::string scene = scene_with_file();
    const auto  begin = scene.find("subsection Material"), end = scene.find("subsection Loading");
    return scene.replace(begin, end - begin, sections);
  }

  std::string two_materials() { return scene_of(materials(cpm(25e9), cpm(75e9)) + middle_layer); }

  /** stack_packing() with a column of materials: the layer of middle_layer is of the second. */
  std::string stack_with_column(const std::string &second = "aggregate")
  {
    std::istringstream lines(stack_packing());
    std::string        text, line;
    std::getline(lines, line);
    text = "x y z radius material\n";
    for (int i = 0; std::getline(lines, line); ++i)
      text += line + (i / 25 == 3 ? " " + second : " mortar") + "\n";
    return text;
  }

  /** Everything that a run of the two tests leaves and that must not depend on how the materials were given. */
  std::string figures_of(const std::filesystem::path &results)
  {
    return content_of(results / "series.csv") + listing_of(results / "tension_particles") +
           listing_of(results / "compression_links");
  }

  std::string refusal(const std::string &packing, const std::string &scene, const std::string &command = "run")
  {
    const ScratchFolder folder;
    folder.file("packing.txt", packing);
    folder.file("x.prm", scene);
    std::vector<std::string> arguments = {command, "x.prm"};
    if (command == "run")
      arguments.insert(arguments.end(), {"-o", "results"});
    const Outcome outcome = run(folder.path(), arguments);
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "results"));
    return outcome.err;
  }
} // namespace

TEST_CASE("Regions and a column of the packing say the same of a specimen's materials", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("regions.prm", two_materials());
  REQUIRE(run(folder.path(), {"run", "regions.prm", "-o", "regions"}).status == 0);
  folder.file("packing.txt", stack_with_column());
  folder.file("column.prm", scene_of(materials(cpm(25e9), cpm(75e9))));
  REQUIRE(run(folder.path(), {"run", "column.prm", "-o", "column"}).status == 0);
  CHECK(figures_of(folder / "regions") == figures_of(folder / "column"));

  const auto summary = nlohmann::json::parse(content_of(folder / "regions/summary.json"));
  REQUIRE(summary["materials"].size() == 2);
  CHECK(summary["materials"][0] == nlohmann::json({{"name", "mortar"}, {"particles", 150}}));
  CHECK(summary["materials"][1] == nlohmann::json({{"name", "aggregate"}, {"particles", 25}}));
  REQUIRE(summary["material_pairs"].size() == 3);
  std::size_t links = 0;
  for (const auto &pair : summary["material_pairs"])
    {
      CHECK(pair["links"] > 0);
      links += pair["links"].get<std::size_t>();
    }
  CHECK(links == summary["cost"]["links"]);
  CHECK(summary["material_pairs"][1]["materials"] == nlohmann::json({"mortar", "aggregate"}));
  CHECK(summary["energy"]["balance_error"] < 1e-3);

  const std::string checked = run(folder.path(), {"check", "column.prm"}).out;
  CHECK_THAT(checked, Contains("particles of mortar 150, aggregate 25") && Contains("mortar-aggregate "));
  CHECK_THAT(listing_of(folder / "column/tension_particles"), Contains("Name=\"material\""));
  CHECK_THAT(listing_of(folder / "column/tension_links"), Contains("Name=\"material_pair\""));
}

TEST_CASE("One material given as a list of two equal ones gives the figures of one, and no more files", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("one.prm", scene_with_file());
  folder.file("two.prm", scene_of(materials(cpm(25e9), cpm(25e9)) + middle_layer));
  REQUIRE(run(folder.path(), {"run", "one.prm", "-o", "one"}).status == 0);
  REQUIRE(run(folder.path(), {"run", "two.prm", "-o", "two"}).status == 0);
  const auto summary = nlohmann::json::parse(content_of(folder / "one/summary.json")),
             twice   = nlohmann::json::parse(content_of(folder / "two/summary.json"));
  // Another kernel, whose roundings differ: nothing to see while the specimen is elastic, and more while it breaks.
  for (const auto &[name, figure] : summary["figures"].items())
    if (name != "strength_ratio")
      {
        INFO(name);
        const bool is_strength = name.find("strength") != std::string::npos;
        CHECK(twice["figures"][name]["value"].get<double>() ==
              Approx(figure["value"].get<double>()).epsilon(is_strength ? 1e-3 : 1e-9));
      }
  CHECK_FALSE(summary.contains("materials"));
  CHECK_FALSE(summary.contains("material_pairs"));
  CHECK_THAT(listing_of(folder / "one/tension_particles"), !Contains("Name=\"material\""));
  CHECK_THAT(listing_of(folder / "one/tension_links"), !Contains("Name=\"material_pair\""));
  CHECK_THAT(run(folder.path(), {"check", "one.prm"}).out, !Contains("particles of"));
}

TEST_CASE("A run of two materials is interrupted and goes on to the same bits", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", replaced(replaced(two_materials(), "set Strain rate = 4", "set Strain rate = 1"),
                                "  set Samples   = 50", "  set Checkpoint interval = 0.01\n  set Samples = 50"));
  goes_on_to_the_same_bits(folder, {{"run", "x.prm"}, {"checkpoint.h5"}, figures_of}, {SIGINT});
  CHECK(nlohmann::json::parse(content_of(folder / "results/summary.json"))["material_pairs"] ==
        nlohmann::json::parse(content_of(folder / "whole/summary.json"))["material_pairs"]);
}

TEST_CASE("Quasi-static and cell scenes take several materials", "[apps]")
{
  const ScratchFolder folder;
  std::string         packing = "# periodic_cell 4e-3 4e-3 8e-3\nx y z radius material\n";
  for (int i = 0; i < 16; ++i)
    packing += std::to_string(2e-3 * (i % 2)) + " " + std::to_string(2e-3 * (i / 2 % 2)) + " " +
               std::to_string(2e-3 * (i / 4)) + " 1e-3 " + (i / 4 < 2 ? "mortar" : "aggregate") + "\n";
  folder.file("packing.txt", packing);
  std::string scene =
    replaced(scene_of(materials(cpm(25e9), cpm(75e9))), "Interaction ratio = 1.5", "Interaction ratio = 1.05");
  // Columns along z of links A-A, A-B, B-B, A-B in series: 4/(1/E + 1/2E + 1/3E + 1/2E) = 12/7 of E; lattice: pi/4 of it.
  const double young = 3.141592653589793 / 4 * 12.0 / 7 * 25e9;
  std::string  rest  = replaced(scene, "Kind = uniaxial", "Kind = quasi_static");
  rest               = replaced(rest, "  set Density           = 4800\n", "  set Body = cell\n");
  const auto begin   = rest.find("subsection Loading");
  rest               = rest.substr(0, begin) + "subsection Loading\n  set Tests = tension\n  subsection Tension\n" +
         "    set Stop strain = 5e-5\n  end\nend\n";
  folder.file("statics.prm", rest);
  const Outcome statics = run(folder.path(), {"run", "statics.prm", "-o", "statics"});
  INFO(statics.err);
  REQUIRE(statics.status == 0);
  const auto found = nlohmann::json::parse(content_of(folder / "statics/summary.json"));
  CHECK(found["figures"]["young_modulus"]["value"].get<double>() == Approx(young).epsilon(1e-6));
  CHECK(found["material_pairs"][1]["links"] == 8);
  CHECK_THAT(run(folder.path(), {"check", "statics.prm"}).out, Contains("particles of mortar 8, aggregate 8"));

  std::string cell = replaced(scene, "Kind = uniaxial", "Kind = cell");
  cell             = cell.substr(0, cell.find("subsection Loading")) +
         "subsection Loading\n  subsection Leg 1\n    set Duration = 1e-3\n    set zz = strain 5e-5\n  end\nend\n"
         "subsection Time\n  set Damping = 0.5\nend\n";
  folder.file("cell.prm", cell);
  const Outcome moved = run(folder.path(), {"run", "cell.prm", "-o", "cell"});
  INFO(moved.err);
  REQUIRE(moved.status == 0);
  const auto end = nlohmann::json::parse(content_of(folder / "cell/summary.json"));
  CHECK(end["figures"]["end"]["stress"][2].get<double>() == Approx(young * 5e-5).epsilon(1e-3)); // waves of the loading
  CHECK(end["materials"][1]["particles"] == 8);
}

TEST_CASE("Density of a material is that of its particles", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  const auto step = [&](const std::string &density) {
    folder.file("x.prm", scene_of(materials(cpm(25e9) + density, cpm(25e9) + density) + middle_layer));
    const std::string out   = run(folder.path(), {"check", "x.prm"}).out;
    const auto        place = out.find("time step");
    REQUIRE(place != std::string::npos);
    return std::stod(out.substr(place + 9));
  };
  CHECK(step("    set Density = 19200\n") ==
        Approx(2 * step("")).epsilon(1e-3)); // four times 4800; printed with 4 digits
}

TEST_CASE("Materials that do not fit a packing or each other are refused in one line", "[apps][S14]")
{
  const std::string stack = stack_packing(), both = materials(cpm(25e9), cpm(75e9));
  CHECK_THAT(
    refusal(stack_with_column("agregate"), scene_of(both)),
    Contains("packing.txt: particle 76: material \"agregate\" is not in the scene's section Materials. Did you "
             "mean \"aggregate\"?"));
  CHECK_THAT(refusal(stack_with_column("-1"), scene_of(both)),
             Contains("packing.txt, line 77: material \"-1\": a material's name begins with a letter or digit"));
  CHECK_THAT(refusal(stack, scene_of(both)), Contains("packing.txt: no particle is of the material \"aggregate\""));
  CHECK_THAT(
    refusal(stack_with_column(), scene_with_file()),
    Contains("packing.txt: its particles are of several materials (mortar, aggregate), and the scene has one."));
  CHECK_THAT(refusal(replaced(stack_with_column(), " mortar\n", "\n"), scene_of(both)),
             Contains("packing.txt, line 2: found 4 columns, expected 5 as in the header."));
  CHECK_THAT(refusal(stack, scene_with_file() + both + middle_layer),
             Contains("x.prm:") &&
               Contains("Materials: the scene has a section Material as well. Keep one of the two."));
  CHECK_THAT(refusal(stack, scene_with_file() + middle_layer),
             Contains("Regions: the scene has no section Materials to take their materials from."));
  CHECK_THAT(refusal(stack, replaced(two_materials(), "set Material = aggregate", "set Material = agregate")),
             Contains("Regions/layer/Material = agregate: is not in section Materials. Did you mean \"aggregate\"?"));
  CHECK_THAT(refusal(stack, replaced(two_materials(), "Upper    = 1, 1, 6e-3", "Upper    = 1, 1, 4e-3")),
             Contains("Regions/layer/Upper = 1, 1, 4e-3: each coordinate must be above that of Lower."));
  CHECK_THAT(refusal(stack, replaced(two_materials(), "    set Lower    = -1, -1, 4e-3\n", "")),
             Contains("\"Regions/layer/Lower\" [m] is not set and has no default."));
  CHECK_THAT(
    refusal(stack, scene_of(materials(cpm(25e9), cpm(75e9, "      set Damage law = linear\n")) + middle_layer)),
    Contains("Damage law: material mortar has the exponential one, aggregate the linear one"));
  CHECK_THAT(refusal(stack, scene_of(materials(cpm(25e9), cpm(-1)) + middle_layer)),
             Contains("Materials/aggregate/CPM/Normal modulus = -1: expected a number > 0 [Pa]"));
  CHECK_THAT(refusal(stack, scene_of(replaced(both, "subsection aggregate", "subsection two words") + middle_layer)),
             Contains("Materials/two words: a material's name begins with a letter or digit"));
  CHECK_THAT(refusal(stack, replaced(two_materials(), "set Cohesion ", "set Cohesio  ")),
             Contains("\"Materials/mortar/CPM/Cohesio\" is not known. Did you mean \"Cohesion\"?"));
  CHECK_THAT(refusal(stack, replaced(two_materials(), "      set Cohesion             = 3e6\n", "")),
             Contains("\"Materials/mortar/CPM/Cohesion\" [Pa] is not set and has no default."));
  CHECK_THAT(refusal(stack_with_column("agregate"), scene_of(both), "check"), Contains("particle 76"));
}

TEST_CASE("Materials of different laws need the law of the links between them, and have it", "[apps]")
{
  const std::string bonds =
    "    set Law = contact-bond\n    subsection contact-bond\n      set Effective modulus = 30e9\n"
    "      set Tensile strength  = 2e6\n      set Cohesion          = 6e6\n    end\n";
  const auto with_contacts = [](const std::string &material) {
    return "    set Contacts = linear\n    subsection linear\n      set Effective modulus = 20e9\n    end\n" + material;
  };
  const auto interface = [](const std::string &more) {
    return "subsection Interfaces\n  subsection zone\n    set Material = mortar\n    set Other material = aggregate\n" +
           more + "  end\nend\n";
  };
  const std::string both   = materials(with_contacts(cpm(25e9)), with_contacts(bonds)) + middle_layer;
  const std::string linear = "    subsection linear\n      set Effective modulus = 20e9\n    end\n";
  const std::string weak =
    "    set Law = contact-bond\n    subsection contact-bond\n      set Effective modulus = 10e9\n"
    "      set Tensile strength  = 0.5e6\n      set Cohesion          = 2e6\n    end\n" +
    linear;
  CHECK_THAT(refusal(stack_packing(), scene_of(both)),
             Contains("Materials/aggregate/Law = contact-bond: links with mortar (CPM) have none.") &&
               Contains("add to Interfaces"));
  CHECK_THAT(refusal(stack_packing(), scene_of(both + interface(linear))),
             Contains("Interfaces/zone/Law = of the materials: the two materials have different ones"));
  CHECK_THAT(
    refusal(stack_packing(), scene_of(both + interface(replaced(weak, "      set Cohesion          = 2e6\n", "")))),
    Contains("\"Interfaces/zone/contact-bond/Cohesion\" [Pa] is not set"));
  CHECK_THAT(refusal(stack_packing(), scene_of(materials(cpm(25e9), bonds) + middle_layer + interface(weak))),
             Contains("Contacts = linear"));

  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", scene_of(both + interface(weak)));
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
  CHECK(summary["energy"]["balance_error"].get<double>() < 1e-3);
}

TEST_CASE(
  "Interfaces with factors have the constants of the first material times them, and the bits of those said outright",
  "[apps][slow]")
{
  const auto zone = [](const std::string &more) {
    return "subsection Interfaces\n  subsection zone\n    set Material = mortar\n    set Other material = aggregate\n" +
           more + "  end\nend\n";
  };
  const auto factors = [](const std::string &stiffness, const std::string &strength, const std::string &ductility) {
    return "    set Constants = factors\n    set Stiffness factor = " + stiffness +
           "\n    set Strength factor  = " + strength + "\n" +
           (ductility.empty() ? "" : "    set Ductility factor = " + ductility + "\n");
  };
  // Stransky (2018): "results 1" and "results 2" differ in the ductility alone.
  const std::string both = materials(cpm(25e9), cpm(62.5e9)) + middle_layer;
  for (const auto &[ductility, product] : {std::pair{"0.1", "3"}, std::pair{"0.05", "1.5"}})
    {
      std::string outright = cpm(12.5e9);
      outright =
        replaced(outright, "set Relative ductility   = 30", std::string("set Relative ductility   = ") + product);
      outright = replaced(outright, "set Cohesion             = 3e6", "set Cohesion             = 1.5e6");
      std::string figures[3];
      int         n = 0;
      for (const std::string &interface : {zone(factors("0.5", "0.5", ductility)), zone(outright), std::string()})
        {
          const ScratchFolder folder;
          folder.file("packing.txt", stack_packing());
          folder.file("x.prm", scene_of(both + interface));
          const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Loading/Tests=tension"});
          INFO(outcome.err);
          REQUIRE(outcome.status == 0);
          figures[n++] = content_of(folder / "results/series.csv") + listing_of(folder / "results/tension_links");
        }
      CHECK(figures[0] == figures[1]);
      CHECK(figures[0] != figures[2]); // of the means
    }

  const auto refused = [&](const std::string &sections) { return refusal(stack_packing(), scene_of(sections)); };
  CHECK_THAT(refused(both + zone(factors("0.5", "-1", "0.1"))),
             Contains("Interfaces/zone/Strength factor = -1: expected a number > 0"));
  CHECK_THAT(refused(both + zone("    set Law = linear\n" + factors("0.5", "0.5", "0.1"))),
             Contains("Interfaces/zone/Law") && Contains("it is that of mortar"));
  const std::string bonds =
    "    set Law = parallel-bond\n    subsection parallel-bond\n      set Effective modulus = 30e9\n"
    "      set Tensile strength  = 2e6\n      set Cohesion          = 6e6\n      set Friction angle = 30\n    end\n";
  CHECK_THAT(refused(materials(bonds, bonds) + middle_layer + zone(factors("0.5", "0.5", "0.1"))),
             Contains("Interfaces/zone") && Contains("the law has no ductility to multiply"));
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", scene_of(materials(bonds, bonds) + middle_layer + zone(factors("0.5", "0.5", ""))));
  CHECK(run(folder.path(), {"check", "x.prm"}).status == 0);
}

TEST_CASE("breccia pack keeps the materials of a packing, and homogenise refuses several", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_with_column());
  REQUIRE(run(folder.path(), {"pack", "--from", "packing.txt", "--box", "1,1,7e-3", "-o", "cropped.h5"}).status == 0);
  REQUIRE(run(folder.path(), {"pack", "--from", "cropped.h5", "--box", "1,1,7e-3", "-o", "cropped.txt"}).status == 0);
  const std::string text = content_of(folder / "cropped.txt");
  CHECK_THAT(text, Contains("# materials mortar aggregate\nx y z radius material\n"));
  std::istringstream lines(text.substr(text.find("material\n") + 9));
  std::string        x, y, z, radius, material;
  std::size_t        aggregates = 0;
  while (lines >> x >> y >> z >> radius >> material)
    {
      const bool middle = std::stod(z) > 4e-3 && std::stod(z) < 6e-3;
      CHECK(material == (middle ? "aggregate" : "mortar"));
      aggregates += middle;
    }
  CHECK(aggregates > 0);
  const Outcome outcome = run(folder.path(), {"homogenise", "cropped.h5", "--normal-modulus", "25e9", "--shear-ratio",
                                              "0.2", "--interaction-ratio", "1.5"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("cropped.h5: its particles are of several materials"));
}
