// What the first of several ranks is told to write is what it would read alone: doc/theory/ranks.md, 3.
#include "dem/specimen/told_to_first.h"

#include "clusters.h"
#include "dem/observation/crack.h"
#include "dem/observation/state_columns.h"
#include "dem/specimen/rank_shares.h"
#include "rank_threads.h"
#include "shown_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace shown_bodies;

namespace
{
  /** All that is told, by name. */
  using Told = std::map<std::string, std::vector<double>>;

  template <typename Matrix>
  void put(std::vector<double> &numbers, const Matrix &values)
  {
    numbers.insert(numbers.end(), values.data(), values.data() + values.size());
  }

  void put_particles(Told &told, const dem::ParticleOutput &of)
  {
    for (std::size_t i = 0; i < of.position.size(); ++i)
      {
        std::vector<double> &numbers = told["particles"];
        put(numbers, of.position[i]);
        put(numbers, of.displacement[i]);
        numbers.insert(numbers.end(),
                       {of.radius[i], of.damage[i], of.volume[i], static_cast<double>(of.held[i]),
                        static_cast<double>(of.broken_links[i]), of.material.empty() ? -1.0 : of.material[i]});
      }
  }

  void put_all_particles(Told &told, const dem::ParticleOutput &of)
  {
    for (std::size_t i = 0; i < of.position.size(); ++i)
      {
        std::vector<double> &numbers = told["all of particles"];
        for (const auto *column : {&of.position, &of.displacement, &of.velocity, &of.angular_velocity})
          put(numbers, (*column)[i]);
        put(numbers, of.stress[i]);
        numbers.insert(numbers.end(),
                       {of.radius[i], of.mass[i], of.damage[i], of.volume[i], static_cast<double>(of.held[i]),
                        static_cast<double>(of.broken_links[i]), of.material.empty() ? -1.0 : of.material[i]});
      }
  }

  void put_shown_links(Told &told, const dem::LinkOutput &of)
  {
    told["pairs"] = {of.pair.begin(), of.pair.end()};
    told["kinds"] = {of.kind.begin(), of.kind.end()};
    for (const auto &[first, second] : of.ends)
      told["ends"].insert(told["ends"].end(), {static_cast<double>(first), static_cast<double>(second)});
    std::vector<double> &numbers = told["shown of links"];
    for (const auto *column :
         {&of.normal_force, &of.shear_force, &of.normal_stress, &of.shear_stress, &of.normal_strain, &of.damage})
      numbers.insert(numbers.end(), column->begin(), column->end());
    for (std::size_t c = 0; c < of.history.size(); ++c)
      told[of.quantities.at(c).name + " of links"] = of.history[c];
    for (std::size_t g = 0; g < of.glue.particle.size(); ++g)
      told["shown glue"].insert(told["shown glue"].end(), {of.glue.normal_stress[g], of.glue.shear_stress[g]});
  }

  /** What an image of a link is found from. */
  void put_seen(Told &told, const dem::LinkOutput &some)
  {
    for (std::size_t l = 0; l < some.ends.size(); ++l)
      {
        std::vector<double> &numbers = told["seen"];
        numbers.insert(numbers.end(), {static_cast<double>(some.ends[l][0]), static_cast<double>(some.ends[l][1]),
                                       static_cast<double>(some.kind[l])});
        put(numbers, some.load[l].branch);
      }
  }

  void put_damaged(Told &told, const dem::LinkOutput &of)
  {
    for (std::size_t l = 0; l < of.ends.size(); ++l)
      if (of.kind[l] != dem::LinkOutput::contact && of.damage[l] > 0)
        {
          std::vector<double> &numbers = told["damaged"];
          numbers.insert(numbers.end(),
                         {static_cast<double>(of.ends[l][0]), static_cast<double>(of.ends[l][1]),
                          static_cast<double>(of.kind[l]), of.pair.empty() ? -1.0 : of.pair[l], of.damage[l]});
          put(numbers, of.load[l].branch);
        }
    for (std::size_t g = 0; g < of.glue.particle.size(); ++g)
      {
        std::vector<double> &numbers = told["glue"];
        numbers.insert(numbers.end(), {static_cast<double>(of.glue.particle[g]), static_cast<double>(of.glue.torn[g]),
                                       of.glue.normal_force[g], of.glue.damage[g]});
        put(numbers, of.glue.anchor[g]);
      }
  }

  void put_crack(Told &told, const dem::Crack &crack)
  {
    told["crack"] = {static_cast<double>(crack.links), static_cast<double>(crack.cracked),
                     static_cast<double>(crack.broken), crack.area, crack.area_at_grips};
  }

  /** A line for each that is neither apart nor gone, in their order. */
  std::vector<double> row_of(const dem::LinkOutput &links, const std::size_t l)
  {
    return {static_cast<double>(links.ends[l][0]), static_cast<double>(links.ends[l][1]), links.normal_force[l]};
  }

  /** Without columns of what there is none of. */
  Told nonempty(Told told)
  {
    for (auto at = told.begin(); at != told.end();)
      at = at->second.empty() ? told.erase(at) : std::next(at);
    return told;
  }

  /** Read by one that has all. */
  Told read_whole(const dem::ObservedSpecimen &specimen)
  {
    Told                          told;
    const dem::ParticleOutput     particles = specimen.particles();
    const dem::LinkOutput         links     = specimen.links();
    const dem::SpecimenParameters made      = specimen.parameters();
    dem::each_column(dem::discrete_state(specimen), [&](const dem::StateColumn column, const auto &numbers) {
      told["column " + std::to_string(static_cast<int>(column))] = numbers;
    });
    put_particles(told, particles);
    put_all_particles(told, particles);
    put_damaged(told, links);
    put_shown_links(told, links);
    put_seen(told, links);
    put_crack(told, dem::measure_crack(particles, links, {made.physics.dimension, made.density, made.thickness}));
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      put(told["forces"], Eigen::Map<const Eigen::Vector3d>(row_of(links, l).data()).eval());
    return nonempty(told);
  }

  /** Told part by part; the first rank has something, all have what is added up. */
  Told read_in_parts(const dem::ObservedSpecimen &specimen)
  {
    Told told;
    dem::each_column(specimen, [&](const dem::StateColumn column, const std::vector<double> &numbers) {
      if (!numbers.empty())
        told["column " + std::to_string(static_cast<int>(column))] = numbers;
    });
    put_particles(told, dem::particles_for_first(specimen));
    put_all_particles(told, dem::all_particles_for_first(specimen));
    put_shown_links(told, dem::shown_links_for_first(specimen));
    const dem::LinkOutput again =
      dem::shown_links_for_first(specimen, [&](const dem::LinkOutput &some) { put_seen(told, some); });
    if (!again.load.empty())
      throw std::logic_error("loads are told again");
    put_damaged(told, dem::damaged_links_for_first(specimen));
    put_crack(told, dem::measure_crack(specimen));
    dem::tell_first_of_links(
      specimen,
      [](const dem::LinkOutput &some, const std::size_t l, std::vector<double> &numbers) {
        const std::vector<double> row = row_of(some, l);
        numbers.insert(numbers.end(), row.begin(), row.end());
      },
      [&](const std::vector<double> &numbers) {
        if (!numbers.empty())
          told["forces"].insert(told["forces"].end(), numbers.begin(), numbers.end());
      });
    return nonempty(told);
  }

  constexpr int moments = 3; // at the start, half way and at the end

  std::vector<Told> alone(const Case &each)
  {
    omp_set_num_threads(1);
    const auto        body = each.make();
    std::vector<Told> found;
    for (int moment = 0; moment < moments; ++moment)
      {
        if (moment > 0)
          body->advance(each.steps / (moments - 1));
        found.push_back(read_whole(body->specimen()));
        CHECK((read_in_parts(body->specimen()) == found.back()));
      }
    return found;
  }

  /** What each rank is told. @param moved ranges after so many steps; 0: never */
  std::vector<std::vector<Told>> on_ranks(const Case &each, const std::size_t count, const std::int64_t moved)
  {
    std::vector<std::vector<Told>> found(count);
    rank_threads::run(count, [&](const std::shared_ptr<dem::Ranks> &ranks) {
      omp_set_num_threads(1);
      const auto body = each.make();
      body->specimen().share_among(ranks, moved);
      for (int moment = 0; moment < moments; ++moment)
        {
          if (moment > 0)
            body->advance(each.steps / (moments - 1));
          found[ranks->rank()].push_back(read_in_parts(body->specimen()));
        }
    });
    return found;
  }

  void check(const Case &each, const std::vector<std::pair<std::size_t, std::int64_t>> &ways)
  {
    const std::vector<Told> whole = alone(each);
    for (const auto &[count, moved] : ways)
      {
        INFO(each.name << " on " << count << " ranks, moved every " << moved);
        const auto found = on_ranks(each, count, moved);
        for (std::size_t moment = 0; moment < moments; ++moment)
          {
            for (const auto &[name, numbers] : whole[moment])
              {
                INFO(name << " at moment " << moment);
                const auto told = found[0][moment].find(name);
                REQUIRE(told != found[0][moment].end());
                CHECK((told->second == numbers));
              }
            CHECK(found[0][moment].size() == whole[moment].size());
            for (std::size_t r = 1; r < count; ++r)
              CHECK((found[r][moment] == Told{{"crack", whole[moment].at("crack")}}));
          }
      }
  }

  std::unique_ptr<Body> of_two_materials()
  {
    return std::make_unique<Free>(
      thrown_apart(dem::LinkMaterials::by_pair({twice(parallel()), twice(point()), twice(flat())}, {0, 1, 2})));
  }
} // namespace

TEST_CASE("what the first rank is told of a specimen is what one reads of it, and all learn what is added up",
          "[dem][ranks]")
{
  check({"concrete that is pulled apart", [] { return std::make_unique<Pulled>(); }, 800},
        {{1, 0}, {2, 0}, {3, 50}, {5, 0}});
  check({"grains that fall into a box", falling_grains, 600}, {{2, 0}, {3, 50}});
  check({"three laws in two materials", of_two_materials, 150}, {{2, 0}, {3, 50}});
}

TEST_CASE("the first rank is told of cells, of glue, and of fewer bricks than ranks", "[dem][ranks]")
{
  check({"a cell under stresses", [] { return std::make_unique<CellUnderStress>(); }, 600}, {{3, 50}});
  check({"eight spheres", small_cell, 300}, {{3, 0}});
  check({"a block torn from a plate", torn_from_plate, 100}, {{2, 0}, {3, 50}});
}

TEST_CASE("no rank takes memory for others' links or motion while the first is told of all", "[dem][ranks]")
{
  std::int64_t before = 0, most = 0, whole = 0;
  int          columns = 0;
  rank_threads::run(2, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    omp_set_num_threads(1);
    dem::Specimen body(cluster::cubic_lattice(32, 32, 32, 1e-3), cluster::bonded(1.5), cluster::concrete());
    body.set_velocity(0, Vector3d(1, 0, 0), Vector3d::Zero());
    body.share_among(ranks);
    body.advance(20);
    const auto in_all = [&] {
      std::int64_t sum = 0;
      for (const dem::RankMemory &of : dem::memory_of_ranks(body))
        sum += of.now;
      return sum;
    };
    const auto note = [&](std::int64_t &to) {
      if (const std::int64_t sum = in_all(); ranks->rank() == 0)
        to = std::max(to, sum);
    };
    note(before);
    dem::each_column(body, [&](dem::StateColumn, const std::vector<double> &) {
      note(most);
      columns += ranks->rank() == 0;
    });
    dem::particles_for_first(body);
    dem::all_particles_for_first(body);
    dem::shown_links_for_first(body);
    dem::damaged_links_for_first(body);
    dem::measure_crack(body);
    note(most);
    if (ranks->rank() == 0)
      whole = static_cast<std::int64_t>(body.bytes());
  });
  CHECK(columns == 10);
  CHECK(most <= before);
  CHECK(before < 2 * whole);
}

TEST_CASE("what the first rank is told of a specimen is counted as sent", "[dem][ranks]")
{
  std::vector<std::int64_t> more(2, 0);
  rank_threads::run(2, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    omp_set_num_threads(1);
    dem::Specimen body = thrown_apart(parallel());
    body.share_among(ranks);
    body.advance(3);
    const auto before = body.shares();
    dem::all_particles_for_first(body);
    dem::shown_links_for_first(body);
    const auto after = body.shares();
    if (ranks->rank() == 0)
      for (std::size_t r = 0; r < 2; ++r)
        more[r] = after[r].bytes - before[r].bytes;
  });
  CHECK(more[0] == 0);
  CHECK(more[1] > 0);
}
