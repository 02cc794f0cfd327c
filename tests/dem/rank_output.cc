// What each of several ranks shows of a specimen is together what one shows: doc/theory/ranks.md, 3.
#include "dem/specimen/rank_output.h"

#include "dem/observation/link_images.h"
#include "rank_threads.h"
#include "shown_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace shown_bodies;

namespace
{
  using Row = std::vector<double>;

  template <typename Matrix>
  void put(Row &row, const Matrix &values)
  {
    row.insert(row.end(), values.data(), values.data() + values.size());
  }

  Row row_of(const dem::ParticleOutput &of, const std::size_t i)
  {
    Row row{of.radius[i],
            of.mass[i],
            static_cast<double>(of.held[i]),
            of.damage[i],
            static_cast<double>(of.broken_links[i]),
            of.volume[i],
            of.material.empty() ? -1.0 : of.material[i]};
    for (const auto *column : {&of.position, &of.displacement, &of.velocity, &of.angular_velocity})
      put(row, (*column)[i]);
    put(row, of.stress[i]);
    return row;
  }

  /** Of an end of a link: which particle it is, and what a file shows of it. */
  void put_end(Row &row, const dem::ParticleOutput &points, const std::size_t place, const std::size_t number)
  {
    row.push_back(static_cast<double>(number));
    row.push_back(points.radius[place]);
    put(row, points.position[place]);
    put(row, points.displacement[place]);
  }

  /** @param number of a point in the packing */
  template <typename Number>
  Row row_of_link(const dem::LinkOutput             &of,
                  const std::size_t                  l,
                  const dem::ParticleOutput         &points,
                  const std::vector<dem::LinkImage> &images,
                  const Number                      &number)
  {
    Row row{static_cast<double>(of.kind[l]),
            of.normal_force[l],
            of.shear_force[l],
            of.normal_stress[l],
            of.shear_stress[l],
            of.normal_strain[l],
            of.damage[l],
            of.strength_damage[l],
            of.dissipated[l],
            of.pair.empty() ? -1.0 : of.pair[l]};
    for (const std::size_t end : of.ends[l])
      put_end(row, points, end, number(end));
    for (const std::vector<double> &column : of.history)
      row.push_back(column[l]);
    for (const auto *part : {&of.load[l].first, &of.load[l].branch, &of.load[l].contact, &of.load[l].force})
      put(row, *part);
    if (!images.empty())
      put(row, images[l].now);
    return row;
  }

  template <typename Number>
  Row row_of_glue(const dem::GlueOutput     &of,
                  const std::size_t          g,
                  const dem::ParticleOutput &points,
                  const Number              &number)
  {
    Row row{static_cast<double>(of.surface[g]),
            static_cast<double>(of.torn[g]),
            of.normal_force[g],
            of.shear_force[g],
            of.normal_stress[g],
            of.shear_stress[g],
            of.normal_strain[g],
            of.damage[g]};
    put_end(row, points, of.particle[g], number(of.particle[g]));
    put(row, of.anchor[g]);
    put(row, of.moved[g]);
    return row;
  }

  /** Particles by their numbers in the packing, links in the order of one rank. */
  struct Rows
  {
    std::map<std::int64_t, Row> particles;
    std::vector<Row>            links;
    std::size_t                 broken = 0, to_images = 0, glue = 0;

    bool operator==(const Rows &other) const { return particles == other.particles && links == other.links; }
  };

  Rows rows_of(const dem::ObservedSpecimen &specimen)
  {
    const dem::ParticleOutput particles = specimen.particles();
    const dem::LinkOutput     links     = specimen.links();
    const auto                images    = dem::link_images(specimen, links, particles);
    const auto                itself    = [](const std::size_t number) { return number; };
    Rows                      rows;
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      rows.particles[static_cast<std::int64_t>(i)] = row_of(particles, i);
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      {
        rows.links.push_back(row_of_link(links, l, particles, images, itself));
        rows.broken += links.kind[l] == dem::LinkOutput::broken;
        rows.to_images += !images.empty() && images[l].is_other();
      }
    for (std::size_t g = 0; g < links.glue.particle.size(); ++g)
      rows.links.push_back(row_of_glue(links.glue, g, particles, itself));
    rows.glue = links.glue.particle.size();
    return rows;
  }

  /** What one rank shows, and images of its links. */
  struct Piece
  {
    dem::RankOutput             shown;
    std::vector<dem::LinkImage> images;
  };

  Piece piece_of(const dem::ObservedSpecimen &specimen, const std::size_t rank, const std::size_t ranks)
  {
    dem::RankOutput shown(specimen, rank, ranks);
    auto            images = dem::link_images(specimen, shown.links, shown.points);
    return {std::move(shown), std::move(images)};
  }

  /** Together: a link that several showed would be there twice. */
  Rows united(const std::vector<std::optional<Piece>> &pieces)
  {
    Rows                                      rows;
    std::vector<std::pair<std::int64_t, Row>> links;
    std::size_t                               particles = 0;
    for (const std::optional<Piece> &piece : pieces)
      {
        const auto &[shown, images] = *piece;
        const auto number           = [&shown = shown](const std::size_t point) {
          return static_cast<std::size_t>(shown.number_of_point[point]);
        };
        particles += shown.number.size();
        for (std::size_t i = 0; i < shown.number.size(); ++i)
          rows.particles[shown.number[i]] = row_of(shown.particles, i);
        const std::size_t between = shown.links.ends.size();
        for (std::size_t l = 0; l < between; ++l)
          links.emplace_back(shown.line[l], row_of_link(shown.links, l, shown.points, images, number));
        for (std::size_t g = 0; g < shown.links.glue.particle.size(); ++g)
          links.emplace_back(shown.line[between + g], row_of_glue(shown.links.glue, g, shown.points, number));
      }
    CHECK(particles == rows.particles.size());
    std::sort(links.begin(), links.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    for (auto &[line, row] : links)
      rows.links.push_back(std::move(row));
    return rows;
  }

  /** At the start, half way and at the end. */
  using Moments         = std::vector<Rows>;
  constexpr int moments = 3;

  Moments alone(const Case &each)
  {
    omp_set_num_threads(1);
    const auto body = each.make();
    Moments    seen{rows_of(body->specimen())};
    while (seen.size() < moments)
      {
        body->advance(each.steps / (moments - 1));
        seen.push_back(rows_of(body->specimen()));
      }
    return seen;
  }

  std::vector<std::pair<std::int64_t, std::int64_t>> sent_by(const dem::ObservedSpecimen &specimen)
  {
    std::vector<std::pair<std::int64_t, std::int64_t>> sent;
    for (const dem::RankWork &of : specimen.shares())
      sent.emplace_back(of.messages, of.bytes);
    return sent;
  }

  /** @param moved ranges after so many steps; 0: never */
  Moments on_ranks(const Case &each, const std::size_t count, const std::int64_t moved)
  {
    std::vector<std::vector<std::optional<Piece>>> seen(moments, std::vector<std::optional<Piece>>(count));
    std::vector<std::string>                       spoke(count);
    rank_threads::run(count, [&](const std::shared_ptr<dem::Ranks> &ranks) {
      omp_set_num_threads(1);
      const auto body = each.make();
      body->specimen().share_among(ranks, moved);
      for (int moment = 0; moment < moments; ++moment)
        {
          if (moment > 0)
            body->advance(each.steps / (moments - 1));
          const auto before                                     = sent_by(body->specimen());
          seen[static_cast<std::size_t>(moment)][ranks->rank()] = piece_of(body->specimen(), ranks->rank(), count);
          if (sent_by(body->specimen()) != before)
            spoke[ranks->rank()] += "spoke ";
        }
    });
    CHECK(spoke == std::vector<std::string>(count));
    Moments found;
    for (const auto &pieces : seen)
      found.push_back(united(pieces));
    return found;
  }

  void check(const Case &each, const Moments &whole, const std::size_t count, const std::int64_t moved)
  {
    INFO(each.name << " on " << count << " ranks");
    const Moments found = on_ranks(each, count, moved);
    for (std::size_t moment = 0; moment < moments; ++moment)
      CHECK(found[moment] == whole[moment]);
  }

} // namespace

TEST_CASE("what ranks show is together what one shows, broken links and contacts among it, and nothing is sent for it",
          "[dem][ranks]")
{
  const auto two_materials = [] {
    return std::make_unique<Free>(
      thrown_apart(dem::LinkMaterials::by_pair({twice(parallel()), twice(point()), twice(flat())}, {0, 1, 2})));
  };
  for (const Case &each : {Case{"concrete that is pulled apart", [] { return std::make_unique<Pulled>(); }, 800},
                           Case{"grains that fall into a box", shared_bodies::falling_grains, 600},
                           Case{"three laws in two materials", two_materials, 150}})
    {
      const Moments whole = alone(each);
      INFO(each.name);
      CHECK((whole.back().broken > 0 || each.name == std::string("grains that fall into a box")));
      for (const auto &[count, moved] : {std::pair(1, 0), std::pair(2, 0), std::pair(3, 50)})
        check(each, whole, static_cast<std::size_t>(count), moved);
    }
}

TEST_CASE("ranks show links to periodic images once, those of more ranks than bricks too", "[dem][ranks]")
{
  const Case cell{"a cell under stresses", [] { return std::make_unique<CellUnderStress>(); }, 600},
    small{"eight spheres", small_cell, 300};
  for (const Case &each : {cell, small})
    {
      const Moments whole = alone(each);
      INFO(each.name);
      CHECK(whole.back().to_images > 0);
      CHECK(whole.back().broken > 0);
      check(each, whole, 3, each.name == cell.name ? 50 : 0);
    }
}

TEST_CASE("ranks show both ends of links that broke, where nothing joins them any more", "[dem][ranks]")
{
  // Halves of a cube that fly apart, one of which each rank has along one of the axes; what is left of the bonds is sorted anew.
  for (const int axis : {0, 1, 2})
    {
      const auto halves = [axis] {
        const dem::Packing cube = cluster::cubic_lattice(8, 8, 8, 1e-3);
        dem::Specimen      body(cube, cluster::bonded(1.5), cluster::concrete());
        for (std::size_t i = 0; i < cube.size(); ++i)
          body.set_velocity(i, (cube.centre[i][axis] < 7e-3 ? -5 : 5) * Vector3d::Unit(axis), Vector3d::Zero());
        return std::make_unique<Free>(std::move(body));
      };
      const Case    each{"halves that fly apart", halves, 300};
      const Moments whole = alone(each);
      INFO("axis " << axis);
      CHECK(whole.back().broken >= 64);
      check(each, whole, 2, 0);
    }
}

TEST_CASE("ranks show what is glued to surfaces, torn or not, once", "[dem][ranks]")
{
  const Case    each{"a block torn from a plate", torn_from_plate, 100};
  const Moments whole = alone(each);
  CHECK(whole.back().glue == 100);
  check(each, whole, 2, 0);
  check(each, whole, 3, 50);
}
