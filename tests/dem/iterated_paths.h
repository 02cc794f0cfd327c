#pragma once

#include "dem/laws/cpm.h"
#include "dem/statics/quasi_static_path.h"
#include "tests/dem/memory_state.h"
#include "tests/dem/rank_threads.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

/** Quasi-static paths whose linear systems are solved by iteration, beside those by factors, and on ranks. */
namespace iterated_paths
{
  struct Course
  {
    std::vector<dem::QuasiStaticPoint> points;
    dem::LoadedMotion                  motion; ///< at the end
  };

  inline Course
  course_of(const dem::LoadedNetwork &loaded, const dem::CpmParameters &law, const dem::QuasiStaticParameters &p)
  {
    dem::QuasiStaticPath path(loaded, law, p);
    while (!path.finished())
      path.advance();
    return {path.points(), path.motion()};
  }

  inline bool same_bits(const Course &a, const Course &b)
  {
    const auto same = [](const double *x, const double *y, const std::size_t n) {
      return std::memcmp(x, y, n * sizeof(double)) == 0;
    };
    bool all = a.points.size() == b.points.size() && same(a.motion.particles.data(), b.motion.particles.data(),
                                                          static_cast<std::size_t>(a.motion.particles.size()));
    for (std::size_t i = 0; all && i < a.points.size(); ++i)
      all = same(a.points[i].strain.data(), b.points[i].strain.data(), 6) &&
            same(a.points[i].stress.data(), b.points[i].stress.data(), 6) &&
            a.points[i].iterations == b.points[i].iterations && a.points[i].damage == b.points[i].damage;
    return all;
  }

  /** Put an iterated path where one by factors is, which has all of its state but where iterations start. */
  inline void go_on_from(dem::QuasiStaticPath &iterated, dem::QuasiStaticPath &factors)
  {
    MemoryState         own, state;
    MemoryState::Writer of_own(own), of_factors(state);
    iterated.visit_state(of_own);
    factors.visit_state(of_factors);
    state.columns["iteration_starts"] = own.columns.at("iteration_starts");
    MemoryState::Reader reader(state);
    iterated.visit_state(reader);
  }

  /** Each of so many ranks, the first with two threads, has the bits of one alone. */
  inline void same_on_ranks(const dem::LoadedNetwork         &loaded,
                            const dem::CpmParameters         &law,
                            const dem::QuasiStaticParameters &p,
                            const std::vector<std::size_t>   &numbers)
  {
    omp_set_num_threads(1);
    const Course alone = course_of(loaded, law, p);
    REQUIRE(alone.points.size() > 4);
    REQUIRE(alone.points.back().mean_damage > 0);
    for (const std::size_t ranks : numbers)
      {
        std::vector<char> same(ranks, 0);
        rank_threads::run(ranks, [&](const std::shared_ptr<dem::Ranks> &team) {
          omp_set_num_threads(team->rank() == 0 ? 2 : 1);
          dem::QuasiStaticParameters shared = p;
          shared.ranks                      = team.get();
          same[team->rank()]                = same_bits(course_of(loaded, law, shared), alone);
        });
        INFO(ranks << " ranks");
        CHECK(std::count(same.begin(), same.end(), 1) == static_cast<std::ptrdiff_t>(ranks));
      }
  }
} // namespace iterated_paths
