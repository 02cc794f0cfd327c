// Where the published beam breaks first, by the program and by one that shares nothing with it.
#include "tests/verification/blow_on_discs.h"
#include "tests/verification/scene_results.h"

#include <algorithm>
#include <cmath>

namespace
{
  /** Bonds that are gone at the limit strain: the softening branch of both materials all but left out. */
  SceneResults brittle_beam(const std::string &scene, const std::string &section, std::vector<std::string> changes)
  {
    for (const char *material : {"concrete", "steel"})
      for (const char *entry : {"Damage law=linear", "Relative ductility=1.001"})
        changes.push_back(section + "Materials/" + material + "/CPM/" + entry);
    return results_of(scene, changes);
  }

  /** Breaks of the log, in the order of time. */
  std::vector<blow_on_discs::Break> logged(const postprocess::CsvTable &log)
  {
    std::vector<blow_on_discs::Break> found;
    for (std::size_t row = 0; row < log.rows(); ++row)
      found.push_back({log.column("time")[row], log.column("x")[row], log.column("y")[row]});
    return found;
  }

  /** The first breaks of both programs are the same bonds, at times that differ by less than this. */
  void same_beginning(const std::vector<blow_on_discs::Break> &ours,
                      const std::vector<blow_on_discs::Break> &theirs,
                      const std::size_t                        count,
                      const double                             apart)
  {
    REQUIRE(ours.size() >= count);
    REQUIRE(theirs.size() >= count);
    for (std::size_t i = 0; i < count; ++i)
      {
        const blow_on_discs::Break &here = ours[i];
        INFO("break " << i << " at " << here.time << " s, (" << here.x << ", " << here.y << ")");
        CHECK(std::any_of(theirs.begin(), theirs.end(), [&](const blow_on_discs::Break &there) {
          return std::hypot(here.x - there.x, here.y - there.y) < 1e-3 && std::fabs(here.time - there.time) < apart;
        }));
      }
  }

  double lowest(const std::vector<blow_on_discs::Break> &breaks)
  {
    return std::min_element(breaks.begin(), breaks.end(), [](const auto &a, const auto &b) { return a.y < b.y; })->y;
  }
} // namespace

TEST_CASE(
  "The published beam breaks first at the bonds that a program of the formulas alone names, in the row under the blow",
  "[verification][coupled]")
{
  const std::string meshes = places::sources() + "/meshes/";
  for (const auto &[scene, section] : {std::pair("beam_of_particles", ""), std::pair("beam_with_core", "Particles/")})
    {
      INFO(scene);
      const SceneResults found = brittle_beam(scene, section, {"Time/End time=2.5e-4"});
      const auto         ours  = logged(found.breaks);
      REQUIRE(ours.size() > 10);
      const double step = found.breaks.column("time")[0] / found.breaks.column("step")[0];
      const auto theirs = blow_on_discs::breaks({meshes + "hexagonal_beam.txt", meshes + "impactor.txt", 2.5e-4, step});
      same_beginning(ours, theirs, 9, 6e-6); // less than three of the steps of the beam of particles
      CHECK(std::fabs(ours[0].x) < 0.005);
      CHECK(ours[0].y > 0.11); // of 0.12; the published description has it at the lower face
      CHECK(theirs[0].y > 0.11);
      CHECK(lowest(ours) > 0.04); // nothing in the lower third yet
      CHECK(lowest(theirs) > 0.04);
    }
}

TEST_CASE("The published beam, hit so slowly that its top row bears the blow, breaks first at its lower face under it",
          "[verification][coupled][slow]")
{
  const std::string meshes = places::sources() + "/meshes/";
  constexpr double  until  = 3.5e-3;
  const auto        begins = [](const std::vector<blow_on_discs::Break> &breaks) {
    REQUIRE(!breaks.empty());
    INFO("first break at " << breaks[0].time << " s, (" << breaks[0].x << ", " << breaks[0].y << ")");
    CHECK(breaks[0].y < 0.01); // the lowest row
    CHECK(std::fabs(breaks[0].x) < 0.03);
  };
  begins(blow_on_discs::breaks({meshes + "hexagonal_beam.txt", meshes + "impactor.txt", until, 2e-6, 3}));
  for (const auto &[scene, section] : {std::pair("beam_of_particles", ""), std::pair("beam_with_core", "Particles/")})
    {
      INFO(scene);
      begins(logged(brittle_beam(scene, section,
                                 {"Time/End time=" + std::to_string(until),
                                  std::string(section) + "Initial velocity/impactor/Velocity y=-3"})
                      .breaks));
    }
}
