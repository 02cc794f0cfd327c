#include "apps/models/mix.h"
#include "apps/runs/homogenisation/moduli.h"
#include "apps/specimens/mixed_specimen.h"
#include "dem/packing/compaction.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/apps/uneven_lattice.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>

using namespace apps_tests;
using Catch::Contains;
using Catch::WithinRel;

namespace
{
  /** Bulk and shear modulus [Pa]. */
  struct Moduli
  {
    double bulk, shear;
  };

  Moduli moduli_of(const dem::ElasticConstants &constants)
  {
    return {constants.young / (3 * (1 - 2 * constants.poisson)), constants.young / (2 * (1 + constants.poisson))};
  }

  double young(const Moduli &m) { return 9 * m.bulk * m.shear / (3 * m.bulk + m.shear); }

  /** Hashin and Shtrikman (1963), J. Mech. Phys. Solids 11, 127, eqs. 4.1 to 4.4: that bound of the two whose matrix is `matrix`. */
  Moduli bound(const Moduli &matrix, const Moduli &other, const double part)
  {
    const double K = matrix.bulk, G = matrix.shear, reference = 3 * K + 4 * G;
    return {K + part / (1 / (other.bulk - K) + 3 * (1 - part) / reference),
            G + part / (1 / (other.shear - G) + 6 * (1 - part) * (K + 2 * G) / (5 * G * reference))};
  }

  /** A few spheres in a matrix that do not see each other: Eshelby (1957), Proc. R. Soc. A 241, 376, section 5. */
  Moduli dilute(const Moduli &matrix, const Moduli &other, const double part)
  {
    const double K = matrix.bulk, G = matrix.shear, alpha = 3 * K / (3 * K + 4 * G),
                 beta = 6 * (K + 2 * G) / (5 * (3 * K + 4 * G));
    return {K + part * (other.bulk - K) / (1 + alpha * (other.bulk / K - 1)),
            G + part * (other.shear - G) / (1 + beta * (other.shear / G - 1))};
  }

  constexpr double stiffer = 10; ///< aggregate over mortar

  /** Spheres of nearly 12 mm; a link from one phase to the other is half of each, in series. */
  apps::MixSection round_aggregates(const double content)
  {
    apps::MixSection mix;
    mix.content    = content;
    mix.grading    = apps::MixSection::Grading::passing;
    mix.curve      = {{11.9e-3, 0}, {12.1e-3, 100}};
    mix.smallest   = 11.9e-3;
    mix.sizes      = apps::MixSection::Sizes::drawn;
    mix.clearance  = 0.001;
    mix.aggregates = {stiffer, stiffer, 1};
    mix.interface  = {2 * stiffer / (1 + stiffer), 2 * stiffer / (1 + stiffer), 1};
    return mix;
  }

  /** Of a packing as it is numbered; the part of its particles that is aggregate. */
  struct Composite
  {
    Moduli moduli;
    double part;
  };

  Composite composite_of(dem::Packing packing, const apps::MixSection &mix)
  {
    apps::SpecimenSection cell;
    cell.body              = apps::SpecimenSection::Body::cell;
    cell.interaction_ratio = 1.5;
    apps::MaterialSection material;
    material.only.choose(cluster::concrete());
    const apps::MixedSpecimen mixed{cell, mix, material, 3};
    mixed.check({});
    mixed.number(packing, "packing");
    apps::HomogenisationQuestion question;
    question.links.interaction_ratio = cell.interaction_ratio;
    question.materials               = mixed.materials(packing.material_names);
    const auto answer                = apps::homogenise(packing, question, "packing");
    const auto mortars               = std::count(packing.material.begin(), packing.material.end(), 0);
    const auto all                   = static_cast<double>(packing.size());
    return {moduli_of(answer.relaxed.constants.value()),
            packing.material.empty() ? 0 : 1 - static_cast<double>(mortars) / all};
  }
} // namespace

TEST_CASE("Mix: stiff spheres in a soft cell lie between the bounds of Hashin and Shtrikman, few at Eshelby's limit",
          "[apps][mesoscale]")
{
  dem::CompactionParameters requested;
  requested.radius           = 1e-3;
  requested.count            = 4000;
  requested.friction         = 1;
  const dem::Packing packing = dem::compact(requested).packing;
  const Moduli       soft    = composite_of(packing, {}).moduli, stiff{stiffer * soft.bulk, stiffer * soft.shear};

  const Composite one = composite_of(packing, round_aggregates(0.03));
  REQUIRE(one.part > 0.02);
  REQUIRE(one.part < 0.03);
  const double limit = young(dilute(soft, stiff, one.part));
  CHECK_THAT(young(one.moduli), WithinRel(limit, 0.02));
  // What the sphere adds is itself met: the two per cent alone would let none pass.
  CHECK_THAT(young(one.moduli) - young(soft), WithinRel(limit - young(soft), 0.25));

  for (const double content : {0.11, 0.2})
    {
      const Composite several = composite_of(packing, round_aggregates(content));
      const Moduli    lower = bound(soft, stiff, several.part), upper = bound(stiff, soft, 1 - several.part);
      INFO(several.part << ": E " << young(several.moduli) << " between " << young(lower) << " and " << young(upper));
      CHECK(several.moduli.bulk > lower.bulk);
      CHECK(several.moduli.shear > lower.shear);
      CHECK(several.moduli.bulk < upper.bulk);
      CHECK(several.moduli.shear < upper.shear);
    }
}

namespace
{
  /** Of a periodic cell of 12 mm in each edge; `loading` in place of that of a uniaxial scene. */
  std::string cell_of_concrete(const std::string &kind, const std::string &loading)
  {
    std::string scene = replaced(scene_with_file(), "Kind = uniaxial", "Kind = " + kind);
    const auto  begin = scene.find("subsection Loading"), end = scene.find("subsection Output");
    scene.replace(begin, end - begin, loading);
    return replaced(scene, "Interaction ratio = 1.5\n", "Interaction ratio = 1.5\n" + mix_of_two_sizes());
  }

  std::string moving_cell()
  {
    return cell_of_concrete("cell", "subsection Loading\n  subsection Leg 1\n    set Duration = 1e-3\n"
                                    "    set xx = strain 4e-4\n  end\nend\n");
  }

  std::string still_cell()
  {
    const std::string scene = cell_of_concrete(
      "quasi_static", "subsection Loading\n  set Tests = tension\n  set Axis = x\n"
                      "  subsection Tension\n    set Stop strain = 1e-4\n    set Strain step = 5e-6\n  end\nend\n");
    return replaced(replaced(scene, "  set Density           = 4800\n", "  set Body = cell\n"),
                    "  set Samples   = 50\n  set Snapshots = 5\n", "");
  }

  nlohmann::json summary_of(const ScratchFolder &folder, const std::string &results)
  {
    return nlohmann::json::parse(content_of(folder / results / "summary.json"));
  }
} // namespace

TEST_CASE("Mix: a cell has aggregates over its faces and figures by class of links, the same bits with two threads",
          "[apps][mesoscale][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  folder.file("moving.prm", moving_cell());
  folder.file("still.prm", still_cell());
  for (const std::string scene : {"moving", "still"})
    {
      for (const std::string threads : {"1", "2"})
        {
          const Outcome outcome =
            run(folder.path(), {"run", scene + ".prm", "-o", scene + threads, "--threads", threads});
          INFO(scene << ": " << outcome.err);
          REQUIRE(outcome.status == 0);
        }
      CHECK(content_of(folder / (scene + "1/series.csv")) == content_of(folder / (scene + "2/series.csv")));
      const auto summary = summary_of(folder, scene + "1");
      CHECK(summary["mix"]["aggregates"] > 4);
      CHECK_THAT(summary["mix"]["content"].get<double>(), WithinRel(0.3, 0.1));
      CHECK(summary["materials"].size() > 1);
      CHECK(summary["energy"]["balance_error"].get<double>() < 1e-3);
    }
  const auto  summary = summary_of(folder, "moving1");
  std::size_t links   = 0;
  for (const auto &each : summary["link_classes"])
    {
      links += each["links"].get<std::size_t>();
      if (each["class"] == "aggregate")
        CHECK(each["mean_damage"] == 0);
      if (each["class"] == "interface")
        CHECK(each["mean_damage"] > 0);
    }
  CHECK(summary["link_classes"].size() == 3);
  CHECK(links == summary["cost"]["links"]);

  const auto still  = summary_of(folder, "still1");
  double     energy = 0;
  links             = 0;
  for (const auto &each : still["tests"][0]["link_classes"])
    {
      links += each["links"].get<std::size_t>();
      energy += each["damage_energy"].get<double>();
      CHECK((each["broken"] > 0) == (each["broken_area"] > 0));
    }
  CHECK(links == still["cost"]["links"]);
  CHECK_THAT(energy, WithinRel(still["tests"][0]["energy"]["damage"].get<double>(), 1e-6));
  CHECK(energy > 0);
  CHECK(std::filesystem::exists(folder / "still1/grading.png"));
  CHECK(std::filesystem::exists(folder / "moving1/grading.png"));
}

TEST_CASE("Mix: an interrupted cell of concrete goes on to the same bits", "[apps][mesoscale][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  folder.file("x.prm", replaced(moving_cell(), "Duration = 1e-3", "Duration = 8e-3") +
                         "subsection Output\n  set Checkpoint interval = 0.01\nend\n");
  const auto reproducible_part = [](const std::filesystem::path &results) {
    return content_of(results / "series.csv") + listing_of(results / "cell_links");
  };
  goes_on_to_the_same_bits(folder, {{"run", "x.prm"}, {"checkpoint.h5"}, reproducible_part}, {SIGINT});
}

TEST_CASE("Mix: homogenise takes it from a scene, and refuses what is none by its entry", "[apps][mesoscale]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  folder.file("x.prm", moving_cell());
  const auto young_with = [&](const std::string &factor) {
    const Outcome outcome =
      run(folder.path(),
          {"homogenise", "packing.txt", "--interaction-ratio", "1.5", "--materials", "x.prm", "-o", "out", "-s",
           "Specimen/Mix/Aggregates/Stiffness factor=" + factor, "-s", "Specimen/Mix/Interface/Stiffness factor=1"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto found = nlohmann::json::parse(content_of(folder / "out/homogenised.json"));
    return found["relaxed"]["stiffness"][0][0].get<double>();
  };
  const double alike = young_with("1");
  const double plain = [&] {
    const Outcome outcome = run(folder.path(), {"homogenise", "packing.txt", "--interaction-ratio", "1.5",
                                                "--normal-modulus", "25e9", "--shear-ratio", "0.2", "-o", "out"});
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(content_of(folder / "out/homogenised.json"))["relaxed"]["stiffness"][0][0]
      .get<double>();
  }();
  CHECK_THAT(alike, WithinRel(plain, 1e-8)); // aggregates of the mortar's stiffness are none
  CHECK(young_with("10") > 1.02 * alike);

  folder.file("bad.prm", replaced(moving_cell(), "6e-3: 100, 4e-3: 0", "6e-3: 0, 4e-3: 100"));
  const Outcome refused =
    run(folder.path(), {"homogenise", "packing.txt", "--interaction-ratio", "1.5", "--materials", "bad.prm"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("less passes than the finer sieve"));
}

namespace
{
  /** The constants that follow from the factors of the mix, said outright in sections Materials and Interfaces. */
  std::string with_constants_of_their_own(std::string scene)
  {
    const auto begin = scene.find("  subsection CPM"), end = scene.find("subsection Loading"),
               head             = scene.find("subsection Material\n");
    const std::string constants = scene.substr(begin, scene.rfind("end\n", end) - begin);
    const std::string stone =
      replaced(replaced(replaced(constants, "25e9", "62.5e9"), "1e-4", "2e-4"), "= 3e6", "= 15e6");
    const auto named = [](const std::string &name, const std::string &block) {
      return "  subsection " + name + "\n  set Law = CPM\n" + block + "  end\n";
    };
    return scene.replace(head, end - head,
                         "subsection Materials\n" + named("mortar", constants) + named("aggregate", stone) +
                           "end\nsubsection Interfaces\n  subsection zone\n    set Material = mortar\n"
                           "    set Other material = aggregate\n    set Constants = factors\n"
                           "    set Stiffness factor = 0.5\n    set Strength factor = 0.5\n"
                           "    set Ductility factor = 0.1\n  end\nend\n");
  }
} // namespace

TEST_CASE(
  "Mix: constants of their own in Materials and Interfaces give the bits and classes of the same ones by factors",
  "[apps][mesoscale][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  for (const auto &[name, scene] : {std::pair{"moving", moving_cell()}, {"still", still_cell()}})
    {
      folder.file("factors.prm", scene);
      folder.file("own.prm", with_constants_of_their_own(scene));
      for (const std::string way : {"factors", "own"})
        {
          const Outcome outcome = run(folder.path(), {"run", way + ".prm", "-o", name + way});
          INFO(name << ' ' << way << ": " << outcome.err);
          REQUIRE(outcome.status == 0);
        }
      CHECK(content_of(folder / (name + std::string("own/series.csv"))) ==
            content_of(folder / (name + std::string("factors/series.csv"))));
      const auto factors = summary_of(folder, name + std::string("factors")),
                 own     = summary_of(folder, name + std::string("own"));
      CHECK(own["materials"] == factors["materials"]);
      CHECK(own["materials"].dump().find("aggregate+2") != std::string::npos); // some are beside each other
      const auto classes = [](const nlohmann::json &summary) {
        return summary.contains("link_classes") ? summary["link_classes"] : summary["tests"][0]["link_classes"];
      };
      CHECK(classes(own).size() == 3);
      CHECK(classes(own) == classes(factors));
    }
  folder.file("bad.prm", replaced(with_constants_of_their_own(moving_cell()), "    set Content ",
                                  "    set Aggregate = gravel\n    set Content "));
  const Outcome refused = run(folder.path(), {"check", "bad.prm"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Specimen/Mix/Aggregate") && Contains("Materials"));
}

namespace
{
  /** A box of concrete, made by compaction, in motion. */
  std::string moving_box()
  {
    std::string scene =
      replaced(scene_with_file(), "  set Source            = file\n  set File              = packing.txt\n",
               "  set Source = generator\n  set Box size = 0.026, 0.026, 0.032\n"
               "  subsection Generator\n    set Particle radius = 0.9e-3\n  end\n" +
                 replaced(mix_of_two_sizes(), "6e-3: 100, 4e-3: 0", "9e-3: 100, 5e-3: 0"));
    scene = replaced(scene, "5e-3: 0\n    set Smallest aggregate = 4e-3", "5e-3: 0\n    set Smallest aggregate = 5e-3");
    scene = replaced(scene, "  set Grip thickness = 0.5e-3\n", "  set Tests = tension\n  set Grip thickness = 2e-3\n");
    scene = replaced(scene, "Strain rate = 4\n", "Strain rate = 10\n");
    return replaced(scene, "  subsection Compression\n    set Strain rate = 20\n  end\n", "");
  }
} // namespace

TEST_CASE(
  "Mix: a moving specimen closes its energy, has the same bits with two threads, and interrupted goes on to them",
  "[apps][mesoscale][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("x.prm", moving_box() + "subsection Output\n  set Checkpoint interval = 0.2\nend\n");
  const auto series = [](const std::filesystem::path &results) { return content_of(results / "series.csv"); };
  goes_on_to_the_same_bits(folder, {{"run", "x.prm", "--threads", "2"}, {"checkpoint.h5"}, series}, {SIGINT, SIGKILL});
  const Outcome alone = run(folder.path(), {"run", "x.prm", "-o", "alone", "--threads", "1"});
  REQUIRE(alone.status == 0);
  CHECK(series(folder / "alone") == series(folder / "whole"));

  const auto summary = summary_of(folder, "results");
  CHECK(summary["cost"]["particles"] > 3000);
  CHECK_THAT(summary["mix"]["content"].get<double>(), WithinRel(0.3, 0.1));
  const auto &test = summary["tests"][0];
  CHECK(std::abs(test["energy"]["balance_error"].get<double>()) < 1e-4);
  std::size_t broken = 0;
  for (const auto &each : test["link_classes"])
    broken += each["broken"].get<std::size_t>();
  CHECK(broken > 0);
}
