// Elements of a structure that become particles where these would be damaged, through the program.
#include "apps/process/mpi_session.h"
#include "apps/runs/coupled/element_region.h"
#include "tests/apps/structure_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::string beam = places::sources() + "/apps/scenes/bending_with_core.prm";

  /** Packing and stiffness of the shipped beam, made once. */
  std::vector<std::string> beam_of(const ScratchFolder &made)
  {
    results_of(made, beam, {"Path/End=1e-6"}, {"control"});
    return {"Specimen/Source=file", "Specimen/File=" + (made / "results/packing.h5").string(),
            "Continuum/Materials/concrete/anisotropic elastic/Homogenised=false",
            "Continuum/Materials/concrete/anisotropic elastic/Stiffness file=" +
              (made / "results/homogenised.json").string()};
  }

  /** The same with half of its core, which may grow to the whole of it. */
  std::vector<std::string> half_core(std::vector<std::string> changes, const char *promote_at)
  {
    for (const std::string &more :
         {std::string("Handshakes/core/Low=0.055, -1, -1"), std::string("Handshakes/core/High=0.065, 1, 1"),
          std::string("Handshakes/core/Promotion reach=0.005"),
          std::string("Handshakes/core/Promote at=") + promote_at})
      changes.push_back(more);
    return changes;
  }

  std::vector<std::string> with(std::vector<std::string> changes, const std::string &more)
  {
    changes.push_back(more);
    return changes;
  }
} // namespace

TEST_CASE("Where nothing is damaged, elements that have become particles leave what there is with these from the start",
          "[apps][structure][promotion][volume][slow]")
{
  const ScratchFolder            made, grown_folder, whole_folder;
  const std::vector<std::string> packing = beam_of(made), once = with(packing, "Path/End=2e-6");
  for (const char *method : {"constrained", "multipliers"})
    {
      INFO(method);
      const std::string set   = std::string("Handshakes/core/Method=") + method;
      const Results     grown = results_of(grown_folder, beam, half_core(with(once, set), "1e-6"), {"control"}),
                    whole     = results_of(whole_folder, beam, with(once, set), {"control"});
      CHECK(grown.summary["handshakes"]["core"]["promoted"] == 16);
      CHECK(grown.summary["cost"]["particles"] == whole.summary["cost"]["particles"]);
      CHECK(grown.summary["cost"]["links"] == whole.summary["cost"]["links"]);
      for (const char *column : {"reaction_load_z", "reaction_left_support_z", "opening", "energy_stored"})
        CHECK(grown.series.column(column).back() == Approx(whole.series.column(column).back()).epsilon(1e-6));
      // What has been put in with the particles is all that the work does not know of.
      const double work = grown.series.column("energy_work").back();
      CHECK(std::fabs(grown.series.column("energy_promoted").back()) > 1e-4 * work);
      CHECK(std::fabs(grown.series.column("energy_residual").back()) < 1e-6 * work);
      CHECK(whole.series.column("energy_residual").back() == Approx(0).margin(1e-6 * work));
    }
}

TEST_CASE("A crack whose particles come with it bears what it bears where they were from the start",
          "[apps][structure][promotion][volume][slow]")
{
  const ScratchFolder            made, grown_folder, whole_folder;
  const std::vector<std::string> packing = with(beam_of(made), "Path/Stop fraction=0.9");
  const Results                  grown   = results_of(grown_folder, beam, half_core(packing, "0.5"), {"control"}),
                whole                    = results_of(whole_folder, beam, packing, {"control"});
  const int promoted                     = grown.summary["handshakes"]["core"]["promoted"];
  CHECK(promoted > 0);
  CHECK(peak_load(grown) == Approx(peak_load(whole)).epsilon(0.02));
  CHECK(grown.summary["handshakes"]["core"]["damaged"] == 0);
  CHECK(grown.summary["energy"]["balance_error"] < 0.01);
  CHECK(grown.summary["points"]["promotion"] > 0);
  // Elements never come back, and each point says how many have gone.
  const auto &count = grown.series.column("core_promoted");
  CHECK(std::is_sorted(count.begin(), count.end()));
  CHECK(count.back() == promoted);
  // What the force loses at it, the load factor held, is reported.
  const auto &force   = grown.series.column("force_of_load_factor");
  double      largest = 0;
  for (std::size_t row = 1; row < count.size(); ++row)
    if (count[row] > count[row - 1])
      if (const double change = force[row] / force[row - 1] - 1; std::fabs(change) > std::fabs(largest))
        largest = change;
  CHECK(largest != 0);
  CHECK(grown.summary["promotion"]["largest_change_of_force"]["value"] == Approx(largest).epsilon(1e-9));
  CHECK_FALSE(whole.summary.contains("promotion"));
}

TEST_CASE("An interrupted or killed path along which elements become particles goes on to the same bits",
          "[apps][structure][promotion][volume][slow][S13]")
{
  const ScratchFolder      made, folder;
  std::vector<std::string> words = {"run", beam};
  for (const std::string &change : half_core(beam_of(made), "0.3"))
    words.insert(words.end(), {"-s", change});
  for (const char *change : {"Output/Checkpoint interval=0.01", "Output/Points per snapshot=5", "Path/End=3e-5"})
    words.insert(words.end(), {"-s", change});
  goes_on_to_the_same_bits(folder, {words, {"solid/solid_000002.vtu", "checkpoint.h5"}, kept_of_structure},
                           {SIGINT, SIGKILL});
}

TEST_CASE("Promotion that cannot be is refused by name", "[apps][structure][promotion][volume][slow]")
{
  const ScratchFolder            made, folder;
  const std::vector<std::string> packing = beam_of(made);
  const auto                     refused = [&](const std::vector<std::string> &changes, const char *words) {
    std::vector<std::string> all = half_core(packing, "0.5");
    all.insert(all.end(), changes.begin(), changes.end());
    is_refused(folder, beam, all, words);
  };
  REQUIRE(outcome_of(folder, "check", beam, half_core(packing, "0.5")).status == 0);
  refused({"Handshakes/core/Promotion reach=0.02"}, "no particle of the specimen lies in the element around");
  refused({"Handshakes/core/Promote at=1.5"}, "Promote at");
  refused({"Handshakes/core/Promotion reach=0"}, "Promotion reach");
  refused({"Continuum/Body force/z=-1e3*t"}, "elements that become particles would lose it");
  is_refused(folder, beam, with(packing, "Handshakes/core/Promote at=0.5"), "Promotion reach");
}

TEST_CASE("Sets of elements are found by their places, and one whose corners all belong to a set is part of it",
          "[apps][structure][promotion][volume]")
{
  apps::start_mpi();
  apps::MeshSection mesh;
  mesh.source         = apps::MeshSection::Source::box;
  mesh.box_size       = {3, 3, 0};
  mesh.box_divisions  = {3, 3, 1};
  const auto elements = apps::elements_of(mesh, 2);
  const auto at       = [&](const double x, const double y) { return elements->with_centre({x, y, 0}); };
  CHECK(elements->centre_of(at(1.4, 2.6)).isApprox(Eigen::Vector3d(1.5, 2.5, 0), 1e-12));
  const auto left = elements->within([](const Eigen::Vector3d &place) { return place.x() < 1.5; });
  CHECK(left == coupling::MeshElements::Set{at(0.5, 0.5), at(0.5, 1.5), at(0.5, 2.5)});
  // Around the middle.
  coupling::MeshElements::Set ring;
  for (const double x : {0.5, 1.5, 2.5})
    for (const double y : {0.5, 1.5, 2.5})
      if (x != 1.5 || y != 1.5)
        ring.insert(at(x, y));
  CHECK(elements->filled(ring).size() == 9);
  CHECK(elements->filled(left) == left);
  // Those at a corner of the mesh, and those that come nearer to it than a length.
  CHECK(elements->around({Eigen::Vector3d(0, 0, 0)}, 0.5) ==
        coupling::MeshElements::Set{at(0.5, 0.5), at(1.5, 0.5), at(0.5, 1.5), at(1.5, 1.5)});
  CHECK(elements->around({Eigen::Vector3d(0, 0, 0)}, 1.2).size() == 8);
  CHECK(elements->around({Eigen::Vector3d(0, 0, 0)}, 1.5).size() == 9);
  CHECK(elements->distance_from(left, "left")({2.5, 7, 0}) == Approx(std::hypot(1.5, 4)));
  ring.insert(at(1.5, 1.5));
  CHECK_THROWS_WITH(elements->distance_from(ring, "all"), Contains("share no face with others"));
}
