#include "base/errors.h"
#include "dem/genesis/grading.h"
#include "dem/genesis/insertion.h"
#include "dem/genesis/sizes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using dem::SizeClass;

namespace
{
  std::vector<SizeClass> equal_fractions(const std::vector<double> &millimetres)
  {
    std::vector<SizeClass> classes;
    for (const double d : millimetres)
      classes.push_back({1.0 / static_cast<double>(millimetres.size()), 1e-3 * d, 1e-3 * d});
    return classes;
  }
} // namespace

TEST_CASE("porosity in the plane is that of Wang et al. (2014)")
{
  CHECK(dem::porosity_in_plane(0.22) == Approx(0.075328).epsilon(1e-12));
}

TEST_CASE("particles of each class are as many as the published mortars have")
{
  const double space = 0.15 * 0.30, n = 0.10;
  const auto counts = [&](const std::vector<double> &d) { return dem::class_counts(equal_fractions(d), space, n, 2); };
  const auto near   = [](const std::vector<std::size_t> &found, const std::vector<int> &published) {
    REQUIRE(found.size() == published.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      CHECK(std::abs(static_cast<int>(found[k]) - published[k]) <= 1);
  };
  near(counts({1.68}), {18270});
  near(counts({1.0, 3.2}), {25783, 2518});
  near(counts({0.585, 1.68, 3.43}), {50226, 6090, 1461});
  near(counts({0.54, 1.24, 2.51, 4.48}), {44210, 8384, 2046, 642});
}

TEST_CASE("particles counted by their mean radius, and grown by what the porosity lacks")
{
  CHECK(dem::count_by_mean_radius(0.2 * 0.1, 0.12, 0.5e-3, 2) == 22409);
  const double solid = 0.88, half = solid / 4;
  CHECK(dem::expansion_factor(0.12, 1 - half, 2) == Approx(2).epsilon(1e-12));
  CHECK(dem::expansion_factor(0.4, 1 - 0.6 / 8, 3) == Approx(2).epsilon(1e-12));
}

TEST_CASE("a vessel is enlarged until whole particles have their parts, and no further", "[dem][genesis]")
{
  const std::vector<dem::SizeClass> classes = {{0.75, 1e-3, 1e-3}, {0.25, 8e-3, 8e-3}};
  const auto                        misfit  = [&](const double factor) {
    return dem::largest_misfit(classes, 1e-4 * factor * factor, 0.15, 2);
  };
  CHECK(misfit(1) == Approx(0.25)); // not one of 8 mm
  const double factor = dem::least_enlargement(misfit, 0.05);
  // One of 8 mm is 0.3 of the solid, no more, from here on.
  CHECK(factor == Approx(std::sqrt(M_PI / 4 * 64e-6 / 0.3 / 0.85) / 1e-2).epsilon(1.1e-3));
  CHECK(misfit(factor) <= 0.05);
  CHECK(misfit(factor / 1.002) > 0.05);
  CHECK(dem::least_enlargement(misfit, 0.3) == 1);
}

TEST_CASE("radii drawn from a class spread evenly, the same for a seed, and have its mean area")
{
  const std::vector<SizeClass> classes = {{1.0, 2e-3, 5e-3}};
  const auto radii = dem::draw_radii(classes, {20000}, 7), again = dem::draw_radii(classes, {20000}, 7),
             other = dem::draw_radii(classes, {20000}, 8);
  CHECK(radii == again);
  CHECK(radii != other);
  double area = 0;
  for (const double r : radii)
    area += M_PI * r * r / 20000;
  CHECK(area == Approx(dem::mean_solid(classes[0], 2)).epsilon(0.01));
  CHECK(*std::min_element(radii.begin(), radii.end()) >= 1e-3);
  CHECK(*std::max_element(radii.begin(), radii.end()) <= 2.5e-3);
}

TEST_CASE("size classes that are none are refused by what is wrong with them")
{
  CHECK_THROWS_AS(dem::check_sizes({}), base::InputError);
  CHECK_THROWS_AS(dem::check_sizes({{0.5, 1e-3, 1e-3}}), base::InputError);
  CHECK_THROWS_AS(dem::check_sizes({{1.0, 2e-3, 1e-3}}), base::InputError);
  CHECK_THROWS_AS(dem::check_sizes({{1.0, 0, 1e-3}}), base::InputError);
  CHECK_NOTHROW(dem::check_sizes(equal_fractions({1, 2, 3})));
}

TEST_CASE("half-size particles find random places inside their vessel, none overlapping")
{
  dem::Vessel window, cylinder;
  window.size        = {0.03, 0.05, 0};
  cylinder.dimension = 3;
  cylinder.shape     = dem::Vessel::Shape::cylinder;
  cylinder.size      = {0.01, 0.01, 0.02};
  for (const dem::Vessel &vessel : {window, cylinder})
    {
      const double n       = vessel.dimension == 2 ? 0.10 : 0.40;
      const auto   classes = equal_fractions({0.54, 1.24, 2.51});
      auto         radii = dem::draw_radii(classes, dem::class_counts(classes, vessel.space(), n, vessel.dimension), 1);
      for (double &r : radii)
        r *= 0.5;
      const dem::Insertion made  = dem::insert_at_random(vessel, radii, 1),
                           again = dem::insert_at_random(vessel, radii, 1),
                           other = dem::insert_at_random(vessel, radii, 2);
      CHECK(made.overlaps == 0);
      CHECK(made.packing.centre == again.packing.centre);
      CHECK(made.packing.centre != other.packing.centre);
      const auto &p = made.packing;
      REQUIRE(p.size() == radii.size());
      for (std::size_t i = 0; i < p.size(); ++i)
        {
          CHECK(vessel.near(p.centre[i], p.radius[i], -1e-15).count == 0);
          for (std::size_t j = 0; j < i; ++j)
            if ((p.centre[i] - p.centre[j]).norm() < p.radius[i] + p.radius[j])
              FAIL_CHECK("particles " << i << " and " << j << " overlap");
        }
    }
}

TEST_CASE("what finds no free place is counted, and what does not fit is refused")
{
  dem::Vessel window;
  window.size = {0.01, 0.01, 0};
  const std::vector<double> full(100, 0.6e-3);
  CHECK(dem::insert_at_random(window, full, 1, 100).overlaps > 0);
  CHECK_THROWS_AS(dem::insert_at_random(window, {0.006}, 1), base::InputError);
}

TEST_CASE("aggregates in a plane section are as many as Walraven's grading gives")
{
  const std::vector<double> bounds  = {5e-3, 7e-3, 9e-3, 11e-3, 13e-3, 15e-3},
                            parts   = {0.460655, 0.543665, 0.613092, 0.670915, 0.716730, 0.748500},
                            numbers = {58.718, 27.624, 14.724, 8.102, 4.128};
  for (std::size_t i = 0; i < bounds.size(); ++i)
    CHECK(std::abs(dem::plane_section_grading(0.75, bounds[i], bounds.back()) - parts[i]) < 5.1e-7);
  const auto                     classes = dem::aggregate_counts(0.75, bounds, 0.02);
  const std::vector<std::size_t> rounded = {59, 28, 15, 8, 4};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      CHECK(std::abs(classes[i].exact - numbers[i]) < 5.1e-4);
      CHECK(classes[i].count == rounded[i]);
    }
  CHECK_THROWS_AS(dem::aggregate_counts(0.75, {5e-3}, 0.02), base::InputError);
  CHECK_THROWS_AS(dem::aggregate_counts(1.5, bounds, 0.02), base::InputError);
}
