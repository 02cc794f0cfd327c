#include "apps/models/mix.h"
#include "apps/models/mix_materials.h"
#include "apps/specimens/mix_work.h"
#include "apps/text/size_table.h"
#include "base/errors.h"
#include "dem/model/materials.h"
#include "tests/apps/concrete_stack.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace
{
  apps::MixSection low_19()
  {
    apps::MixSection mix;
    mix.constituents = {{"cement", 352.8, 3100, false, 0, 0},         {"water", 187, 1000, false, 0, 0},
                        {"plasticiser", 4.4, 1000, false, 0, 0},      {"sand", 1122, 2590, true, 0, 0},
                        {"coarse", 150, 2590, false, 12.5e-3, 19e-3}, {"fine", 300, 2590, false, 4.75e-3, 9.5e-3},
                        {"middle", 300, 2590, false, 9.5e-3, 12.5e-3}};
    mix.unit_weight  = 2428;
    mix.smallest     = 4.75e-3;
    mix.increment    = 12.8e-6;
    return mix;
  }
} // namespace

TEST_CASE("Mix: classes of the constituents are the grading, and the content is the published one", "[apps][mesoscale]")
{
  const apps::MixSection mix = low_19();
  mix.check({}, {0.05, 0.05, 0.05}, 3);
  CHECK_THAT(mix.all_aggregates(), WithinAbs(0.70654, 0.5e-5));
  CHECK_THAT(mix.prescribed_content(), WithinAbs(0.28307, 1e-5));
  const dem::AggregateSizes sizes = mix.sizes_in({0.05, 0.05, 0.05});
  CHECK(sizes.diameters.size() == 134);
  CHECK_THAT(sizes.diameters.front(), WithinAbs(17.756e-3, 0.5e-6));
  CHECK_THAT(mix.placed_in({0.05, 0.05, 0.05}, false).structure.content(), WithinRel(0.9978 * 0.28307, 2e-4));
}

TEST_CASE("Mix: what does not fit together is refused by its entry", "[apps][mesoscale]")
{
  const Eigen::Vector3d box(0.05, 0.05, 0.05);
  apps::MixSection      mix = low_19();
  mix.content               = 0.3;
  CHECK_THROWS_WITH(mix.check({}, box, 3), Contains("Content"));
  mix                             = low_19();
  mix.content                     = 0;
  mix.constituents.back().largest = 9e-3;
  CHECK_THROWS_WITH(mix.check({}, box, 3), Contains("Largest size"));
  mix                              = low_19();
  mix.constituents.back().smallest = 8e-3;
  CHECK_THROWS_WITH(mix.check({}, box, 3), Contains("middle"));
  mix          = low_19();
  mix.smallest = 0;
  CHECK_THROWS_WITH(mix.check({}, box, 3), Contains("Smallest aggregate"));
  CHECK_NOTHROW(low_19().check({}, {0.05, 0.05, 0}, 2)); // a section of what is behind it
}

TEST_CASE("Grading in a text: passing and retained, parts or percent, in any order", "[apps][mesoscale]")
{
  const dem::GradingCurve parts   = apps::grading_of(apps::sieves_in_text("16e-3: 1, 4e-3: 0.4, 8e-3: 0.7"), false);
  const dem::GradingCurve percent = apps::grading_of(apps::sieves_in_text("4e-3: 30, 16e-3: 0, 8e-3: 30"), true);
  for (const double d : {4e-3, 5e-3, 8e-3, 11e-3})
    CHECK_THAT(parts.passing(d), WithinAbs(percent.passing(d), 1e-12));
  CHECK_THROWS_WITH(apps::sieves_in_text("4e-3 0.4, 8e-3: 1"), Contains("expected size: part"));
}

namespace
{
  /** Normal modulus of links of a pair of materials [Pa]. */
  double modulus(const dem::LinkLaw &law, const std::int32_t one, const std::int32_t other)
  {
    dem::NewLink link;
    link.distance     = 2e-3;
    link.first_radius = link.second_radius = 1e-3;
    link.area                              = 3e-6;
    const auto          pair               = static_cast<std::size_t>(dem::material_pair(one, other));
    std::vector<double> history(law.columns().size(), 0.0);
    law.begin(pair, link, history.data());
    return law.stiffness(pair, {0, 2e-3, 2e-3, 3e-6}, history.data()).normal;
  }
} // namespace

TEST_CASE("Mix: links between different aggregates are of the interface, within one of the aggregate",
          "[apps][mesoscale]")
{
  apps::MixSection mix = low_19();
  mix.aggregates       = {2.5, 5, 1};
  mix.interface        = {0.5, 0.5, 0.1};
  apps::LinkLaw law_of_mortar;
  law_of_mortar.choose(cluster::concrete());
  const std::size_t              numbers = 4;
  const dem::LinkMaterials       made    = apps::mix_materials(mix, law_of_mortar, numbers);
  const std::vector<std::string> classes = apps::classes_of_mix(numbers);
  REQUIRE(made.size() == numbers);
  const auto of = [&](const std::int32_t one, const std::int32_t other) {
    return classes.at(static_cast<std::size_t>(dem::material_pair(one, other)));
  };
  CHECK(of(0, 0) == "mortar");
  CHECK(of(0, 1) == "interface");
  CHECK(of(0, 3) == "interface");
  CHECK(of(1, 1) == "aggregate");
  CHECK(of(3, 3) == "aggregate");
  CHECK(of(1, 3) == "interface");
  // The law that a specimen gets has the constants of each pair: moduli 1, 2.5 and 0.5 times the mortar's.
  const auto law = made.bonds(dem::Physics());
  CHECK(modulus(*law, 0, 0) == 25e9);
  CHECK(modulus(*law, 3, 3) == 62.5e9);
  CHECK(modulus(*law, 0, 3) == 12.5e9);
  CHECK(modulus(*law, 1, 3) == 12.5e9);
}

namespace
{
  /** Concrete whose moduli say the material. */
  apps::NamedMaterial of_modulus(const std::string &name, const double normal_modulus)
  {
    dem::CpmParameters p = cluster::concrete();
    p.normal_modulus     = normal_modulus;
    apps::NamedMaterial made;
    made.name = name;
    made.law.choose(p);
    return made;
  }

  apps::MaterialInterface between(const std::string &one, const std::string &other, const double normal_modulus)
  {
    apps::MaterialInterface made;
    made.one       = one;
    made.other     = other;
    made.constants = of_modulus("", normal_modulus).law.constants;
    return made;
  }
} // namespace

TEST_CASE("Mix: with Materials links between different aggregates are of the interface as well, with its constants",
          "[apps][mesoscale]")
{
  apps::MaterialSection materials;
  materials.named      = {of_modulus("steel", 200e9), of_modulus("mortar", 20e9), of_modulus("aggregate", 60e9)};
  apps::MixSection mix = low_19();
  // Numbers: steel 0, mortar 1, aggregate 2, and two more of the aggregate, 3 and 4.
  const auto check = [&](const double interface, const double within, const double with_steel) {
    const auto law = apps::with_copies(mix, materials, 5).materials().bonds(dem::Physics());
    for (const std::int32_t stone : {2, 3, 4})
      {
        CHECK(modulus(*law, 1, stone) == interface);
        CHECK(modulus(*law, 0, stone) == with_steel);
        for (const std::int32_t other : {2, 3, 4})
          CHECK(modulus(*law, other, stone) == (other == stone ? within : interface));
      }
    CHECK(modulus(*law, 0, 0) == 200e9);
    CHECK(modulus(*law, 1, 1) == 20e9);
  };
  check(40e9, 60e9, 130e9); // the means
  materials.interfaces = {between("aggregate", "mortar", 5e9)};
  check(5e9, 60e9, 130e9);
  materials.interfaces.push_back(between("steel", "aggregate", 7e9));
  materials.interfaces.push_back(between("aggregate", "aggregate", 50e9));
  check(5e9, 50e9, 7e9);
  materials.interfaces.push_back(between("mortar", "aggregate", 0));
  materials.interfaces.back().from    = apps::MaterialInterface::Constants::factors;
  materials.interfaces.back().factors = {0.5, 0.5, 0.1};
  check(10e9, 50e9, 7e9); // the last of several
}

TEST_CASE("Mix: contents of classes between sieves add up to the whole, requested and placed", "[apps][mesoscale]")
{
  const apps::MixSection mix   = low_19();
  const nlohmann::json   found = apps::mix_figures(mix, {{0.05, 0.05, 0.05}, false}).json();
  REQUIRE(found["classes"].size() == 3);
  double requested = 0, placed = 0;
  for (const auto &each : found["classes"])
    {
      requested += each["content_requested"].get<double>();
      placed += each["content"].get<double>();
    }
  CHECK_THAT(requested, WithinRel(found["content_requested"].get<double>(), 1e-12));
  CHECK_THAT(placed, WithinRel(found["content"].get<double>(), 1e-12));
  // 300, 300 and 150 of 1872 kg of aggregates.
  for (const auto &[k, mass] : {std::pair{0, 300.0}, {1, 300.0}, {2, 150.0}})
    CHECK_THAT(found["classes"][k]["content_requested"].get<double>(),
               WithinRel(mix.all_aggregates() * mass / 1872, 1e-12));
  double in_class = 0; // by the volumes of the spheres
  for (const double d : mix.sizes_in({0.05, 0.05, 0.05}).diameters)
    in_class += d >= 9.5e-3 && d < 12.5e-3 ? M_PI / 6 * d * d * d : 0;
  CHECK_THAT(found["classes"][1]["content"].get<double>(), WithinRel(in_class / (0.05 * 0.05 * 0.05), 1e-9));
}

TEST_CASE("Mix: a run reports what was requested and reached, and its figures by class of links", "[apps][mesoscale]")
{
  const apps_tests::ScratchFolder folder;
  folder.file("packing.txt", apps_tests::stack_packing());
  folder.file("x.prm", apps_tests::concrete_stack());
  const apps_tests::Outcome outcome = apps_tests::run(folder.path(), {"run", "x.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto  summary = nlohmann::json::parse(apps_tests::content_of(folder / "results/summary.json"));
  const auto &mix     = summary["mix"];
  CHECK(mix["aggregates"] > 0);
  CHECK_THAT(mix["content_requested"].get<double>(), WithinRel(0.27, 1e-12));
  CHECK_THAT(mix["content"].get<double>(), WithinRel(0.27, 0.2)); // few are whole
  CHECK(mix["sieves"].size() == 2);
  REQUIRE(mix["classes"].size() == 1);
  CHECK_THAT(mix["classes"][0]["content_requested"].get<double>(), WithinRel(0.27, 1e-12));
  CHECK_THAT(mix["classes"][0]["content"].get<double>(), WithinRel(mix["content"].get<double>(), 1e-12));
  for (const auto &test : summary["tests"])
    {
      std::size_t links  = 0;
      double      energy = 0;
      for (const auto &each : test["link_classes"])
        {
          links += each["links"].get<std::size_t>();
          energy += each["damage_energy"].get<double>();
          if (each["class"] == "aggregate") // five times as strong as the mortar, and ten times as the interface
            CHECK(each["broken"] == 0);
          if (each["class"] == "interface" && each["broken"] > 0)
            CHECK(each["broken_area"] > 0);
        }
      CHECK(links == summary["cost"]["links"]);
      CHECK_THAT(energy, WithinRel(test["energy"]["damage"].get<double>(), 1e-9));
    }
  CHECK(std::filesystem::exists(folder / "results/grading.png"));
  folder.file("bad.prm", apps_tests::replaced(apps_tests::concrete_stack(), "100, 3e-3: 10", "10, 3e-3: 100"));
  const apps_tests::Outcome refused = apps_tests::run(folder.path(), {"check", "bad.prm"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Specimen/Mix") && Contains("less passes than the finer sieve"));
}
