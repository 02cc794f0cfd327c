// Specimens of a mix through the program, in kinds other than uniaxial, quasi_static and cell.
#include "apps/process/mpi_session.h"
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/structure_runs.h"
#include "tests/apps/uneven_lattice.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace
{
  std::string mix_and_law() { return mix_of_two_sizes() + "end\n" + material_of_concrete(); }

  const std::string specimen_of_mix = R"(subsection Specimen
  set Source            = file
  set File              = packing.txt
  set Box size          = 0.012, 0.012, 0.012
  set Interaction ratio = 1.5
)";

  const std::string two_ends = R"(subsection Groups
  subsection bottom
    set Shape = box
    set Lower = -1, -1, -1
    set Upper = 1, 1, 0.003
  end
  subsection top
    set Shape = box
    set Lower = -1, -1, 0.009
    set Upper = 1, 1, 1
  end
end
)";

  std::string pulled_structure()
  {
    return "set Kind = structure\n" + specimen_of_mix + mix_and_law() + two_ends + R"(subsection Supports
  subsection bottom
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = 0
  end
  subsection top
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = t
  end
end
subsection Path
  set End  = 4e-6
  set Step = 4e-7
end
subsection Output
  set Points per snapshot = 0
end
)";
  }

  std::string pulled_particles()
  {
    return "set Kind = particles\n" + specimen_of_mix + "  set Density = 4000\n" + mix_and_law() + two_ends +
           R"(subsection Motion
  subsection bottom
    set Velocity z = -0.1
  end
  subsection top
    set Velocity z = 0.1
  end
end
subsection Time
  set End time = 2e-5
end
subsection Output
  set Samples   = 5
  set Snapshots = 0
end
)";
  }

  /** Links of all classes are the specimen's, aggregates are whole, and what the interface has lost is some of the whole. */
  void has_classes(const nlohmann::json &summary)
  {
    CHECK(summary["mix"]["aggregates"] > 2);
    REQUIRE(summary["link_classes"].size() == 3);
    std::size_t links  = 0;
    double      energy = 0;
    for (const auto &each : summary["link_classes"])
      {
        links += each["links"].get<std::size_t>();
        energy += each["damage_energy"].get<double>();
        if (each["class"] == "aggregate")
          CHECK(each["mean_damage"] == 0);
        if (each["class"] == "interface")
          CHECK(each["mean_damage"] > 0);
      }
    CHECK(links == summary["cost"]["links"]);
    CHECK_THAT(energy, WithinRel(summary["energy"]["damage"].get<double>(), 1e-6));
  }
} // namespace

TEST_CASE("Mix: structures and particles report what was requested and reached, and their figures by class of links",
          "[apps][mesoscale]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  for (const std::string &scene : {pulled_structure(), pulled_particles()})
    {
      folder.file("x.prm", scene);
      const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
      CHECK_THAT(outcome.out, Contains("mix          ") && Contains("aggregates of 4."));
      has_classes(nlohmann::json::parse(content_of(folder / "results/summary.json")));
      CHECK(std::filesystem::exists(folder / "results/grading.png"));
      std::filesystem::remove_all(folder / "results");
    }
}

TEST_CASE("Mix: an interrupted or killed structure of concrete goes on to the same bits",
          "[apps][mesoscale][structure][volume][slow][S13]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> words = {"run", places::sources() + "/apps/scenes/size_effect_plane.prm",
                                          "-s",  "Output/Checkpoint interval=0.01",
                                          "-s",  "Output/Points per snapshot=5",
                                          "-s",  "Path/Stop fraction=0.8"};
  goes_on_to_the_same_bits(folder, {words, {"solid/solid_000002.vtu", "checkpoint.h5"}, kept_of_structure},
                           {SIGINT, SIGKILL});
  const auto summary = [&](const std::string &results) {
    return nlohmann::json::parse(content_of(folder / results / "summary.json"));
  };
  const auto classes = summary("results")["link_classes"];
  CHECK(classes == summary("whole")["link_classes"]);
  REQUIRE(classes.size() == 3);
  CHECK(classes[0]["damage_energy"] > 0); // it has cracked
}

TEST_CASE("Mix: an interrupted or killed structure of particles alone goes on to the same bits",
          "[apps][mesoscale][structure][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  folder.file("x.prm", pulled_structure());
  const auto kept = [](const std::filesystem::path &results) {
    return listing_of(results / "particles") + listing_of(results / "links") + content_of(results / "series.csv") +
           content_of(results / "structure.pvd") +
           nlohmann::json::parse(content_of(results / "summary.json"))["link_classes"].dump();
  };
  goes_on_to_the_same_bits(folder,
                           {{"run", "x.prm", "-s", "Path/Step=1e-7", "-s", "Output/Checkpoint interval=0.01", "-s",
                             "Output/Points per snapshot=8"},
                            {"links/links_000002.vtp", "checkpoint.h5"},
                            kept},
                           {SIGINT, SIGKILL});
  const std::string left = kept(folder / "results");
  CHECK_THAT(left, Contains("links_000004.vtp") && Contains("\"interface\""));
}

TEST_CASE("Mix: a solid that would be as the particles of a mix are is refused with what to give instead",
          "[apps][mesoscale]")
{
  const ScratchFolder folder;
  const Outcome       homogenised =
    run(folder.path(), {"check", places::sources() + "/apps/scenes/bending_with_core.prm", "-s",
                        "Specimen/Mix/Content=0.2", "-s", "Specimen/Mix/Grading=passing", "-s",
                        "Specimen/Mix/Curve=4e-3: 0, 6e-3: 1", "-s", "Specimen/Mix/Smallest aggregate=4e-3"});
  CHECK(homogenised.status == 2);
  CHECK_THAT(homogenised.err, Contains("Homogenised") && Contains("no mix") && Contains("Stiffness file"));
}

namespace
{
  /** A strip of cells behind elements, with a mix in each cell. */
  std::string cells_of_mix()
  {
    return pulled_box("set Size = 0.1, 0.1, 0.1\n",
                      "set Law = cells\nsubsection cells\nsubsection Specimen\nset Source = file\n"
                      "set File = packing.txt\nset Interaction ratio = 1.5\n" +
                        mix_and_law() + "end\n",
                      "1e-5*t");
  }
} // namespace

TEST_CASE("Mix: cells behind integration points have the stiffness that homogenise finds with their aggregates",
          "[apps][mesoscale][cells]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  folder.file("cells.prm", cells_of_mix());
  const Outcome checked = run(folder.path(), {"check", "cells.prm"});
  INFO(checked.err);
  REQUIRE(checked.status == 0);
  std::smatch found;
  REQUIRE(std::regex_search(checked.out, found, std::regex("stiffness D11 ([0-9.e+]+)")));
  folder.file("mix.prm", pulled_structure());
  const Outcome homogenised = run(
    folder.path(), {"homogenise", "packing.txt", "--interaction-ratio", "1.5", "--materials", "mix.prm", "-o", "out"});
  INFO(homogenised.err);
  REQUIRE(homogenised.status == 0);
  const auto json = nlohmann::json::parse(content_of(folder / "out/homogenised.json"));
  CHECK_THAT(std::stod(found[1]), WithinRel(json["relaxed"]["stiffness"][0][0].get<double>(), 1e-3));
}

TEST_CASE("Mix: cells in motion may have several packings, of as many numbers of the aggregate as that with most",
          "[apps][mesoscale][cells]")
{
  const ScratchFolder folder;
  folder.file("x.prm", R"(set Kind = continuum
subsection Model
  set Dimension = 3
  set Analysis  = explicit
end
subsection Mesh
  set Source = box
  subsection Box
    set Size = 0.1, 0.1, 0.1
  end
end
subsection Materials
  subsection solid
    set Law     = cells
    set Density = 2000
    subsection cells
      set Answer           = motion
      set Packings         = 8
      set Particle density = 4800
      set Particle damping = 0.2
      subsection Specimen
        set Source            = generator
        set Interaction ratio = 1.5
        subsection Generator
          set Particle radius = 0.001
          set Cell particles  = 300
          set Seed            = 10
        end
        subsection Mix
          set Content            = 0.35
          set Grading            = passing
          set Curve              = 6e-3: 100, 4e-3: 0
          set Smallest aggregate = 4e-3
          set Sizes              = drawn
          set Clearance          = 0.01
        end
      end
      subsection Material
        set Law = CPM
        subsection CPM
          set Normal modulus       = 25e9
          set Shear ratio          = 0.2
          set Limit elastic strain = 1e-4
          set Relative ductility   = 30
          set Cohesion             = 3e6
          set Friction coefficient = 0.8
        end
      end
    end
  end
end
subsection Boundary conditions
  subsection left
    set Displacement x = 0
  end
  subsection right
    set Displacement x = 1e-3*t
  end
end
subsection Motion
  set End time = 2e-5
end
)");
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
  CHECK(summary["energy"]["balance_error"].get<double>() < 1e-6);
}

namespace
{
  /** A cube of 40 mm, its faces moved as a homogeneous strain moves them, with or without aggregates of 15 mm. */
  std::string strained_cube(const double content, const bool sheared)
  {
    const std::string x = sheared ? "1e-4*y*t" : "1e-4*x*t", y = sheared ? "1e-4*x*t" : "1e-4*y*t",
                      z = sheared ? "0" : "1e-4*z*t";
    std::ostringstream scene;
    scene << "set Kind = continuum\nsubsection Model\n  set Dimension = 3\nend\nsubsection Mesh\n  set Source = box\n"
             "  subsection Box\n    set Size = 0.04, 0.04, 0.04\n    set Divisions x = 24\n    set Divisions y = 24\n"
             "    set Divisions z = 24\n  end\n";
    if (content > 0)
      scene << "  subsection Mix\n    set Content = " << content
            << "\n    set Grading = passing\n    set Curve = 15.2e-3: 0, 15.4e-3: 1\n"
               "    set Smallest aggregate = 15.2e-3\n    set Sizes = drawn\n    set Clearance = 0.01\n  end\n";
    scene << "end\nsubsection Materials\n";
    const auto law = [&scene](const std::string &name, const double young) {
      scene << "  subsection " << name << "\n    set Law = isotropic elastic\n    subsection isotropic elastic\n"
            << "      set Young modulus = " << young << "\n      set Poisson ratio = 0.2\n    end\n  end\n";
    };
    law(content > 0 ? "mortar" : "solid", 20e9);
    if (content > 0)
      law("aggregate", 200e9);
    scene << "end\nsubsection Boundary conditions\n";
    for (const char *side : {"left", "right", "top", "bottom", "front", "back"})
      scene << "  subsection " << side << "\n    set Displacement x = " << x << "\n    set Displacement y = " << y
            << "\n    set Displacement z = " << z << "\n  end\n";
    scene << "end\nsubsection Control\n  set End = 1\n  set First step = 1\n  set Linear solver = "
             "iterative\nend\nsubsection Output\n  set Snapshots = 0\n"
             "end\n";
    return scene.str();
  }

  /** Bulk modulus, or shear modulus [Pa], by the energy of the cube; the part of its elements that is aggregate. */
  struct Cube
  {
    double modulus, part;
  };

  Cube strained(const double content, const bool sheared)
  {
    const ScratchFolder folder;
    folder.file("x.prm", strained_cube(content, sheared));
    const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
    INFO(outcome.err << outcome.out);
    REQUIRE(outcome.status == 0);
    const auto summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
    // 9/2 K e^2 for e in all directions; 2 G e^2 for a shear of 2 e.
    const double density = summary["energy"]["stored"].get<double>() / (0.04 * 0.04 * 0.04) / 1e-8;
    std::smatch  found;
    const bool   mixed = std::regex_search(outcome.err, found, std::regex("; ([0-9]+) of ([0-9]+) elements"));
    REQUIRE(mixed == (content > 0));
    return {density / (sheared ? 2 : 4.5), mixed ? std::stod(found[1]) / std::stod(found[2]) : 0};
  }
} // namespace

TEST_CASE("Mix: stiff spheres of elements lie between the bounds of Hashin and Shtrikman, few at Eshelby's limit",
          "[apps][mesoscale][continuum][slow]")
{
  const double young = 20e9, nu = 0.2, stiffer = 10, K = young / (3 * (1 - 2 * nu)), G = young / (2 * (1 + nu));
  for (const bool sheared : {false, true})
    {
      const double soft = sheared ? G : K, stiff = stiffer * soft;
      CHECK_THAT(strained(0, sheared).modulus, WithinRel(soft, 1e-8));
      // Eshelby (1957), Proc. R. Soc. A 241, 376: what a sphere sees of the strain.
      const double alpha = sheared ? 6 * (K + 2 * G) / (5 * (3 * K + 4 * G)) : 3 * K / (3 * K + 4 * G);
      const Cube   few   = strained(0.03, sheared);
      const double limit = soft + few.part * (stiff - soft) / (1 + alpha * (stiffer - 1));
      INFO("part " << few.part << ", modulus " << few.modulus << ", limit " << limit);
      CHECK_THAT(few.modulus, WithinRel(limit, 0.02));
      CHECK_THAT(few.modulus - soft, WithinRel(limit - soft, 0.25)); // the spheres are met, not the mortar alone

      // Hashin, Shtrikman (1963), J. Mech. Phys. Solids 11, 127; with both moduli in one ratio alpha is that of either matrix.
      const Cube   many  = strained(0.2, sheared);
      const double lower = soft + many.part / (1 / (stiff - soft) + (1 - many.part) * alpha / soft),
                   upper = stiff + (1 - many.part) / (1 / (soft - stiff) + many.part * alpha / stiff);
      INFO("part " << many.part << ": " << lower << " < " << many.modulus << " < " << upper);
      CHECK(many.modulus > lower);
      CHECK(many.modulus < upper);
    }
}
