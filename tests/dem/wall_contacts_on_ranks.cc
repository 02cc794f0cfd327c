// Ranks find the contacts of their own particles with walls, and all know what walls bear: doc/theory/ranks.md, 3.
#include "base/errors.h"
#include "dem/specimen/specimen.h"
#include "rank_threads.h"
#include "shared_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <string>
#include <vector>

using Eigen::Vector3d;
using namespace shared_bodies;

namespace
{
  void append(std::vector<double> &row, const std::vector<Vector3d> &vectors)
  {
    for (const Vector3d &v : vectors)
      row.insert(row.end(), v.data(), v.data() + 3);
  }

  /** What all ranks know of walls in a step, without telling each other more. */
  std::vector<double> borne(const dem::Specimen &specimen)
  {
    std::vector<double> row;
    for (std::size_t s = 0; s < specimen.surfaces().size(); ++s)
      {
        const dem::Surface &surface = specimen.surfaces().at(s);
        append(row, {surface.total_force, surface.total_moment, surface.momentum, surface.angular_momentum});
        append(row, surface.place);
        append(row, surface.force);
        append(row, surface.impulse);
        append(row, surface.turn_impulse);
        row.insert(row.end(), surface.stiffness.begin(), surface.stiffness.end());
        row.insert(row.end(), {surface.work, surface.made, surface.along, static_cast<double>(surface.touching)});
      }
    return row;
  }

  std::vector<std::vector<double>> borne_in_steps(Body &body, const std::int64_t steps)
  {
    std::vector<std::vector<double>> rows;
    for (std::int64_t s = 0; s < steps; ++s)
      {
        body.advance(1);
        rows.push_back(borne(body.specimen()));
      }
    return rows;
  }
} // namespace

TEST_CASE("each rank finds the contacts of its own particles with walls, and all know in every step what walls bear",
          "[dem][ranks]")
{
  constexpr std::int64_t steps = 100;
  for (const Make &make : {Make(falling_grains), Make(grains_under_lid)})
    {
      omp_set_num_threads(1);
      const auto alone = make();
      const auto whole = borne_in_steps(*alone, steps);
      const auto total = static_cast<std::int64_t>(alone->specimen().counts().wall_contacts);
      CHECK(total > 90);
      for (const std::size_t count : {2, 3, 5, 8})
        {
          std::vector<std::int64_t>  differ(count);
          std::vector<dem::RankWork> work;
          rank_threads::run(count, [&](const std::shared_ptr<dem::Ranks> &ranks) {
            omp_set_num_threads(ranks->rank() == 0 ? 2 : 1);
            const auto body = make();
            body->specimen().share_among(ranks);
            const auto rows = borne_in_steps(*body, steps);
            for (std::size_t s = 0; s < rows.size(); ++s)
              differ[ranks->rank()] += rows[s] != whole[s];
            if (const auto shares = body->specimen().shares(); ranks->rank() == 0)
              work = shares;
          });
          INFO(count << " ranks");
          CHECK(differ == std::vector<std::int64_t>(count, 0));
          std::int64_t sum = 0, most = 0;
          for (const dem::RankWork &of : work)
            {
              sum += of.wall_contacts;
              most = std::max(most, of.wall_contacts);
            }
          CHECK(sum == total);
          CHECK(most < total);
        }
    }
}

TEST_CASE("a particle that sinks into a wall stops all ranks by the same words", "[dem][ranks]")
{
  std::vector<std::string> words(3);
  rank_threads::run(3, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    omp_set_num_threads(1);
    dem::Packing  packing = cluster::cubic_lattice(10, 10, 10, 1e-3);
    dem::Specimen specimen(packing, grains::falling(), grains::rough());
    specimen.share_among(ranks);
    dem::SurfaceParameters floor;
    floor.name    = "floor";
    floor.mesh    = dem::plate(Vector3d(-0.01, -0.01, -1e-3), Vector3d(0.05, 0, 0), Vector3d(0, 0.05, 0));
    floor.contact = [] {
      auto soft              = grains::rough();
      soft.effective_modulus = 1;
      return soft;
    }();
    specimen.surfaces().add(floor);
    specimen.set_velocity(37, Vector3d(0, 0, -20), Vector3d::Zero());
    try
      {
        specimen.advance(1000);
      }
    catch (const base::NumericalError &error)
      {
        words[ranks->rank()] = error.what();
      }
  });
  CHECK_THAT(words[0], Catch::Contains("particle 38 has sunk into wall floor"));
  CHECK(words == std::vector<std::string>(3, words[0]));
}
