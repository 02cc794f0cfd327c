#include "apps/bench/beygi_mixes.h"
#include "apps/bench/scene_variant.h"
#include "apps/runs/uniaxial/model.h"
#include "apps/text/value_text.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

TEST_CASE("the six concrete mixes have the published volumes, numbers and largest aggregates", "[apps][mesoscale]")
{
  // Stransky (2018), table of 8.2, in a cube of 50 mm: part of all aggregates, of the coarse ones, number, largest size.
  struct Published
  {
    const char *name;
    double      aggregates, coarse;
    std::size_t number;
    double      largest;
  };
  const std::vector<Published> published = {
    {"l-9.5", 0.67453, 0.27024, 254, 9.498e-3},   {"l-12.5", 0.70072, 0.28074, 139, 12.369e-3},
    {"l-19", 0.70654, 0.28307, 134, 17.756e-3},   {"h-9.5", 0.68403, 0.27405, 257, 9.454e-3},
    {"h-12.5", 0.69800, 0.27965, 139, 12.369e-3}, {"h-19", 0.70199, 0.28125, 132, 18.035e-3}};
  REQUIRE(apps::beygi::mixes().size() == published.size());
  for (std::size_t m = 0; m < published.size(); ++m)
    {
      const Published &wanted = published[m];
      INFO(wanted.name);
      const apps::beygi::Mix &mix = apps::beygi::mixes()[m];
      CHECK(mix.name == wanted.name);
      const apps::MixSection section = mix.section({});
      CHECK(section.all_aggregates() == Approx(wanted.aggregates).margin(6e-6));
      CHECK(section.prescribed_content() == Approx(wanted.coarse).margin(6e-6));
      const dem::AggregateSizes sizes = section.sizes_in(Eigen::Vector3d::Constant(0.05));
      CHECK(static_cast<double>(sizes.diameters.size()) == Approx(static_cast<double>(wanted.number)).epsilon(0.02));
      CHECK(sizes.diameters.front() == Approx(wanted.largest).epsilon(0.01));
      CHECK(sizes.volume == Approx(wanted.coarse * 0.05 * 0.05 * 0.05).epsilon(0.006));
    }
}

namespace
{
  /** What a row of the tutorial says in quotes behind each -s. */
  std::vector<std::string> changes_of(const std::string &page, const std::string &mix)
  {
    const std::size_t begin = page.find("\n| " + mix + " | ");
    REQUIRE(begin != std::string::npos);
    const std::string        row = page.substr(begin + 1, page.find('\n', begin + 1) - begin - 1);
    std::vector<std::string> changes;
    for (std::size_t at = row.find("-s \""); at != std::string::npos; at = row.find("-s \"", at + 1))
      changes.push_back(row.substr(at + 4, row.find('"', at + 4) - at - 4));
    return changes;
  }
} // namespace

TEST_CASE("the changes that the tutorial names make the shipped cube each of the six mixes", "[apps][mesoscale]")
{
  const std::string page = content_of(places::sources() + "/doc/tutorials/mesoscale.md");
  for (const apps::beygi::Mix &mix : apps::beygi::mixes())
    {
      INFO(mix.name);
      const auto changes = changes_of(page, mix.name);
      CHECK(changes.empty() == (mix.name == "l-19"));
      const apps::CheckedScene scene = apps::read_scene(places::sources() + "/apps/scenes/mesoscale_cube.prm", changes);
      const apps::MixSection   wanted = mix.section({}),
                             &made    = apps::model_of_kind<apps::UniaxialModel>(scene, "uniaxial").mix;
      CHECK(made.all_aggregates() == Approx(wanted.all_aggregates()).epsilon(1e-12));
      CHECK(made.prescribed_content() == Approx(wanted.prescribed_content()).epsilon(1e-12));
      const Eigen::Vector3d box = Eigen::Vector3d::Constant(0.05);
      const auto            one = made.sizes_in(box).diameters, other = wanted.sizes_in(box).diameters;
      REQUIRE(one.size() == other.size());
      for (std::size_t k = 0; k < one.size(); ++k)
        CHECK(one[k] == Approx(other[k]).epsilon(1e-9));
    }
}

TEST_CASE("ratios of the six mixes are judged by the band of the published simulation, and by its trend",
          "[apps][mesoscale]")
{
  using namespace apps::beygi;
  const auto of = [](const std::string &name) -> const Mix & {
    return *std::find_if(mixes().begin(), mixes().end(), [&](const Mix &mix) { return mix.name == name; });
  };
  const Mix &middle = of("l-12.5"), &largest = of("l-19"), &high = of("h-19");
  // Published: 1.049, 1.006, 1.045, 1.111 and 1.060, 0.992, 1.053, 1.295, within 0.06, the last of each within 0.25.
  CHECK(judgement(middle, 0.1, modulus, 1.042) == "within");
  CHECK(judgement(middle, 0.1, modulus, 1.108) == "within");
  CHECK(judgement(middle, 0.1, modulus, 1.110) == "outside");
  CHECK(judgement(middle, 0.1, modulus, 0.995) == "within, against the trend");
  CHECK(judgement(middle, 0.1, modulus, 0.98) == "outside, against the trend");
  CHECK(judgement(middle, 0.1, tension, 1.006) == "within");
  CHECK(judgement(middle, 0.1, tension, 1.03) == "within, against the trend");
  CHECK(judgement(middle, 0.1, tension, 0.945) == "outside");
  CHECK(judgement(largest, 0.1, compression, 1.061) == "within");
  CHECK(judgement(largest, 0.1, compression, 1.114) == "outside");
  CHECK(judgement(largest, 0.1, fracture, 1.26) == "within");
  CHECK(judgement(largest, 0.1, fracture, 1.55) == "outside");
  CHECK(judgement(largest, 0.1, fracture, 1.04) == "outside");
  // What is not simulated ratio by ratio has its trend alone.
  CHECK(judgement(largest, 0.05, fracture, 1.55).empty());
  CHECK(judgement(largest, 0.05, fracture, 0.94) == "against the trend");
  CHECK(judgement(high, 0.1, tension, 0.5).empty());
  CHECK(judgement(high, 0.1, compression, 0.99) == "against the trend");
  CHECK(judgement(of("l-9.5"), 0.1, modulus, 1).empty());
  CHECK_FALSE(band_of(high, 0.1, modulus));
  CHECK(band_of(middle, 0.1, fracture)->low == Approx(0.861));
}

namespace
{
  /** Work of fracture in the row that begins so. */
  double work_of(const std::string &csv, const std::string &row)
  {
    const std::size_t at = csv.find(row);
    REQUIRE(at != std::string::npos);
    const auto fields = apps::comma_separated(csv.substr(at + 1, csv.find('\n', at + 1) - at - 1));
    REQUIRE(fields.size() > 7);
    return apps::number_in(fields[7]).value();
  }
} // namespace

TEST_CASE("bench mesoscale has a row per mix and geometry, ratios beside the published ones, and needs a mix",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   scenes = places::sources() + "/apps/scenes/";
  // Particles that are too coarse for a good answer, which takes minutes.
  const Outcome outcome =
    run(folder.path(), {"bench", "mesoscale", scenes + "mesoscale_cube.prm", "--geometries", "2", "--mixes", "l-19",
                        "--ductility", "0.1", "--work-until", "0.2", "-s", "Specimen/Generator/Particle radius=0.0022",
                        "-s", "Loading/Grip thickness=0.0045", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(content_of(folder / "bench/mesoscale.csv"),
             Contains("\nl-9.5,0.1,1,254,") && Contains("\nl-9.5,0.1,2,254,") && Contains("\nl-19,0.1,1,134,") &&
               Contains("\nl-19,0.1,2,134,") && !Contains("\nh-"));
  const std::string table = content_of(folder / "bench/mesoscale.md");
  CHECK_THAT(table, Contains("| l-9.5 | 0.1 |") && Contains("| 1 | 1 | 1 | 1 |"));
  CHECK_THAT(table, Contains("(1.149, 1.060)") && Contains("(0.935, 0.992)") && Contains("(1.257, 1.053)") &&
                      Contains("(1.344, 1.295)")); // experiment, simulation
  CHECK_THAT(table, Contains("of 4 ratios within the band of the published simulation"));
  const std::string ratios = content_of(folder / "bench/mesoscale_ratios.csv");
  CHECK_THAT(ratios, Contains("\nl-19,0.1,E,") && Contains("\nl-19,0.1,G_f,") && Contains(",1.149,1.06,1,1.12,\"") &&
                       !Contains("\nl-9.5"));

  // The same geometries, and nearly all of the work, where nothing else is asked for.
  const Outcome followed = run(folder.path(), {"bench", "mesoscale", scenes + "mesoscale_cube.prm", "--quick", "-s",
                                               "Specimen/Generator/Particle radius=0.0022", "-s",
                                               "Loading/Grip thickness=0.0045", "-o", "tail"});
  INFO(followed.err);
  REQUIRE(followed.status == 0);
  for (const char *row : {"\nl-9.5,0.1,1,", "\nl-19,0.1,1,"})
    CHECK(work_of(content_of(folder / "tail/mesoscale.csv"), row) >
          1.1 * work_of(content_of(folder / "bench/mesoscale.csv"), row));

  const Outcome refused = run(folder.path(), {"bench", "mesoscale", scenes + "quick_uniaxial.prm"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Specimen/Mix: this bench needs a box with a mix."));
  CHECK(run(folder.path(), {"bench", "mesoscale", "--mixes", "l-20"}).status == 2);
}
