// Packings that ranks grow together: doc/theory/ranks.md, 3.
#include "base/flat_state.h"
#include "dem/genesis/genesis.h"
#include "dem/genesis/sizes.h"
#include "rank_threads.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <limits>
#include <vector>

namespace
{
  /** Particles of two sizes that are to come under a low stress, and not many rounds of each kind. */
  dem::GenesisParameters grains(const int dimension, const Eigen::Vector3d &size, const double diameter)
  {
    const std::vector<dem::SizeClass> classes = {{0.5, diameter, diameter}, {0.5, 2 * diameter, 2 * diameter}};
    dem::GenesisParameters            p;
    p.vessel.dimension                      = dimension;
    p.vessel.size                           = size;
    p.material.contact.effective_modulus    = 8e9;
    p.material.contact.friction_coefficient = 0.1;
    const double porosity                   = dimension == 2 ? 0.12 : 0.38;
    p.radii           = dem::draw_radii(classes, dem::class_counts(classes, p.vessel.space(), porosity, dimension), 3);
    p.seed            = 3;
    p.stress          = 27500;
    p.increments      = 5;
    p.increment_steps = 100;
    p.solve_steps     = 200;
    p.stress_rounds   = 2;
    p.floater_rounds  = 2;
    return p;
  }

  dem::GenesisParameters discs() { return grains(2, {0.03, 0.03, 0}, 0.8e-3); }

  void append(std::vector<double> &row, const dem::Packing &packing)
  {
    for (const Eigen::Vector3d &x : packing.centre)
      row.insert(row.end(), x.data(), x.data() + 3);
    row.insert(row.end(), packing.radius.begin(), packing.radius.end());
  }

  /** Packing, energies and reports of what has grown. */
  std::vector<double> figures_of(dem::Genesis &genesis)
  {
    const dem::GrowthEnergies energy = genesis.energies();
    std::vector<double>       row    = {energy.growth,
                                        energy.stored,
                                        energy.kinetic,
                                        energy.damped,
                                        energy.friction,
                                        energy.stopped,
                                        static_cast<double>(genesis.steps())};
    append(row, genesis.packing());
    for (const dem::GenesisStageReport &r : genesis.reports())
      row.insert(row.end(),
                 {r.ratio, r.porosity, r.stress, r.floaters, r.contact_number, r.largest_overlap, r.diameter_change,
                  r.scale, static_cast<double>(r.steps), static_cast<double>(r.rounds), r.reached ? 1.0 : 0.0});
    return row;
  }

  constexpr std::int64_t to_the_end = std::numeric_limits<std::int64_t>::max() / 2;

  void check_on_ranks(const dem::GenesisParameters    &p,
                      const std::vector<std::size_t>  &counts,
                      const std::vector<std::int64_t> &moves)
  {
    omp_set_num_threads(1);
    dem::Genesis one(p);
    one.advance(to_the_end);
    CHECK(one.reports().size() == (p.stress > 0 ? 4 : 3)); // floaters got other radii, too
    const std::vector<double> alone = figures_of(one);
    for (const std::size_t count : counts)
      for (const std::int64_t move_every : moves)
        {
          std::vector<char> same(count, 0);
          rank_threads::run(count, [&](const std::shared_ptr<dem::Ranks> &ranks) {
            omp_set_num_threads(1);
            dem::Genesis genesis(p, ranks, move_every);
            genesis.advance(to_the_end);
            same[ranks->rank()] = figures_of(genesis) == alone;
          });
          INFO(p.radii.size() << " particles on " << count << " ranks, ranges moved every " << move_every);
          CHECK(same == std::vector<char>(count, 1));
        }
  }
} // namespace

TEST_CASE("particles that ranks grow together become the packing of one to the last bit", "[dem][ranks][genesis]")
{
  REQUIRE(discs().radii.size() > 3 * 256);
  check_on_ranks(discs(), {3}, {0});
}

TEST_CASE("so do spheres, fewer bricks than ranks, and ranges that move", "[dem][ranks][genesis][slow]")
{
  check_on_ranks(discs(), {2, 6}, {0, 7});
  check_on_ranks(grains(3, {0.011, 0.011, 0.011}, 1e-3), {2, 5}, {0, 11});
  auto unstressed   = discs();
  unstressed.stress = 0;
  check_on_ranks(unstressed, {3}, {7});
}

TEST_CASE("a genesis is saved on any ranks with the bits of one, and goes on on others", "[dem][ranks][genesis]")
{
  const dem::GenesisParameters p     = discs();
  const auto                   saved = [](dem::Genesis &genesis) {
    base::Column          state;
    base::FlatStateWriter writer(state);
    genesis.visit_state(writer);
    return state;
  };
  omp_set_num_threads(1);
  dem::Genesis one(p);
  one.advance(200); // while they grow
  const base::Column early = saved(one);
  one.advance(to_the_end);
  const base::Column late = saved(one);

  std::vector<base::Column> early_on_ranks(3), late_on_ranks(2);
  rank_threads::run(3, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    omp_set_num_threads(1);
    dem::Genesis genesis(p, ranks, 9);
    genesis.advance(200);
    early_on_ranks[ranks->rank()] = saved(genesis);
  });
  CHECK(early_on_ranks == std::vector<base::Column>(3, early));
  rank_threads::run(2, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    omp_set_num_threads(1);
    dem::Genesis          genesis(p, ranks);
    base::FlatStateReader reader(early);
    genesis.visit_state(reader);
    genesis.advance(to_the_end);
    late_on_ranks[ranks->rank()] = saved(genesis);
  });
  CHECK(late_on_ranks == std::vector<base::Column>(2, late));
}

TEST_CASE("what has grown on ranks each of them reads alone when all have gathered it", "[dem][ranks][genesis]")
{
  auto p         = discs();
  p.increments   = 2;
  p.stress       = 0;
  p.fit_floaters = false;
  omp_set_num_threads(1);
  dem::Genesis one(p);
  one.advance(to_the_end);
  const std::vector<double> alone = figures_of(one);
  std::vector<double>       of_first;
  rank_threads::run(2, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    omp_set_num_threads(1);
    dem::Genesis genesis(p, ranks);
    genesis.advance(to_the_end);
    genesis.gather();
    if (ranks->rank() == 0) // the other would not come to meet it
      of_first = figures_of(genesis);
  });
  CHECK(of_first == alone);
}
