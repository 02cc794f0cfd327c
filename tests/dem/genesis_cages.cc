// The spheres that fit among others: places and radii of floaters.
#include "dem/genesis/cages.h"
#include "dem/genesis/inscribed.h"

#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  dem::Obstacle sphere(const Vector3d &centre, const double radius) { return {centre, radius, Vector3d::Zero(), 0}; }
  dem::Obstacle wall(const Vector3d &normal, const double offset) { return {Vector3d::Zero(), 0, normal, offset}; }
} // namespace

TEST_CASE("inscribed: among three discs and among four spheres that touch there is room for the one of Descartes",
          "[genesis]")
{
  const double                     h     = std::sqrt(3.0);
  const std::vector<dem::Obstacle> discs = {sphere({0, 0, 0}, 1), sphere({2, 0, 0}, 1), sphere({1, h, 0}, 1)};
  const auto                       disc  = dem::inscribed_sphere(discs, 2, {1.05, 0.5, 0}, 0.5);
  REQUIRE(disc);
  CHECK(disc->radius == Approx(2 / h - 1).epsilon(1e-12));
  CHECK((disc->centre - Vector3d(1, h / 3, 0)).norm() < 1e-12);
  std::vector<dem::Obstacle> spheres = discs;
  spheres.push_back(sphere({1, h / 3, std::sqrt(8.0 / 3)}, 1));
  const auto ball = dem::inscribed_sphere(spheres, 3, {1, 0.5, 0.5}, 0.5);
  REQUIRE(ball);
  CHECK(ball->radius == Approx(std::sqrt(1.5) - 1).epsilon(1e-12));
  // Of three kinds of radii, Descartes (1643): the sum of curvatures squared is twice the sum of their squares.
  const double                     a = 1, b = 2, c = 3;
  const std::vector<dem::Obstacle> right = {sphere({0, 0, 0}, a), sphere({a + b, 0, 0}, b), sphere({0, a + c, 0}, c)};
  const auto                       small = dem::inscribed_sphere(right, 2, {0.9, 0.9, 0}, 1);
  REQUIRE(small);
  CHECK(1 / small->radius == Approx(1 / a + 1 / b + 1 / c + 2 * std::sqrt(1 / (a * b) + 1 / (b * c) + 1 / (a * c))));
}

TEST_CASE("inscribed: walls hold as spheres do, and what nothing holds on one side is none", "[genesis]")
{
  const std::vector<dem::Obstacle> corner = {wall({1, 0, 0}, 0), wall({0, 1, 0}, 0), sphere({2, 2, 0}, 1)};
  const auto                       disc   = dem::inscribed_sphere(corner, 2, {0.5, 0.6, 0}, 1);
  REQUIRE(disc);
  const double root = std::sqrt(2.0);
  CHECK(disc->radius == Approx((2 * root - 1) / (1 + root)).epsilon(1e-12));
  CHECK(disc->centre.x() == Approx(disc->radius).epsilon(1e-12));
  CHECK(!dem::inscribed_sphere(corner, 2, {0.5, 0.6, 0}, 0.1)); // further away than allowed
  CHECK(!dem::inscribed_sphere({sphere({0, 0, 0}, 1), sphere({3, 0, 0}, 1)}, 2, {1.5, 0, 0}, 1));
  // Three on the same side touch a circle that could slip out.
  CHECK(!dem::inscribed_sphere({sphere({-2.2, 0, 0}, 1), sphere({0, 0.1, 0}, 1), sphere({2.2, 0, 0}, 1)}, 2,
                               {0, 1.4, 0}, 5));
  // A fourth that reaches in leaves none.
  std::vector<dem::Obstacle> full = corner;
  full.push_back(sphere(disc->centre, 0.1));
  const auto other = dem::inscribed_sphere(full, 2, disc->centre, 1);
  if (other)
    for (const dem::Obstacle &one : full)
      CHECK(one.distance(other->centre) >= other->radius * (1 - 1e-9));
}

TEST_CASE("cages: a floater touches all around with the prescribed overlap, and grows by so much at most", "[genesis]")
{
  const double h = std::sqrt(3.0);
  dem::Packing packing;
  packing.centre = {{2, 2, 0}, {4, 2, 0}, {3, 2 + h, 0}, {3.01, 2.55, 0}};
  packing.radius = {1, 1, 1, 0.13};
  dem::Vessel vessel;
  vessel.size           = {10, 10, 0};
  const auto   the_last = [](const std::size_t i) { return i == 3; };
  dem::Packing fitted   = packing;
  dem::fit_into_cages(fitted, vessel, the_last, 1.3, 1e-5);
  CHECK(fitted.radius[3] == Approx(2 / h - 1 + 1e-5).epsilon(1e-9));
  for (int i = 0; i < 3; ++i)
    {
      CHECK(fitted.centre[i] == packing.centre[i]);
      CHECK(1 + fitted.radius[3] - (fitted.centre[3] - fitted.centre[i]).norm() == Approx(1e-5).epsilon(1e-6));
    }
  // Too small for it: it grows, and is where it will touch once it is large enough.
  packing.radius[3] = 0.1;
  packing.centre[3] = {3, 2.6, 0};
  fitted            = packing;
  dem::fit_into_cages(fitted, vessel, the_last, 1.3, 1e-5);
  CHECK(fitted.radius[3] == Approx(0.13).epsilon(1e-12));
  CHECK((fitted.centre[3] - Vector3d(3, 2 + h / 3, 0)).norm() < 1e-9);
  // Just large enough without the overlap: with it, too, it grows by so much at most.
  packing.radius[3] = 1.0001 * (2 / h - 1) / 1.3;
  fitted            = packing;
  dem::fit_into_cages(fitted, vessel, the_last, 1.3, 2e-3);
  CHECK(fitted.radius[3] == Approx(1.3 * packing.radius[3]).epsilon(1e-12));
}
