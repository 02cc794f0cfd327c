// Means over a saved state, against what is known of a lattice.
#include "dem/observation/measured_state.h"

#include "base/errors.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>

namespace
{
  constexpr double radius = 1e-3, spacing = 2 * radius;

  /** 4 x 3 x 3 spheres that touch, with a stress and a damage that vary along x. */
  dem::DiscreteState lattice()
  {
    dem::DiscreteState state = dem::discrete_state(dem::Specimen(
      cluster::cubic_lattice(4, 3, 3, radius), cluster::elastic(cluster::bonded(1.01)), cluster::concrete()));
    for (std::size_t i = 0; i < state.size(); ++i)
      {
        state.volume[i] = spacing * spacing * spacing;
        state.stress[i].setZero();
        state.stress[i](0, 0) = state.position[i].x() / spacing;
      }
    return state;
  }

  double left_of(const dem::DiscreteState &state)
  {
    double least = 1;
    for (const Eigen::Vector3d &x : state.position)
      least = std::min(least, x.x());
    return least;
  }
} // namespace

TEST_CASE("measured state: stress, fabric and coordination of a lattice are those that can be counted", "[dem]")
{
  const dem::DiscreteState state = lattice();
  const dem::MeasuredState found = dem::measured(state);
  CHECK(found.particles == 36);
  CHECK(found.volume == Approx(36 * 8e-9));
  CHECK(found.solid.value() == Approx(M_PI / 6));
  double mean = 0;
  for (const auto &stress : state.stress)
    mean += stress(0, 0) / 36;
  CHECK(found.stress(0, 0) == Approx(mean));
  CHECK(found.links == 75); // 3 x 3 x 3 along x, 4 x 2 x 3 along y and along z
  CHECK(found.coordination.mean == Approx(2 * 75 / 36.0));
  const Eigen::Vector3d expected = Eigen::Vector3d(27, 24, 24) / 75;
  CHECK((found.fabric_made->second.diagonal() - expected).norm() < 1e-14);
  CHECK((found.fabric_holding->second - found.fabric_made->second).norm() == 0);
  CHECK(found.gone == 0);
  CHECK(found.mean_damage == 0);
  CHECK_FALSE(found.fitted_damage); // three directions do not determine a tensor
}

TEST_CASE("measured state: links that are gone leave fabric and coordination, and count as damage", "[dem]")
{
  dem::DiscreteState state = lattice();
  for (dem::LinkDamage &link : state.damage.links)
    link.damage = std::abs(link.direction.x()) > 0.5 ? 1 : 0.5;
  const dem::MeasuredState found = dem::measured(state);
  CHECK(found.gone == 27);
  CHECK(found.mean_damage == Approx((27 + 0.5 * 48) / 75));
  CHECK(found.coordination.mean == Approx(2 * 48 / 36.0));
  CHECK(found.fabric_holding->second(0, 0) == Approx(0).margin(1e-14));
  CHECK(found.damage.trace() / 3 == Approx(found.mean_damage));
  CHECK(found.damage(0, 0) > found.damage(1, 1));
}

TEST_CASE("measured state: a box measures what lies in it, and an empty one is refused", "[dem]")
{
  const dem::DiscreteState state = lattice();
  const double             left  = left_of(state);
  const dem::MeasuredBox   half{{left - 0.1 * spacing, -1, -1}, {left + 1.2 * spacing, 1, 1}}; // two layers of nine
  const dem::MeasuredState found = dem::measured(state, half);
  CHECK(found.particles == 18);
  CHECK(found.links == 9 + 2 * 12);
  CHECK(found.coordination.mean == Approx(2 * 33 / 18.0));
  CHECK(found.stress(0, 0) == Approx(left / spacing + 0.5));
  CHECK_THROWS_AS(dem::measured(state, dem::MeasuredBox{{1, 1, 1}, {2, 2, 2}}), base::InputError);
}
